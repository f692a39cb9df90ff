"""Pictures that Blender has saved."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import OpenEXR
from numpy.typing import NDArray


def read_rgb(path: Path) -> NDArray[np.float32]:
    """(height, width, 3), the top row first."""
    with OpenEXR.File(str(path), separate_channels=True) as file:
        channels = file.channels()
        return np.stack([channels[channel].pixels for channel in "RGB"], axis=-1)

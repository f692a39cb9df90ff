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


def read_passes(path: Path) -> dict[str, NDArray[np.float32]]:
    """Every pass of a multilayer file by "layer.pass", (height, width, channels), the top row first."""
    grouped: dict[str, dict[str, NDArray[np.float32]]] = {}
    with OpenEXR.File(str(path), separate_channels=True) as file:
        for part in file.parts:  # one, from Blender 5.0 one per pass and view
            view = part.header.get("view")
            for name, channel in part.channels.items():
                group, _, component = name.rpartition(".")
                grouped.setdefault(f"{group}.{view}" if view else group, {})[component] = np.array(channel.pixels)
    order = "RGBAXYZWUV"
    return {
        group: np.stack([parts[c] for c in sorted(parts, key=lambda c: order.index(c.upper()))], axis=-1)
        for group, parts in grouped.items()
    }


def passes_by_name(path: Path) -> dict[str, NDArray[np.float32]]:
    """The same of a file with one layer, by "pass"."""
    return {name.split(".")[1]: values for name, values in read_passes(path).items()}

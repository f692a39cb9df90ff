"""Blender's linear RGB, that of Rec. 709, and the CIE's XYZ, to the digits that this Blender's Cycles has them."""

from __future__ import annotations

import bpy
import numpy as np

_BY_THE_STANDARD = (
    (3.2409699, -1.5373832, -0.4986108),
    (-0.9692436, 1.8759675, 0.0415551),
    (0.0556301, -0.2039770, 1.0569715),
)
_BEFORE_5_0 = (
    (3.2404542, -1.5371385, -0.4985314),
    (-0.9692660, 1.8760108, 0.0415560),
    (0.0556434, -0.2040259, 1.0572252),
)

RGB_FROM_XYZ = np.array(_BY_THE_STANDARD if bpy.app.version >= (5, 0) else _BEFORE_5_0)  # (3, 3), a row for each of RGB
LUMINANCE = np.linalg.inv(RGB_FROM_XYZ)[1]  # (3,) of RGB

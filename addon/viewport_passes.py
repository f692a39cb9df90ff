"""The passes that the viewport can show in place of the picture, as colours."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

# As bpy.props.EnumProperty has them; what the core calls them is in _CORE_NAMES.
VIEWPORT_PASSES = (
    ("COMBINED", "Combined", "The picture"),
    ("DEPTH", "Depth", "The nearer, the brighter: white is the nearest point in view, half as bright is twice as far"),
    ("NORMAL", "Normal", "Which way surfaces face in world space: from -1 to 1 is from black to full red, green, blue"),
    ("DIFFUSE_COLOR", "Diffuse Color", "What share of light surfaces scatter in all directions"),
    ("EMISSION", "Emission", "What surfaces shine by themselves"),
    ("INDIRECT", "Indirect", "Light that comes by way of other surfaces or fog"),
    ("METHOD", "Method", "The analytic integrator's methods, by colour"),
    ("ERROR", "Error", "The relative error that the analytic integrator predicts: white is 100 %"),
)
_CORE_NAMES = {
    "COMBINED": "Combined",
    "DEPTH": "Depth",
    "NORMAL": "Normal",
    "DIFFUSE_COLOR": "DiffCol",
    "EMISSION": "Emit",
    "INDIRECT": "Indirect",
    "METHOD": "Method",
    "ERROR": "Error",
}


def core_name(shown: str) -> str:
    """shown: the identifier of one of VIEWPORT_PASSES."""
    return _CORE_NAMES[shown]


def is_light(shown: str) -> bool:
    """Whether the film's exposure scales the pass."""
    return shown in {"COMBINED", "EMISSION", "INDIRECT"}


def as_colours(shown: str, values: NDArray[np.float32]) -> NDArray[np.float32]:
    """(height, width, 4) of what the core gives for a pass, (height, width, channels)."""
    if shown == "COMBINED":
        return values
    if shown == "DEPTH":
        nearest = max(float(values.min()), 1e-6)
        values = np.float32(nearest) / np.maximum(values, np.float32(nearest))
    elif shown == "NORMAL":
        is_surface = (values != 0).any(axis=-1, keepdims=True)
        values = np.where(is_surface, 0.5 * values + 0.5, 0).astype(np.float32)
    colours = np.ones((*values.shape[:2], 4), np.float32)
    colours[..., :3] = values
    return colours

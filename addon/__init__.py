"""Pivot, a render engine for light of finite size on glossy surfaces."""

from __future__ import annotations

import atexit

import addon_utils
import bpy

from . import engine, light_panels, panels, properties, sampling_presets
from .chart import operators as chart_operators
from .ndf import operators as ndf_operators
from .ndf import panel as ndf_panel

bl_info = {
    "name": "Pivot",
    "description": "Light of finite size on glossy surfaces, exact or without noise",
    "author": "The Pivot authors",
    "version": (0, 1, 0),
    "blender": (3, 4, 0),
    "location": "Render Properties > Render Engine",
    "category": "Render",
}

_MODULES = (properties, engine, chart_operators, sampling_presets, panels, light_panels, ndf_operators, ndf_panel)


def register() -> None:
    for module in _MODULES:
        module.register()
    if getattr(bpy.app, "module", False):
        atexit.register(_disable)


def unregister() -> None:
    atexit.unregister(_disable)
    for module in reversed(_MODULES):
        module.unregister()


def _disable() -> None:
    """As a Python module, Blender 4.2 crashes and 4.5 hangs at exit while a class or handler is registered.

    A Blender of its own has let go of its classes by then.
    """
    addon_utils.disable(__name__)

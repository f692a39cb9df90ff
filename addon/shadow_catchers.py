"""What a picture shows where it has shadow catchers, as Cycles has it."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .passes import SHADOW_CATCHER
from .report import Reporter


def catcher_values(core_scene: Any, what: str, denoise: str, reporter: Reporter) -> dict[str, Any]:
    """The argument of pivot_core.RenderSettings that shadow catchers take; none where there are none.

    what: is rendered, for a warning. denoise: as in scene.pivot.
    """
    if not core_scene.has_shadow_catchers:
        return {}
    if denoise != "NONE":
        reporter.warn(f"{what}: a picture with shadow catchers is not denoised")
    return {"shadow_catchers": True}


def catcher_picture(scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer) -> str:
    """What is in their place: a name of pivot_core.Session.read_shadow_catchers."""
    if getattr(getattr(view_layer, "cycles", None), "use_pass_shadow_catcher", False):
        return "NOTHING"
    return "ALPHA" if scene.render.film_transparent else "WORLD"


def catcher_passes(scene: bpy.types.Scene) -> int:
    """How many colours of each pixel a film keeps for them."""
    kinds = {"MESH", "VOLUME"}  # a new lamp says that it is one
    return 5 if any(each.is_shadow_catcher for each in scene.objects if each.type in kinds) else 0


class CatcherReader:
    """Reads the passes of a session that shadow catchers change."""

    def __init__(self, scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer, are_told: bool) -> None:
        self.are_told = are_told
        self._picture = catcher_picture(scene, view_layer)

    def read(self, session: Any, name: str) -> NDArray[np.float32] | None:
        """A pass by the core's name, None where it is another's."""
        if name == SHADOW_CATCHER and not self.are_told:
            return np.ones((session.height, session.width, 3), np.float32)
        if not self.are_told or name not in {SHADOW_CATCHER, "Combined"}:
            return None
        values: NDArray[np.float32] = session.read_shadow_catchers(
            "FACTOR" if name == SHADOW_CATCHER else self._picture
        )
        return values

"""Passes by the names that passes.fill_layer asks by, wherever the core keeps them."""

from __future__ import annotations

from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .named_passes import named_passes, read_named
from .passes import PASSES, film_exposure, read_mattes
from .shadow_catchers import CatcherReader


class PassReader:
    """Of the renders of one view layer."""

    def __init__(self, scene: bpy.types.Scene, view_layer: bpy.types.ViewLayer, values: dict[str, Any]) -> None:
        """values: the arguments of pivot_core.RenderSettings."""
        self.wanted = {entry.core_name for entry in PASSES if entry.is_on(view_layer)}
        self.named = named_passes(view_layer)
        self.exposure = film_exposure(scene)
        self.filter_width_px = values["filter_width_px"]
        self.groups = [entry.name for entry in self.named if entry.is_light_group]
        self._catchers = CatcherReader(scene, view_layer, "shadow_catchers" in values)

    @property
    def denoises(self) -> bool:
        """Whether Combined is what the core calls so."""
        return not self._catchers.are_told

    def read(self, session: Any, name: str) -> NDArray[np.float32]:
        for values in (
            read_mattes(session, name),
            self._catchers.read(session, name),
            read_named(session, self.named, name),
        ):
            if values is not None:
                return values
        core: NDArray[np.float32] = session.read(name)
        return core

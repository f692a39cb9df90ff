"""The passes that a view layer names itself: the light of groups, and shader AOVs."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import bpy
import numpy as np
from numpy.typing import NDArray

from .export.aovs import valid_aovs

_CHANNELS = {"COLOR": ("RGBA", "COLOR"), "VALUE": ("X", "VALUE")}  # of AOVs, and their kind of pass


@dataclass(frozen=True)
class NamedPass:
    name: str
    channels: str
    kind: str  # of RenderEngine.register_pass

    @property
    def is_light_group(self) -> bool:
        return self.channels == "RGB"


def named_passes(view_layer: bpy.types.ViewLayer) -> list[NamedPass]:
    """In the order of the core's."""
    groups = [NamedPass(f"Combined_{group.name}", "RGB", "COLOR") for group in view_layer.lightgroups]
    return groups + [NamedPass(aov.name, *_CHANNELS[aov.type]) for aov in valid_aovs(view_layer)]


def named_pass_values(view_layer: bpy.types.ViewLayer) -> dict[str, int]:
    """The arguments of pivot_core.RenderSettings that these passes take; none where nobody asks for them."""
    counts = {"light_groups": len(view_layer.lightgroups), "aovs": len(valid_aovs(view_layer))}
    return {name: count for name, count in counts.items() if count > 0}


def read_named(session: Any, named: list[NamedPass], name: str) -> NDArray[np.float32] | None:
    """A named pass by its name, None where there is none."""
    place = next((place for place, entry in enumerate(named) if entry.name == name), None)
    if place is None:
        return None
    groups = sum(entry.is_light_group for entry in named)
    first = place + max(place - groups, 0)  # of AOVs the core keeps two, from the first one on
    colours = session.read_named(first)
    channels = len(named[place].channels)
    if channels <= 3:
        return np.ascontiguousarray(colours[..., :channels])
    return np.concatenate([colours, session.read_named(first + 1)[..., :1]], axis=-1)

"""Strands as Blender keeps them, beside what it tells of each point."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import bpy
import numpy as np
import parts
from pivot.export.strand_cache import cached_positions
from pivot.export.strands import StrandCounts, strand_counts

_KINDS: dict[str, dict[str, Any]] = {
    "parents": {"child_type": "NONE"},
    "simple": {"child_type": "SIMPLE"},
    "interpolated": {"child_type": "INTERPOLATED"},
    "lacking points": {"child_type": "INTERPOLATED", "child_length": 0.7, "child_length_threshold": 0.3},
    "longer": {"child_type": "SIMPLE", "kink": "SPIRAL"},
}


def main(folder: Path) -> Any:
    """Of each kind whether they were found, and how far off they are."""
    return {name: _apart(settings) for name, settings in _KINDS.items()}


def _apart(settings: dict[str, Any]) -> tuple[bool, float]:
    parts.clear()
    bpy.ops.mesh.primitive_uv_sphere_add(location=(1, 2, 3), rotation=(0.3, 0.2, 0.1))
    ball = bpy.context.object
    ball.scale = (1, 2, 1)
    ball.modifiers.new("fur", "PARTICLE_SYSTEM")
    of_fur = ball.particle_systems[0].settings
    of_fur.type, of_fur.count, of_fur.display_step = "HAIR", 40, 3
    setattr(of_fur, "child_percent" if hasattr(of_fur, "child_percent") else "child_nbr", 30)
    for name, value in settings.items():
        setattr(of_fur, name, value)
    evaluated = ball.evaluated_get(bpy.context.evaluated_depsgraph_get())
    modifier = evaluated.modifiers[0]
    counts = strand_counts(modifier, is_render=False)
    found = cached_positions(evaluated, modifier.particle_system, *counts)
    told = _told(evaluated, modifier.particle_system, counts)
    return found is not None, float(np.abs(found - told).max()) if found is not None else 0.0


def _told(blender_object: Any, system: Any, counts: StrandCounts) -> np.ndarray:
    strands = range(counts.first, counts.first + counts.count)
    return np.array(
        [
            [system.co_hair(object=blender_object, particle_no=strand, step=step)[:] for step in range(counts.steps)]
            for strand in strands
        ],
        np.float32,
    )

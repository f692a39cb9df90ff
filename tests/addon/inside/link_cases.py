"""Lamps and a panel that light some objects only, and whose shadows only some cast, by Cycles and by Pivot."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import bpy
import parts
from cycles_cases import SPHERE, _ball, by_both, directly_by_both, on_clay
from visibility_cases import _glossy

CASES = ("receivers", "blockers", "shining", "many")


def main(folder: Path) -> Any:
    for name in CASES:
        clay, _ = on_clay()
        _ball("left", (-1.3, 0, 1), clay)
        _ball("right", (1.3, 0, 1), _glossy("shiny", 0.3))
        globals()[f"_{name}"]()
        by_both(folder, name, 1)
        directly_by_both(folder, name, 8)
    return list(CASES)


def _link(light: Any, kind: str, *names: str, state: str = "INCLUDE") -> None:
    """kind: receiver or blocker."""
    collection = bpy.data.collections.new(f"{kind}s of {light.name}")
    for name in names:
        collection.objects.link(bpy.data.objects[name])
        collection.collection_objects[-1].light_linking.link_state = state
    setattr(light.light_linking, f"{kind}_collection", collection)


def _receivers() -> None:
    key = parts.light("key", "POINT", (-3, -2, 3), energy=200, **SPHERE)
    _link(key, "receiver", "left", "ground")
    _link(parts.light("fill", "AREA", (3, -2, 3), energy=80, size=1), "receiver", "left", state="EXCLUDE")
    child = bpy.data.collections.new("child")
    child.objects.link(bpy.data.objects["right"])
    sun = parts.light("sun", "SUN", energy=1, angle=0.05)
    sun.rotation_euler = (0.5, 0.3, 0)
    _link(sun, "receiver", "ground")
    sun.light_linking.receiver_collection.children.link(child)


def _blockers() -> None:
    _link(parts.light("key", "POINT", (-3, -2, 3), energy=200, **SPHERE), "blocker", "left")
    _link(parts.light("fill", "AREA", (3, -2, 3), energy=80, size=1), "blocker", "right", state="EXCLUDE")
    parts.light("sun", "SUN", energy=1, angle=0.05).rotation_euler = (0.5, 0.3, 0)


def _shining() -> None:
    glow, _ = parts.shaded("glow", "ShaderNodeEmission", Color=(1, 0.4, 0.2, 1), Strength=6)
    for name, x in (("of receivers", -3), ("of blockers", 3)):
        panel = parts.quad(name, (x, 0, 1.5), glow)
        panel.rotation_euler = (0, math.radians(90), 0)
        panel.scale = (0.8, 0.8, 1)
    _link(bpy.data.objects["of receivers"], "receiver", "left", "ground")
    _link(bpy.data.objects["of blockers"], "blocker", "left")


def _many() -> None:
    """More lamps than a vertex samples."""
    for place in range(12):
        light = parts.light(f"lamp {place}", "POINT", (0.8 * place - 4.4, -2.5, 3), energy=40, **SPHERE)
        if place % 3:
            _link(light, "receiver", ("left", "right", "ground")[place % 3])
        if place % 4 == 0:
            _link(light, "blocker", "left", state="EXCLUDE")

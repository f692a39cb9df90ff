"""Attributes of meshes and objects by name."""

from __future__ import annotations

import pivot_core


def test_a_name_keeps_its_id() -> None:
    scene = pivot_core.Scene()
    names = [f"uv:{i}" for i in range(20)]
    assert [scene.attribute_id(name) for name in names] == list(range(20))
    assert [scene.attribute_id(name) for name in reversed(names)] == list(reversed(range(20)))

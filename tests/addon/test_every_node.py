"""Every shader node is shown or named: nothing is left out of a picture in silence, and none stops it."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest


@pytest.fixture(scope="module")
def nodes(inside: Callable[[str], Any]) -> Any:
    return inside("every_node")


def test_what_has_no_row_is_named(nodes: Any) -> None:
    silent = [
        name
        for name, case in nodes["cases"].items()
        if case["kind"] not in nodes["known"] and not any("node 'asked'" in text for text in case["said"])
    ]
    assert silent == []


def test_only_these_are_named(nodes: Any) -> None:
    """A node that Pivot has come to show, or that a new Blender has, changes this list and the README's."""
    named = {case["kind"] for case in nodes["cases"].values() if case["kind"] not in nodes["known"]}
    assert named <= UNKNOWN


UNKNOWN = {
    "EEVEE_SPECULAR",
    "SCRIPT",
    "SHADERTORGB",
    "SQUEEZE",
    "TEX_POINTDENSITY",
    "UVALONGSTROKE",
    # From Blender 5.0 on.
    "MATERIAL_RAYCAST",
    "NodeEvaluateClosure",
    "NodeImplicitConversion",
    "REPEAT_INPUT",
    "REPEAT_OUTPUT",
    "ShaderNodeRadialTiling",
}

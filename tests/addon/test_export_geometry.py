"""Evaluated meshes reach the core with their normals, UVs and slots, each once, and all their instances."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest


@pytest.fixture(scope="module")
def cases(inside: Callable[[str], Any]) -> Any:
    return inside("geometry_cases")


@pytest.fixture(scope="module")
def instances(cases: Any) -> dict[str, Any]:
    return {group["name"]: group for group in cases["instances"]["instances"]}


def test_arrays_of_an_evaluated_mesh(cases: Any) -> None:
    arrays = {name: np.array(array) for name, array in cases["arrays"].items()}
    one = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (2, 0, 0)])
    np.testing.assert_allclose(arrays["positions"], np.concatenate([one, np.add(one, (10, 0, 0))]))
    assert arrays["corner_vertices"].tolist() == [0, 1, 2, 3, 1, 4, 2, 5, 6, 7, 8, 6, 9, 7]
    assert arrays["triangle_corners"].shape == (6, 3)
    assert arrays["materials"].tolist() == ["a", "b"]
    np.testing.assert_allclose(arrays["corner_uvs"][:7], [(corner / 8, 1) for corner in range(7)])

    corners = arrays["positions"][arrays["corner_vertices"][arrays["triangle_corners"]]]
    doubled_area = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])[:, 2]
    by_slot = [doubled_area[arrays["triangle_slots"] == slot].sum() for slot in (0, 1)]
    np.testing.assert_allclose(by_slot, (4, 2))  # the quads, and the triangles


@pytest.mark.parametrize(
    ("kind", "at_edge"),
    [("flat", (0, 0, 1)), ("smooth", (math.sqrt(0.5), 0, math.sqrt(0.5))), ("sharp", (0, 0, 1))],
)
def test_corner_normals(cases: Any, kind: str, at_edge: tuple[float, float, float]) -> None:
    """at_edge: where the prism's first face meets the second."""
    if cases["normals"][kind] is None:  # Blender 4.1 and later tell that every face is flat
        assert kind == "flat"
        return
    normals = np.array(cases["normals"][kind])
    np.testing.assert_allclose(normals[[0, 3]], [(0, 0, 1)] * 2, atol=1e-3)
    np.testing.assert_allclose(normals[[1, 2]], [at_edge] * 2, atol=1e-3)
    np.testing.assert_allclose(normals[[5, 6]], [(1, 0, 0)] * 2, atol=1e-3)


def test_custom_normals(cases: Any) -> None:
    np.testing.assert_allclose(cases["normals"]["custom"], [(0, 0.6, 0.8)] * 8, atol=1e-3)


def test_a_mesh_is_exported_once(cases: Any, instances: dict[str, Any]) -> None:
    assert cases["instances"]["meshes"] == 3  # the shared quad, the bare prism, the scattered cube
    users = ("shared", "object_linked", "unseen", "in_collection", "hidden_in_viewport")
    assert len({instances[name]["mesh"] for name in users}) == 1


def test_material_slots(instances: dict[str, Any]) -> None:
    assert instances["shared"]["materials"] == ["red"]
    assert instances["object_linked"]["materials"] == ["green"]
    assert instances["scatter"]["materials"][-1] == "green"
    assert instances["without_material"]["materials"] == ["none"]


def test_collection_instances(instances: dict[str, Any]) -> None:
    np.testing.assert_allclose(instances["in_collection"]["translations"], [(10, 0, 0), (20, 0, 0), (30, 0, 0)])


def test_particles(instances: dict[str, Any]) -> None:
    places = np.array(instances["shared"]["translations"])
    assert len(places) == 41
    assert np.sum(np.all(np.abs(places - (1, 0, 0)) < 1e-6, axis=1)) == 1
    assert "emitter" not in instances


def test_geometry_nodes_instances(instances: dict[str, Any]) -> None:
    assert instances["scatter"]["triangles"] == 12
    corners = sorted((round(x), round(y)) for x, y, _ in instances["scatter"]["translations"])
    assert corners == [(-1, -1), (-1, 1), (1, -1), (1, 1)]


def test_visibility(instances: dict[str, Any]) -> None:
    assert instances["unseen"]["hidden_from"] == ["CAMERA"]
    assert instances["shared"]["hidden_from"] == []
    assert "hidden_in_viewport" in instances
    assert "hidden" not in instances
    assert "flattened" in instances


def test_every_kind_of_surface_is_there_once(cases: Any) -> None:
    shapes = cases["shapes"]["instances"]
    assert sorted(group["name"] for group in shapes) == ["ball", "curve", "surface", "text"]
    assert all(len(group["translations"]) == 1 and group["triangles"] > 50 for group in shapes)
    assert next(group["materials"] for group in shapes if group["name"] == "text") == ["ink"]
    assert cases["shapes"]["reports"] == []


def test_nothing_to_see_is_no_fault(cases: Any) -> None:
    assert cases["empty"] == {"meshes": 0, "reports": []}

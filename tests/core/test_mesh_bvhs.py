"""Scenes that take meshes and their BVHs from each other."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import add_plane, add_sphere, place, render, set_camera


def fill(scene: pivot_core.Scene, floor: int, ball: int, opacity: float) -> pivot_core.Scene:
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5,) * 3))
    veil = scene.add_material(
        "veil", pivot_core.Material(diffuse=(0.5 * opacity,) * 3, transparency=(1 - opacity,) * 3)
    )
    scene.add_instances("floor", floor, place(), [grey])
    scene.add_instances("ball", ball, np.concatenate([place(x, 0, 0.5, 0.5) for x in (-1.0, 1.0)]), [veil])
    scene.set_world((1, 1, 1))
    set_camera(scene, (0, -5, 3), (0, 0, 0.5), (32, 24), 0.35)
    return scene


@pytest.mark.parametrize("opacity", [1.0, 0.5])
@pytest.mark.parametrize("rings", [16, 160])  # in the BVH of what is small, and in one of its own
def test_a_scene_with_meshes_of_another_is_as_one_of_its_own(opacity: float, rings: int) -> None:
    alone = pivot_core.Scene()
    fill(alone, add_plane(alone, 4.0), add_sphere(alone, rings), opacity)
    expected = {name: render(alone, samples=1, pass_name=name) for name in ("Depth", "Combined")}
    shared = pivot_core.SharedMeshes()
    first = pivot_core.Scene(shared)
    ids = add_plane(first, 4.0), add_sphere(first, rings)
    fill(first, *ids, opacity=1.0)
    render(first, samples=1)
    meshes = [first.mesh(id_) for id_ in ids]
    del first
    second = pivot_core.Scene(shared)
    fill(second, *map(second.add_shared_mesh, meshes), opacity)
    for name, picture in expected.items():
        np.testing.assert_allclose(render(second, samples=1, pass_name=name), picture, rtol=1e-3, atol=1e-3)


def test_attributes_have_the_same_ids_in_all_scenes_that_share() -> None:
    shared = pivot_core.SharedMeshes()
    first, second = pivot_core.Scene(shared), pivot_core.Scene(shared)
    names = ["a", "b", "a"]
    assert [first.attribute_id(name) for name in names] == [0, 1, 0]
    assert [second.attribute_id(name) for name in reversed(["b", "c"])] == [2, 1]


def test_no_mesh_is_taken_that_is_not_there() -> None:
    with pytest.raises(ValueError, match="mesh 0 is not in the scene"):
        pivot_core.Scene().mesh(0)

"""A program gives within a volume what it gives on a surface at the same place."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import render, set_camera

COLOR, RANDOM, PASS_INDEX = (0.2, 0.7, 0.4, 0.5), 0.3, 7.0
OF_OBJECT = (0.1, 0.2, 0.3, 0.4)
CORNERS = np.array([[-1, -1, 0.3], [1, -1, 0.3], [1, 1, 0.3], [-1, 1, 0.3]], np.float32)
OBJECT_TO_WORLD = np.array(
    [[1.6, -0.5, 0, 0.3], [0.9, 0.6, 0, -0.2], [0, 0, 0.5, 0.1], [0, 0, 0, 1]], np.float32
)  # turned and scaled


def generated(points: np.ndarray) -> np.ndarray:
    return (points * [0.5, 0.25, 3.0] + [0.5, 0.1, -0.2]).astype(np.float32)


def noise(program: pivot_core.Program, first: int) -> int:
    scaled = [program.add("math_multiply", [(first + i, 0.0), (-1, 3.0)]) for i in range(3)]
    return program.add("noise_3d", [(register, 0.0) for register in scaled], [0.0])


def program_of(scene: pivot_core.Scene, name: str) -> tuple[pivot_core.Program, list[int]]:
    """What tells of a place, as three registers: noise by the place in each space, or what is of the object."""
    program = pivot_core.Program()
    if name == "noise":
        attribute = program.add("attribute", [], [scene.attribute_id("generated:"), 1.0])
        firsts = [program.add("position", []), program.add("position_object", []), attribute]
        return program, [noise(program, first) for first in firsts]
    if name == "object":
        color = program.add("object_color", [])
        return program, [color + 1, program.add("object_random", []), program.add("object_index", [])]
    if name == "location":
        first = program.add("object_location", [])
    else:
        first = program.add("object_attribute", [], [scene.attribute_id("object:heat"), 0.0])
    return program, [first + i for i in range(3)]


@pytest.mark.parametrize("name", ["noise", "object", "location", "attribute"])
def test_a_volume_has_what_a_surface_has(name: str) -> None:
    scene = pivot_core.Scene()
    program, registers = program_of(scene, name)
    shader = pivot_core.Shader(pivot_core.Material(), program, {"emission": registers})
    attributes = {"generated:": generated(CORNERS)}
    mesh = scene.add_mesh("quad", CORNERS, np.arange(4), np.array([[0, 1, 2], [0, 2, 3]]), vertex_attributes=attributes)
    scene.add_instances(
        "quad",
        mesh,
        OBJECT_TO_WORLD[None],
        [scene.add_material("shown", shader)],
        color=COLOR,
        pass_index=PASS_INDEX,
        random=np.array([RANDOM], np.float32),
        attributes={"object:heat": OF_OBJECT},
    )
    set_camera(scene, (0.3, -0.2, 5), (0.3, -0.2, 0), size=(24, 24), half_width=0.1)
    shown = render(scene, samples=1, max_bounces=0, filter_width_px=1e-4)[..., :3].reshape(-1, 3)
    world = render(scene, "Position", samples=1, filter_width_px=1e-4)[..., :3].reshape(-1, 3).astype(float)
    points = (world - OBJECT_TO_WORLD[:3, 3]) @ np.linalg.inv(OBJECT_TO_WORLD[:3, :3].astype(float)).T
    found = program.run_at(
        points,
        OBJECT_TO_WORLD,
        registers,
        attributes={scene.attribute_id("generated:"): generated(points)},
        color=COLOR,
        pass_index=PASS_INDEX,
        random=RANDOM,
        object_attributes={scene.attribute_id("object:heat"): OF_OBJECT},
    )
    assert found.shape == shown.shape
    np.testing.assert_allclose(found, shown, atol=2e-5)
    assert np.all(np.abs(found).max(axis=0) > 0.05)
    if name == "noise":
        assert np.all(np.ptp(found, axis=0) > 0.2)


def test_each_point_has_its_own_attributes() -> None:
    """However many points there are, and in their order."""
    program = pivot_core.Program()
    first = program.add("attribute", [], [5, 1.0])
    for count in (0, 1, 3, 1000, 5001):
        values = np.random.default_rng(count).uniform(size=(count, 2)).astype(np.float32)
        found = program.run_at(np.zeros((count, 3)), np.eye(4), [first + 1, first], attributes={5: values})
        np.testing.assert_array_equal(found, values[:, ::-1])


def test_a_volume_looks_pictures_up_as_they_are_stored() -> None:
    """There is no footprint to look a smaller copy up in."""
    rng = np.random.default_rng(1)
    image = pivot_core.Image(rng.uniform(size=(32, 64, 4)).astype(np.float32))
    program, settings = pivot_core.Program(), [1.0, 0.0, 0.0, 0.0]
    uv = [(program.add("position", []), 0.0)]
    uv.append((uv[0][0] + 1, 0.0))
    first = program.add("image", uv * 3, settings, image=image)
    points = rng.uniform(size=(500, 3)).astype(np.float32)
    found = program.run_at(points, np.eye(4), [first + i for i in range(4)])
    expected = pivot_core.run_op("image", np.tile(points[:, :2], 3), settings, image)
    assert np.ptp(expected) > 0.5
    np.testing.assert_array_equal(found, expected)


def test_there_is_no_surface_in_a_volume() -> None:
    program = pivot_core.Program()
    names = ("normal", "normal_object", "true_normal", "incoming", "reflection", "backfacing")
    registers = [program.add(name, []) for name in names]
    registers.append(program.add("wireframe", [(-1, 0.1)], [1.0]))
    registers.append(program.add("attribute", [], [3, 0.0]))
    assert program.ops == [*names, "wireframe", "attribute"]
    assert np.all(program.run_at(np.ones((10, 3)), OBJECT_TO_WORLD, registers) == 0)


def test_what_cannot_be_is_refused() -> None:
    program = pivot_core.Program()
    first = program.add("position", [])
    points = np.zeros((4, 3))
    with pytest.raises(ValueError, match="no register 3"):
        program.run_at(points, np.eye(4), [first + 3])
    with pytest.raises(ValueError, match="attributes must have shape"):
        program.run_at(points, np.eye(4), [first], attributes={1: np.zeros((3, 1))})
    with pytest.raises(ValueError, match="one to four"):
        program.run_at(points, np.eye(4), [first], attributes={1: np.zeros((4, 5))})

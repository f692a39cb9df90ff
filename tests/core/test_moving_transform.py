"""What moves while the shutter is open: rays meet it where it is then, pictures are the mean over all times."""

from __future__ import annotations

from typing import Any

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import Floats, add_box, add_plane, look_at, place, render

BLACK = pivot_core.Material(diffuse=(0, 0, 0))
TIMES = (0.0, 0.2, 0.5, 0.8, 1.0)


def turned(angle_rad: float, x: float = 0.0, scale: float = 1.0) -> Floats:
    """About z, (4, 4)."""
    matrix = place(x, 0.0, 0.9, scale)[0]
    c, s = np.cos(angle_rad), np.sin(angle_rad)
    matrix[:3, :3] = matrix[:3, :3] @ np.array([[c, -s, 0], [s, c, 0], [0, 0, 1]])
    return matrix


def box_scene(matrix: Floats) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    mesh = add_box(scene, (-1.0, -0.3, -0.5), (1.0, 0.3, 0.5))
    scene.add_instances("box", mesh, matrix[None], [scene.add_material("m", BLACK)])
    scene.add_instances("floor", add_plane(scene, 3.0), place(), [0])
    scene.set_camera(look_at((0, 0, 9), (0, 0, 0)), (-0.4, 0.4, -0.4, 0.4), 8, 8)
    return scene


def rays(count: int = 2000) -> tuple[Floats, Floats]:
    generator = np.random.default_rng(3)
    origins = generator.uniform(-6, 6, (count, 3)).astype(np.float32)
    directions = generator.uniform(-1.5, 1.5, (count, 3)) - origins
    return origins, (directions / np.linalg.norm(directions, axis=1, keepdims=True)).astype(np.float32)


@pytest.mark.parametrize("time", TIMES)
@pytest.mark.parametrize("packets", [True, False])
def test_rays_meet_what_turns_where_it_is_at_their_time(time: float, packets: bool) -> None:
    """Half a turn, given by three places, while it moves and grows: between the places it turns evenly."""
    steps = [turned(angle, x, scale) for angle, x, scale in ((0.0, -1.0, 0.8), (1.5, 0.0, 1.0), (3.0, 1.0, 1.2))]
    moving, still = box_scene(steps[1]), box_scene(turned(3 * time, 2 * time - 1, 0.8 + 0.4 * time))
    moving.set_instance_motion(0, np.stack(steps))
    origins, directions = rays()
    times = np.full(len(origins), time, np.float32)
    met = moving.intersect(origins, directions, packets=packets, times=times)
    known = still.intersect(origins, directions)
    same = met[1] == known[1]
    assert (known[1] == 0).mean() > 0.07
    assert same.mean() > 0.998
    np.testing.assert_allclose(met[0][same], known[0][same], rtol=1e-3, atol=1e-3)


@pytest.mark.parametrize("time", TIMES)
def test_rays_meet_what_deforms_where_it_is_at_their_time(time: float) -> None:
    """A mesh that is stretched, in an object that moves."""
    matrix = turned(0.4)
    moving, still = box_scene(matrix), box_scene(matrix)
    corners = np.array([[(-1, 1)[i >> axis & 1] * (1, 0.3, 0.5)[axis] for axis in range(3)] for i in range(8)])
    stretch = np.array([1.5, 0.5, 1.2])
    steps = [corners * (1 + part * (stretch - 1)) for part in (-1, 0, 1)]
    moving.set_mesh_motion(0, positions=steps)
    moving.set_instance_motion(0, np.stack([turned(0.4, x) for x in (-0.5, 0.0, 0.5)]))
    still.set_mesh_motion(0, positions=[corners * (1 + (2 * time - 1) * (stretch - 1))] * 2)
    still.set_instance_transform(0, turned(0.4, time - 0.5))
    origins, directions = rays()
    met = moving.intersect(origins, directions, times=np.full(len(origins), time, np.float32))
    known = still.intersect(origins, directions)
    same = met[1] == known[1]
    assert same.mean() > 0.998
    np.testing.assert_allclose(met[0][same], known[0][same], rtol=1e-4, atol=1e-4)


def passing_lamp(shutter: list[float] | None, moves: str) -> pivot_core.Scene:
    """A square that shines, 1 m wide, and a camera whose picture is 4 m wide; one passes the other by 2 m."""
    scene = pivot_core.Scene()
    shining = scene.add_material("m", pivot_core.Material(emission=(1.0, 2.0, 4.0)))
    scene.add_instances("lamp", add_plane(scene, 0.5), place(), [shining])
    if moves == "object":
        scene.set_instance_motion(0, np.concatenate([place(-1.0), place(), place(1.0)]))
    if moves == "mesh":
        corners = np.array([[-0.5, -0.5, 0], [0.5, -0.5, 0], [0.5, 0.5, 0], [-0.5, 0.5, 0]])
        scene.set_mesh_motion(0, positions=[corners + np.array([x, 0, 0]) for x in (-1, 0, 1)])
    views = np.stack([look_at((x, 0, 5), (x, 0, 0)) for x in (1.0, 0.0, -1.0)])
    scene.set_camera(
        views[1],
        (-2.0, 2.0, -2.0, 2.0),
        32,
        32,
        projection=pivot_core.Orthographic(),
        motion=views if moves == "camera" else None,
        shutter=shutter,
    )
    return scene


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
@pytest.mark.parametrize("moves", ["object", "mesh", "camera"])
def test_a_picture_is_the_mean_over_all_times(moves: str, integrator: str) -> None:
    """The share of times at which a lamp that passes evenly covers a place is a trapezoid over the places."""
    picture = render(passing_lamp(None, moves), samples=256, filter_width_px=0.0, integrator=integrator)
    x = (np.arange(32) + 0.5) / 8 - 2
    share = np.clip((np.minimum(x + 0.5, 1) - np.maximum(x - 0.5, -1)) / 2, 0, 1)
    covered = np.abs((np.arange(32) + 0.5) / 8 - 2) < 0.5
    expected = share[None, :, None] * covered[:, None, None] * np.array([1.0, 2.0, 4.0])
    np.testing.assert_allclose(picture[..., :3], expected, atol=0.02 * 4)


def test_a_shutter_counts_each_time_by_how_far_it_is_open() -> None:
    """One that opens evenly: what passed early is darker. The share of light up to a time is its square."""
    picture = render(passing_lamp([0.0, 1.0], "object"), samples=256, filter_width_px=0.0)[16, :, 0]
    x = (np.arange(32) + 0.5) / 8 - 2
    first, last = (np.clip((edge + 1) / 2, 0, 1) for edge in (x - 0.5, x + 0.5))
    np.testing.assert_allclose(picture, last**2 - first**2, atol=0.02)


def lit_floor(strategy: str) -> Any:
    """Beside a floor a small square that shines moves quickly towards it."""
    scene = pivot_core.Scene()
    scene.add_instances(
        "floor", add_plane(scene, 4.0), place(), [scene.add_material("m", pivot_core.Material(diffuse=(1, 1, 1)))]
    )
    shining = scene.add_material("lamp", pivot_core.Material(emission=(5.0, 5.0, 5.0)))
    places = [turned(0.0, x) for x in (-1.5, 0.0, 1.5)]
    for k, matrix in enumerate(places):
        matrix[2, 3] = 1.5 - 0.5 * k
        matrix[:3, 1:3] *= -1
    scene.add_instances("lamp", add_plane(scene, 0.5), places[1][None], [shining])
    scene.set_instance_motion(1, np.stack(places))
    scene.set_camera(look_at((0, -7, 5), (0, 0, 0)), (-0.4, 0.4, -0.3, 0.3), 16, 12)
    return render(scene, samples=4096, max_bounces=1, light_sampling=strategy)[..., :3]


def test_a_mesh_that_shines_lights_from_where_it_is() -> None:
    """Light samples of its triangles at each time bring what BSDF samples find without them."""
    joint, plain = lit_floor("JOINT"), lit_floor("BSDF")
    assert joint.mean() == pytest.approx(plain.mean(), rel=0.02)
    halves = [picture.reshape(2, 6, 2, 8, 3).mean((1, 3)) for picture in (joint, plain)]
    np.testing.assert_allclose(*halves, rtol=0.06)


def test_motion_of_another_shape_is_refused() -> None:
    scene = box_scene(turned(0.0))
    with pytest.raises(ValueError, match="2 to 129 steps"):
        scene.set_instance_motion(0, turned(0.0)[None])
    with pytest.raises(ValueError, match=r"mesh 'box'.*as many vertices"):
        scene.set_mesh_motion(0, positions=[np.zeros((3, 3))] * 3)
    with pytest.raises(ValueError, match="shutter"):
        scene.set_camera(np.eye(4), (-1, 1, -1, 1), 4, 4, shutter=[1.0, -1.0])

"""A render as its user handles it: watched, stopped, edited, fed with wrong input."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pivot_core
import pytest
from scenes import add_plane, add_sphere, place, render, set_camera


def simple_scene(size: tuple[int, int] = (32, 24), emission: float = 0.25) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(0.8, 0.4, 0.2), emission=(emission, 0, 0)))
    scene.add_instances("ball", add_sphere(scene), place(0, 0, 1), [chalk])
    scene.add_instances("floor", add_plane(scene, 30.0), place(), [chalk])
    scene.add_light("key", pivot_core.SphereLight((3, -3, 5), 0.5, (20, 20, 20)))
    set_camera(scene, (0, -8, 2), (0, 0, 1), size, 0.5)
    return scene


def test_passes_hold_what_their_names_say() -> None:
    scene = simple_scene()
    session = pivot_core.Session(
        scene, pivot_core.RenderSettings(samples=4, filter_width_px=0.0, transparent_film=True)
    )
    session.start()
    assert session.wait(60.0)
    assert (session.width, session.height) == (32, 24)
    assert session.progress == 1.0
    assert session.samples_done == 4
    combined, depth, position = (session.read(name) for name in ("Combined", "Depth", "Position"))
    assert combined.shape == (24, 32, 4)
    assert depth.shape == (24, 32, 1)
    assert combined[-1, 0, 3] == 0.0  # bottom row first: the last row is sky
    assert combined[0, 16, 3] == 1.0
    assert depth[-1, 0, 0] == np.float32(1e10)
    hit = depth[..., 0] < 1e9
    eye, axis = np.array([0, -8, 2]), np.array([0, 8, -1]) / np.sqrt(65)
    np.testing.assert_allclose(depth[hit][:, 0], (position[hit] - eye) @ axis, rtol=1e-4)
    assert np.abs(np.linalg.norm(position[hit] - [0, 0, 1], axis=-1)[position[hit][:, 2] > 0.01] - 1.0).max() < 2e-3
    inside = session.read("Combined")[..., 3] == 1.0
    np.testing.assert_allclose(np.linalg.norm(session.read("Normal")[inside], axis=-1), 1.0, atol=0.1)
    np.testing.assert_allclose(session.read("DiffCol")[inside], np.tile([0.8, 0.4, 0.2], (inside.sum(), 1)), rtol=1e-5)
    np.testing.assert_allclose(session.read("Emit")[inside], np.tile([0.25, 0, 0], (inside.sum(), 1)), rtol=1e-5)
    assert 0 < session.read("Indirect").mean() < combined[..., :3].mean()
    for name, channels in (("Method", 3), ("Error", 1)):  # of the analytic integrator
        np.testing.assert_array_equal(session.read(name), np.zeros((24, 32, channels)))
    with pytest.raises(ValueError, match=r"no pass 'Beauty'.*Combined"):
        session.read("Beauty")


def test_a_window_is_a_part_of_the_whole_picture() -> None:
    """To the bit, where no lights are chosen: neighbours choose together, and a window has others at its rim."""
    scene = simple_scene(emission=0.0)
    plane = (-0.5, 0.5, -0.375, 0.375)
    camera = np.eye(4, dtype=np.float32)
    camera[:3, :3] = [[1, 0, 0], [0, 0, -1], [0, 1, 0]]
    camera[:3, 3] = 0, -8, 1
    scene.set_camera(camera, plane, 32, 24)
    whole = render(scene, samples=2)
    scene.set_camera(camera, plane, 32, 24, window=(5, 3, 20, 15))
    np.testing.assert_array_equal(render(scene, samples=2), whole[3:15, 5:20])


def test_stop_ends_a_long_render_quickly_and_keeps_what_is_done() -> None:
    session = pivot_core.Session(simple_scene((640, 360)), pivot_core.RenderSettings(samples=100_000))
    session.start()
    while session.samples_done < 1:
        session.wait(0.02)
    session.stop()
    begin = time.perf_counter()
    assert session.wait(5.0)
    assert time.perf_counter() - begin < 2.0
    assert 0.0 < session.progress < 1.0
    assert session.read("Combined")[..., 3].min() == 1.0


def test_time_limit_ends_the_render() -> None:
    session = pivot_core.Session(simple_scene(), pivot_core.RenderSettings(samples=10_000_000, time_limit_s=0.3))
    session.start()
    assert session.wait(20.0)
    assert session.samples_done >= 1


def test_edits_change_the_picture_and_nothing_else() -> None:
    scene = pivot_core.Scene()
    red = scene.add_material("red", pivot_core.Material(diffuse=(1, 0, 0)))
    ball = scene.add_instances("ball", add_sphere(scene), np.concatenate([place(), place(2)]), [red])
    key = scene.add_light("key", pivot_core.SphereLight((0, -5, 5), 0.5, (50, 50, 50)))
    set_camera(scene, (0, -8, 0), size=(32, 32))
    first = render(scene, samples=1)
    scene.set_material(red, pivot_core.Material(diffuse=(0, 1, 0)))
    green = render(scene, samples=1)
    np.testing.assert_allclose(green[..., 1], first[..., 0], rtol=1e-6)
    assert green[..., 0].max() == 0.0
    scene.set_light(key, pivot_core.SphereLight((0, -5, 5), 0.5, (100, 100, 100)))
    np.testing.assert_allclose(render(scene, samples=1)[..., 1], 2 * green[..., 1], rtol=1e-5)
    scene.set_instance_transform(ball, place(0, 0, 100)[0])
    assert render(scene, samples=1)[16, 16, 1] == 0.0
    scene.set_instance_transform(ball, place()[0])
    scene.remove_instance(ball)
    assert render(scene, samples=1)[16, 16, 1] == 0.0
    with pytest.raises(ValueError, match="instance 0 was removed"):
        scene.remove_instance(ball)
    scene.remove_light(key)
    assert render(scene, samples=1)[..., :3].max() == 0.0


def test_a_scene_under_render_cannot_be_edited() -> None:
    scene = simple_scene()
    session = pivot_core.Session(scene, pivot_core.RenderSettings(samples=1_000_000))
    session.start()
    with pytest.raises(RuntimeError, match="being rendered"):
        scene.set_world((1, 1, 1))
    session.stop()
    session.wait(5.0)
    scene.set_world((1, 1, 1))


def lamp_scene() -> pivot_core.Scene:
    """A scene whose lights and bent cones take a while to be made ready, so that sessions meet there."""
    scene = simple_scene()
    for i in range(200):
        place_m = (i % 20 - 10, i // 20 - 5, 3)
        scene.add_light(f"lamp {i}", pivot_core.SphereLight(place_m, 0.1, (0.2, 0.2, 0.2)))
    return scene


MONTE_CARLO = pivot_core.RenderSettings(samples=2, threads=1)
BENT_CONES = pivot_core.RenderSettings(integrator="ANALYTIC", occlusion="BENT_CONE", samples=1, threads=1)


def alone(settings: pivot_core.RenderSettings) -> np.ndarray:
    session = pivot_core.Session(lamp_scene(), settings)
    session.start()
    assert session.wait(60.0)
    return session.read("Combined")


def test_sessions_on_one_scene_give_the_pictures_they_give_alone() -> None:
    every_settings = (MONTE_CARLO, BENT_CONES, MONTE_CARLO, BENT_CONES)
    expected = {id(settings): alone(settings) for settings in (MONTE_CARLO, BENT_CONES)}
    for _ in range(8):
        scene = lamp_scene()
        sessions = [pivot_core.Session(scene, settings) for settings in every_settings]
        for session in sessions:
            session.start()
        with pytest.raises(RuntimeError, match="being rendered"):
            scene.set_world((1, 1, 1))
        for session, settings in zip(sessions, every_settings, strict=True):
            assert session.wait(60.0)
            np.testing.assert_array_equal(session.read("Combined"), expected[id(settings)])


def test_a_session_that_joins_a_running_one_leaves_it_alone() -> None:
    expected = alone(pivot_core.RenderSettings(samples=32, threads=1))
    scene = lamp_scene()
    session = pivot_core.Session(scene, pivot_core.RenderSettings(samples=32, threads=1))
    session.start()
    joined = 0
    while not session.wait(0.0):
        other = pivot_core.Session(scene, pivot_core.RenderSettings(samples=1, threads=1))
        other.start()
        assert other.wait(60.0)
        joined += 1
    assert joined > 1
    np.testing.assert_array_equal(session.read("Combined"), expected)


def test_a_session_that_waits_for_anothers_bent_cones_can_be_stopped() -> None:
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(1, 1, 1)))
    scene.add_instances("ball", add_sphere(scene, 300), place(), [chalk])
    set_camera(scene, (0, -8, 0), size=(16, 16))
    tracing, waiting = (pivot_core.Session(scene, BENT_CONES) for _ in range(2))
    tracing.start()
    assert not tracing.wait(1.0)  # 180 thousand vertices, 256 rays each
    waiting.start()
    waiting.stop()
    assert waiting.wait(1.0)
    assert not tracing.wait(0.0)
    tracing.stop()
    assert tracing.wait(5.0)


def test_lights_of_a_session_before_serve_where_they_are_the_same() -> None:
    """Virtual lights, which no camera changes: its picture is as if they had been traced for it."""

    def rendered(known: pivot_core.SessionLights | None, **settings: int) -> pivot_core.Session:
        all_settings = {"integrator": "ANALYTIC", "indirect": "VSGL", "virtual_lights": 64, "samples": 1} | settings
        session = pivot_core.Session(scene, pivot_core.RenderSettings(**all_settings), known)
        assert session.lights is None
        session.start()
        assert session.wait(60.0)
        return session

    scene = simple_scene()
    first = rendered(None)
    set_camera(scene, (1, -7, 3), (0, 0, 1), (32, 24), 0.5)
    again, anew = rendered(first.lights), rendered(None)
    np.testing.assert_array_equal(again.read("Combined"), anew.read("Combined"))
    assert again.read("Indirect").mean() > 0
    assert again.virtual_lights == first.virtual_lights  # to how long it took to make them
    assert again.virtual_lights != anew.virtual_lights
    more = rendered(first.lights, virtual_lights=128)
    assert more.virtual_lights[1] > first.virtual_lights[1]
    scene = simple_scene(emission=0.5)
    other, of_other = rendered(first.lights), rendered(None)
    np.testing.assert_array_equal(other.read("Combined"), of_other.read("Combined"))


def test_edits_of_what_was_removed_name_it() -> None:
    scene = pivot_core.Scene()
    key = scene.add_light("key", pivot_core.SphereLight((0, 0, 1), 0.1, (1, 1, 1)))
    scene.remove_light(key)
    with pytest.raises(ValueError, match="light 'key' was removed"):
        scene.set_light(key, pivot_core.SphereLight((0, 0, 2), 0.1, (1, 1, 1)))


@pytest.mark.parametrize(("number", "range_"), [("alpha", r"in \[0, 1\]"), ("dielectric_ior", "at least 1")])
def test_a_material_out_of_range_is_refused_by_name(number: str, range_: str) -> None:
    scene = pivot_core.Scene()
    wrong = {"alpha": 1.5, "dielectric_ior": 0.75}[number]
    with pytest.raises(ValueError, match=f"material 'Gold': {number} must be {range_}"):
        scene.add_material("Gold", pivot_core.Material(**{number: wrong}))


def test_an_object_hidden_from_the_camera_still_casts_its_shadow() -> None:
    scene = pivot_core.Scene()
    chalk = scene.add_material("chalk", pivot_core.Material(diffuse=(1, 1, 1)))
    scene.add_instances("floor", add_plane(scene), place(), [chalk])
    scene.add_light("key", pivot_core.SphereLight((0, 0, 20), 0.01, (100, 100, 100)))
    set_camera(scene, (0, 0, 10), size=(9, 9), half_width=0.02)
    lit = render(scene, samples=4, max_bounces=0)
    scene.add_instances("lid", add_sphere(scene), place(0, 0, 3), [chalk], hidden_from=["CAMERA"])
    assert lit[..., 0].min() > 0.05
    assert render(scene, samples=4, max_bounces=0)[..., 0].max() == 0.0


def triangle(**changes: object) -> dict[str, object]:
    mesh = {
        "positions": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0]], np.float32),
        "corner_vertices": np.arange(3),
        "triangle_corners": np.array([[0, 1, 2]]),
    }
    return {**mesh, **changes}


BAD_MESHES = {
    "positions must have shape": triangle(positions=np.zeros((3, 2), np.float32)),
    "vertex 1 is not finite": triangle(positions=np.array([[0, 0, 0], [np.nan, 0, 0], [0, 1, 0]], np.float32)),
    "triangle 0 has a vertex past the end of 3": triangle(corner_vertices=np.array([0, 1, 7])),
    "triangle 0 has a corner past the end of 3": triangle(triangle_corners=np.array([[0, 1, -1]])),
    "corner_normals must have shape": triangle(corner_normals=np.zeros((2, 3), np.float32)),
    "the normal of corner 2 is not finite": triangle(corner_normals=np.array([[0, 0, 1], [0, 0, 1], [np.inf, 0, 0]])),
    "triangle_slots must have shape": triangle(triangle_slots=np.zeros(5, np.int32)),
}


@pytest.mark.parametrize("message", BAD_MESHES)
def test_a_bad_mesh_is_named_with_its_fault(message: str) -> None:
    with pytest.raises(ValueError, match=f"mesh 'Suzanne': {message}"):
        pivot_core.Scene().add_mesh("Suzanne", **BAD_MESHES[message])


def test_bad_objects_lights_and_settings_are_named() -> None:
    scene = pivot_core.Scene()
    mesh = scene.add_mesh("t", **triangle())
    material = scene.add_material("m", pivot_core.Material())
    broken = place()
    broken[0, 1, 1] = np.nan
    with pytest.raises(ValueError, match="object 'Cube': its transform is not finite"):
        scene.add_instances("Cube", mesh, broken, [material])
    with pytest.raises(ValueError, match="material 7 is not in the scene"):
        scene.add_instances("Cube", mesh, place(), [7])
    with pytest.raises(ValueError, match="mesh 3 is not in the scene"):
        scene.add_instances("Cube", 3, place(), [material])
    with pytest.raises(ValueError, match="material 'Gold': a value is negative or not finite"):
        scene.add_material("Gold", pivot_core.Material(diffuse=(np.nan, 0, 0)))
    with pytest.raises(ValueError, match="radius_m"):
        pivot_core.SphereLight((0, 0, 0), -1.0, (1, 1, 1))
    with pytest.raises(ValueError, match="direction must be a unit vector"):
        pivot_core.SunLight((0, 0, 2), 0.1, (1, 1, 1))
    with pytest.raises(ValueError, match="span an area"):
        pivot_core.AreaLight((0, 0, 0), (1, 0, 0), (2, 0, 0), (1, 1, 1))
    with pytest.raises(ValueError, match="light_sampling must be one of JOINT, SPTD"):
        pivot_core.RenderSettings(light_sampling="MAGIC")
    with pytest.raises(ValueError, match="analytic_method must be one of AUTO, EXACT, SPTD, LTC, not 'MAGIC'"):
        pivot_core.RenderSettings(analytic_method="MAGIC")
    with pytest.raises(ValueError, match="occlusion must be one of RAY_TRACED, BENT_CONE, NONE, not 'MAGIC'"):
        pivot_core.RenderSettings(occlusion="MAGIC")
    with pytest.raises(ValueError, match="samples must be at least 1"):
        pivot_core.RenderSettings(samples=0)
    with pytest.raises(ValueError, match="no camera"):
        pivot_core.Session(scene, pivot_core.RenderSettings())


def test_degenerate_geometry_renders_without_a_bad_sample() -> None:
    """Objects scaled flat or to nothing, triangles without area, normals of length zero."""
    scene = pivot_core.Scene()
    material = scene.add_material("m", pivot_core.Material(diffuse=(1, 1, 1), alpha=0.1, dielectric_weight=1.0))
    flat = place()
    flat[0, 2, 2] = 0.0
    scene.add_instances("flat", add_sphere(scene, 16), flat, [material])
    scene.add_instances("nothing", add_sphere(scene, 16), place(scale=0.0), [material])
    sliver = triangle(positions=np.array([[0, 0, 0.5], [1, 0, 0.5], [2, 0, 0.5]], np.float32))
    scene.add_instances("sliver", scene.add_mesh("sliver", **sliver), place(), [material])
    blank = triangle(corner_normals=np.zeros((3, 3), np.float32))
    scene.add_instances("blank", scene.add_mesh("blank", **blank), place(0, 0, 0.7), [material])
    scene.add_light("key", pivot_core.SphereLight((0, 0, 5), 1.0, (50, 50, 50)))
    set_camera(scene, (0, -0.5, 6), size=(64, 64))
    image = render(scene, samples=4)  # asserts that no sample was bad
    assert np.isfinite(image).all()
    assert image[32, 32, 0] > 0.1


@pytest.mark.parametrize("arch", ["v2", "v3"])
def test_every_build_that_this_cpu_runs_renders_the_same(arch: str) -> None:
    here = Path(__file__).parent
    package = Path(pivot_core.__file__).parent
    if not list(package.glob(f"_core_{arch}*.so")) or pivot_core._cpu.level() < arch:
        pytest.skip(f"x86-64-{arch} is not built, or not run by this CPU")
    program = (
        "import json, pivot_core, test_session\n"
        "image = test_session.render(test_session.simple_scene(), samples=8)\n"
        "print(json.dumps([pivot_core.arch, float(image[..., :3].mean())]))"
    )
    environment = {**os.environ, "PIVOT_ARCH": arch, "PYTHONPATH": f"{package.parent}:{here}"}
    output = subprocess.run(
        [sys.executable, "-c", program], env=environment, capture_output=True, text=True, check=True
    ).stdout
    loaded, mean = json.loads(output)
    assert loaded == arch
    np.testing.assert_allclose(mean, render(simple_scene(), samples=8)[..., :3].mean(), rtol=1e-3)

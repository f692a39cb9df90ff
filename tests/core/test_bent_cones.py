"""Bent cones against what is known of simple surroundings, and the specular occlusion they give against traced rays."""

import numpy as np
import pivot_core
import pivot_core.bsdf as bsdf
import pivot_core.distributions as pd
import pivot_core.tables as tables
import pytest
from scenes import add_plane, add_sphere, place, render, set_camera

UP = np.array([0.0, 0.0, 1.0])


def new_scene(**material: object) -> tuple[pivot_core.Scene, int]:
    scene = pivot_core.Scene()
    set_camera(scene, (0, -8, 2))
    return scene, scene.add_material("chalk", pivot_core.Material(**material))


def add_grid(scene: pivot_core.Scene, quads: int, heights_m: np.ndarray | float = 0.0) -> int:
    """The square [-1, 1]^2 at the heights (quads + 1, quads + 1), flat-shaded; returns the mesh id."""
    x, y = np.meshgrid(*[np.linspace(-1, 1, quads + 1)] * 2, indexing="ij")
    vertices = np.stack([x, y, np.broadcast_to(heights_m, x.shape)], -1).reshape(-1, 3).astype(np.float32)
    a = (np.arange(quads)[:, None] * (quads + 1) + np.arange(quads)).ravel()
    across = a + quads + 2
    triangles = np.concatenate([np.stack([a, a + quads + 1, across], 1), np.stack([a, across, a + 1], 1)])
    return scene.add_mesh("grid", vertices, triangles.ravel(), np.arange(triangles.size).reshape(-1, 3))


def add_wall(scene: pivot_core.Scene, height_m: float) -> int:
    """A round wall about the z axis, of radius 1; returns the mesh id."""
    phi = np.linspace(0, 2 * np.pi, 65)
    ring = np.stack([np.cos(phi), np.sin(phi), 0 * phi], -1)
    vertices = np.concatenate([ring, ring + height_m * UP]).astype(np.float32)
    a = np.arange(64)
    triangles = np.concatenate([np.stack([a, a + 1, a + 66], 1), np.stack([a, a + 66, a + 65], 1)])
    return scene.add_mesh("wall", vertices, triangles.ravel(), np.arange(triangles.size).reshape(-1, 3))


def cones_below(scene: pivot_core.Scene, places: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    return scene.bent_cones(places + 1e-3 * UP, np.tile(-UP, (len(places), 1)))


def test_with_nothing_around_the_hemisphere_is_free() -> None:
    """On both sides of a plane, and all over a sphere: at its seam and poles too."""
    scene, chalk = new_scene()
    scene.add_instances("plane", add_plane(scene, 1.0), place(), [chalk])
    for side in (1, -1):
        axis, versine = scene.bent_cones(np.array([[0.2, 0.3, side]]), np.array([[0, 0, -side]]))
        assert versine[0] == pytest.approx(1, abs=1e-6)
        np.testing.assert_allclose(axis[0], [0, 0, side], atol=1e-6)
    scene, chalk = new_scene()
    scene.add_instances("ball", add_sphere(scene, 16), place(0, 0, 50, scale=3), [chalk])
    outwards = pd.cap_sample(UP, 2.0, np.random.default_rng(0).random((200, 2)))
    axis, versine = scene.bent_cones([0, 0, 50] + 5 * outwards, -outwards)
    np.testing.assert_allclose(versine, 1, atol=1e-6)
    np.testing.assert_allclose(axis, outwards, atol=0.02)


def test_a_well_leaves_a_cone() -> None:
    scene, chalk = new_scene()
    scene.add_instances("floor", add_grid(scene, 40), place(), [chalk])
    scene.add_instances("wall", add_wall(scene, 0.75), place(), [chalk])
    axis, versine = cones_below(scene, np.array([[0.0, 0.0, 0.0], [0.5, 0.0, 0.0]]))
    assert versine[0] == pytest.approx(1 - 0.75 / 1.25, abs=0.02)
    np.testing.assert_allclose(axis[0], UP, atol=0.02)
    assert axis[1][0] < -0.1  # leans towards the open side
    assert versine[1] < versine[0]


def test_walls_of_the_same_mesh_occlude_at_their_foot() -> None:
    """Where a floor meets its wall, half of the sky is left: rays do not leak behind the wall."""
    scene, chalk = new_scene()
    x = np.linspace(-1, 1, 41)
    heights = np.where(x > 0.51, 100.0, 0.0)[:, None] * np.ones(41)
    scene.add_instances("step", add_grid(scene, 40, heights), place(), [chalk])
    axis, versine = cones_below(scene, np.array([[0.4999, 0.0, 0.0]]))
    assert versine[0] == pytest.approx(0.5, abs=0.03)
    np.testing.assert_allclose(axis[0], np.sqrt([0.5, 0, 0.5]) * [-1, 0, 1], atol=0.05)


def test_what_lies_beyond_the_lights_does_not_occlude() -> None:
    scene, chalk = new_scene()
    scene.add_instances("room", add_sphere(scene), place(0, 0, 0, scale=10), [chalk])
    scene.add_instances("table", add_grid(scene, 2), place(), [chalk])
    lamp = scene.add_light("lamp", pivot_core.SphereLight((0, 0, 5), 0.1, (1, 1, 1)))
    assert cones_below(scene, np.zeros((1, 3)))[1][0] == 1
    scene.add_light("sun", pivot_core.SunLight((0, 0, 1), 0.1, (1, 1, 1)))
    assert cones_below(scene, np.zeros((1, 3)))[1][0] == 0
    scene.remove_light(lamp)
    assert cones_below(scene, np.zeros((1, 3)))[1][0] == 0


def test_cones_follow_edits_and_repeat() -> None:
    scene, chalk = new_scene()
    scene.add_instances("floor", add_grid(scene, 8), place(), [chalk])
    lid = scene.add_instances("lid", add_sphere(scene, 16), place(0, 0, 1.2), [chalk])
    places = np.random.default_rng(1).uniform(-0.9, 0.9, (50, 3)) * [1, 1, 0]
    first = cones_below(scene, places)
    assert first[1].max() < 0.9
    scene.set_instance_transform(lid, place(0, 0, 500)[0])
    assert cones_below(scene, places)[1].min() > 0.95
    scene.set_instance_transform(lid, place(0, 0, 1.2)[0])
    np.testing.assert_array_equal(np.column_stack(cones_below(scene, places)), np.column_stack(first))


def test_a_ray_into_nothing_is_named() -> None:
    scene, _ = new_scene()
    with pytest.raises(ValueError, match="ray 0 meets nothing"):
        scene.bent_cones(np.zeros((1, 3)), UP[None])


def test_without_occluders_all_light_is_seen() -> None:
    scene, chalk = new_scene(diffuse=(0.5, 0.5, 0.5), alpha=0.2, dielectric_weight=1.0)
    scene.add_instances("plane", add_plane(scene, 1.0), place(), [chalk])
    origins = np.array([[0.3, 0.2, 1.0], [3.0, 0.0, 0.5]])
    directions = -origins / np.linalg.norm(origins, axis=-1, keepdims=True)
    lights = (
        pivot_core.SphereLight((0, 0, 3), 1.0, (1, 1, 1)),
        pivot_core.SphereLight((3, 0, 0.1), 1.0, (1, 1, 1)),  # half below the horizon
        pivot_core.SunLight((0.6, 0, 0.8), 0.005, (1, 1, 1)),
        pivot_core.AreaLight((0, -2, 2), (1, 0, 0), (0, 0.5, 0.5), (1, 1, 1), ellipse=True),
        None,
    )
    for light in lights:
        np.testing.assert_allclose(scene.seen_shares(origins, directions, light), 1, atol=1e-3)


def test_specular_occlusion_beats_separable_ones() -> None:
    """On the floor of a well, against rays: the triple product of lobe, light and bent cone; lobe and visibility apart
    from the light [Dupuy17 (21)]; light and visibility apart from the lobe."""
    rng = np.random.default_rng(1)
    count = 100
    wo = rng.normal(size=(count, 3))
    wo[:, 2] = np.abs(wo[:, 2]) + 0.2
    wo /= np.linalg.norm(wo, axis=-1, keepdims=True)
    to_light = wo * [-1, -1, 1] + 0.4 * rng.normal(size=(count, 3))
    to_light[:, 2] = np.abs(to_light[:, 2])
    to_light /= np.linalg.norm(to_light, axis=-1, keepdims=True)
    half_angle = rng.uniform(0.1, 0.6, count)
    radius, phi = np.sqrt(rng.uniform(0, 0.8, count)), rng.uniform(0, 2 * np.pi, count)
    places = np.stack([radius * np.cos(phi), radius * np.sin(phi), 0 * phi], -1)

    errors: dict[str, list[float]] = {"triple": [], "lobe x visibility": [], "light x visibility": []}
    for alpha in (0.1, 0.25, 0.5, 0.8):
        scene, chalk = new_scene(alpha=alpha, conductor_f0=(1, 1, 1), conductor_f90=(1, 1, 1))
        scene.add_instances("floor", add_grid(scene, 60), place(), [chalk])
        scene.add_instances("wall", add_wall(scene, 0.6), place(), [chalk])
        cone_axes, cone_versines = (part.astype(np.float64) for part in cones_below(scene, places))
        cone_axes /= np.linalg.norm(cone_axes, axis=-1, keepdims=True)
        for i in range(count):
            versine = 1 - np.cos(half_angle[i])
            wi = pd.cap_sample(to_light[i], versine, stratified(512))
            lobe = np.where(wi[:, 2] > 0, bsdf.ggx_eval(alpha, wo[i], wi), 0)
            starts = np.tile(places[i] + 1e-4 * UP, (512, 1))
            free = ~scene.occluded(starts, wi, np.full(512, np.inf))
            unoccluded, truth = lobe.mean() * versine, (lobe * free).mean() * versine

            light = pivot_core.SunLight(tuple(to_light[i]), half_angle[i], (1, 1, 1))
            shares = {"triple": scene.seen_shares(places[i : i + 1] + wo[i] * 1e-2, -wo[i : i + 1], light)[1][0]}
            pivot, delta, *_ = tables.ggx_sptd(alpha, wo[i])
            pivot /= np.linalg.norm(pivot)
            cone, cap, sky = (cone_axes[i], cone_versines[i]), (to_light[i], versine), (UP, 1.0)
            shares["lobe x visibility"] = pd.sptd_uniform_integral2(*cone, *sky, pivot, delta) / (
                pd.sptd_uniform_integral(*sky, pivot, delta)
            )
            shares["light x visibility"] = pd.sptd_uniform_integral3(*cap, *cone, *sky, UP, 1.0) / (
                pd.sptd_uniform_integral2(*cap, *sky, UP, 1.0)
            )
            for name, share in shares.items():
                errors[name].append(share * unoccluded - truth)
    mean = {name: np.mean(np.abs(values)) for name, values in errors.items()}
    assert mean["triple"] < 0.4 * mean["lobe x visibility"]
    assert mean["triple"] < 0.4 * mean["light x visibility"]


def stratified(count: int) -> np.ndarray:
    i = np.arange(count) + 0.5
    return np.stack([i / count, (i * 0.6180339887) % 1], -1)


def test_rendered_occlusion() -> None:
    """On the floor of a well: by 'NONE' nothing hides a light, and 'BENT_CONE' leaves its share of that, per lobe."""
    eye = (0.0, -0.5, 6.0)
    flat = {"integrator": "ANALYTIC", "samples": 1, "filter_width_px": 0.0}
    mirror = {"alpha": 0.6, "conductor_f0": (1, 1, 1), "conductor_f90": (1, 1, 1)}
    for lobe, material in enumerate(({"diffuse": (0.8, 0.8, 0.8)}, mirror)):
        scene, chalk = new_scene(**material)
        scene.add_instances("floor", add_grid(scene, 20), place(), [chalk])
        light = pivot_core.SphereLight((3, 0, 2.5), 1.0, (50, 50, 50))
        scene.add_light("lamp", light)
        set_camera(scene, eye, size=(9, 9), half_width=0.08)
        unoccluded = render(scene, **flat)[..., 0]
        wall = scene.add_instances("wall", add_wall(scene, 0.8), place(), [chalk])
        towards = render(scene, "Position", **flat).reshape(-1, 3) - eye
        towards /= np.linalg.norm(towards, axis=-1, keepdims=True)
        share = scene.seen_shares(np.tile(eye, (81, 1)), towards, light)[lobe].reshape(9, 9)
        assert share.min() < 0.3
        assert share.max() > 0.7
        np.testing.assert_allclose(render(scene, **flat, occlusion="NONE")[..., 0], unoccluded, rtol=1e-5)
        bent = render(scene, **flat, occlusion="BENT_CONE")[..., 0]
        np.testing.assert_allclose(bent, share * unoccluded, rtol=1e-3, atol=1e-4)
        traced = render(scene, **flat)[..., 0]
        assert np.abs(bent - traced).mean() < 0.3 * np.abs(unoccluded - traced).mean()
        scene.remove_instance(wall)
        np.testing.assert_allclose(render(scene, **flat, occlusion="BENT_CONE")[..., 0], unoccluded, rtol=1e-3)

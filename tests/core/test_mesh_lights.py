"""Emissive meshes are lights: every way to sample them gives one picture, that of the sphere they stand for."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import Floats, add_plane, add_sphere, place, render, set_camera

LIGHT_SAMPLING = ("JOINT", "SPTD", "MIS", "LIGHT", "BSDF")
EMISSION = (5.0, 4.0, 3.0)


def stripes() -> pivot_core.Shader:
    """Of 0.1 m, some bright and some dark, of the one colour on one side and of the other on the other."""
    program = pivot_core.Program()
    x = program.add("position", [])
    wave = program.add("math_sine", [(program.add("math_multiply", [(x, 0.0), (-1, 30.0)]), 0.0)])
    bright = program.add("math_greater_than", [(wave, 0.0), (-1, 0.5)])
    back = program.add("backfacing", [])
    red = program.add("math_multiply", [(bright, 0.0), (-1, 15.0)])
    blue = program.add("math_multiply", [(bright, 0.0), (back, 0.0)])
    return pivot_core.Shader(pivot_core.Material(), program, {"emission": [red, bright, blue]})


def scene_with(shape: str, lamp: bool = False) -> pivot_core.Scene:
    """A plastic and a metal ball on a floor, under a panel near or far, or a bulb of a thousand triangles."""
    scene = pivot_core.Scene()
    lobes = [("translucent", {"color": (0.2, 0.3, 0.1)})] if "leaves" in shape else []
    plastic = scene.add_material(
        "plastic", pivot_core.Material(diffuse=(0.5,) * 3, alpha=0.3, dielectric_weight=1.0, lobes=lobes)
    )
    metal = scene.add_material("metal", pivot_core.Material(alpha=0.1, conductor_f0=(0.8,) * 3, conductor_f90=(1,) * 3))
    glow = scene.add_material("glow", stripes() if "stripes" in shape else pivot_core.Material(emission=EMISSION))
    scene.add_instances("floor", add_plane(scene, 10), place(), [plastic])
    scene.add_instances("plastic ball", add_sphere(scene), place(0, 0, 0.5, 0.5), [plastic])
    scene.add_instances("metal ball", add_sphere(scene), place(1.2, 0, 0.4, 0.4), [metal])
    if "bulb" in shape:
        scene.add_instances("bulb", add_sphere(scene, 16), place(-1, -0.5, 1.2, 0.3), [glow])
    else:
        near = "near panel" in shape
        panel = add_plane(scene, 2.0 if near else 0.5)
        scene.add_instances("panel", panel, place(0, 0, 1.2 if near else 2.0), [glow])
    if lamp:
        scene.add_light("lamp", pivot_core.SphereLight((2, -2, 3), 0.5, (5, 5, 5)))
    set_camera(scene, (0, -5, 3), (0, 0, 0.5), (24, 18), 0.35)
    return scene


def mean_and_error(scene: pivot_core.Scene, **settings: object) -> tuple[float, float]:
    """Of the picture's mean radiance, by the spread of independent renders."""
    means = [float(render(scene, seed=seed, **settings)[..., :3].mean(dtype=float)) for seed in range(8)]
    return float(np.mean(means)), float(np.std(means, ddof=1) / np.sqrt(len(means)))


@pytest.mark.parametrize("lamp", [False, True], ids=["alone", "and a lamp"])
@pytest.mark.parametrize(
    "shape",
    ["panel", "near panel", "bulb", "panel of stripes", "near panel of stripes", "bulb of stripes over leaves"],
)
def test_every_light_sampling_gives_one_picture(shape: str, lamp: bool) -> None:
    scene = scene_with(shape, lamp)
    samples = {m: 256 if m == "BSDF" else 32 for m in LIGHT_SAMPLING}
    if lamp:
        samples.pop("BSDF")  # which finds a lamp this small too rarely
    results = {m: mean_and_error(scene, samples=n, light_sampling=m, max_bounces=2) for m, n in samples.items()}
    mean, error = results.pop("MIS")
    for mode, (other, other_error) in results.items():
        assert abs(other - mean) < 4 * np.hypot(error, other_error) + 1e-3 * mean, f"{mode}: {other}, MIS: {mean}"


def test_light_that_varies_over_a_mesh_is_sampled() -> None:
    """The noise that it makes of the floor, beside BSDF samples alone."""
    scene = scene_with("bulb of stripes")
    noise = {}
    for mode in ("JOINT", "BSDF"):
        pictures = [render(scene, samples=16, seed=seed, light_sampling=mode, max_bounces=0) for seed in range(8)]
        noise[mode] = float(np.var(pictures, axis=0)[:6, :, :3].mean())
    assert noise["JOINT"] < noise["BSDF"] / 10


def test_an_edit_of_light_that_varies_is_seen() -> None:
    """To other places of a mesh, and to none."""
    scene = scene_with("panel of stripes")
    bright = render(scene, samples=64)[..., :3].mean()
    scene.set_material(2, pivot_core.Material())
    assert render(scene, samples=4)[..., :3].mean() == 0
    scene.set_material(2, stripes())
    np.testing.assert_allclose(render(scene, samples=64)[..., :3].mean(), bright, rtol=0.05)


def floor_under(light: str, rings: int = 48) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5,) * 3))
    scene.add_instances("floor", add_plane(scene, 10), place(), [grey])
    if light == "mesh":
        glow = scene.add_material("glow", pivot_core.Material(emission=EMISSION))
        scene.add_instances("bulb", add_sphere(scene, rings), place(-1, 0, 1, 0.2), [glow], hidden_from=["CAMERA"])
    else:
        intensity = np.pi * 0.2**2 * np.array(EMISSION)
        scene.add_light("bulb", pivot_core.SphereLight((-1, 0, 1), 0.2, intensity))
    set_camera(scene, (0, -5, 3), size=(16, 12), half_width=0.2)
    return scene


@pytest.mark.parametrize("mode", ["JOINT", "LIGHT"])
def test_a_ball_of_triangles_shines_like_a_sphere_light(mode: str) -> None:
    pictures: list[Floats] = [
        render(floor_under(light), samples=256, max_bounces=0, light_sampling=mode)[..., :3]
        for light in ("mesh", "lamp")
    ]
    np.testing.assert_allclose(pictures[0].mean((0, 1)), pictures[1].mean((0, 1)), rtol=0.01)


def test_only_triangles_of_an_emissive_slot_shine_and_both_of_their_sides() -> None:
    """A panel of two triangles, one of them black: from above and below it is half as bright as with both."""

    def lit(materials: list[pivot_core.Material], z: float) -> float:
        scene = pivot_core.Scene()
        grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5,) * 3))
        scene.add_instances("floor", add_plane(scene, 10), place(0, 0, z), [grey])
        corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
        panel = scene.add_mesh(
            "panel", corners, np.arange(4), np.array([[0, 1, 2], [0, 2, 3]]), triangle_slots=np.array([0, 1])
        )
        ids = [scene.add_material(f"{i}", material) for i, material in enumerate(materials)]
        scene.add_instances("panel", panel, place(), ids, hidden_from=["CAMERA"])
        set_camera(scene, (0, -0.1, 20 if z < 0 else -20), (0, 0, z), (8, 8), 0.05)
        return float(render(scene, samples=64, max_bounces=0, light_sampling="LIGHT")[..., :3].mean())

    glow, black = pivot_core.Material(emission=EMISSION), pivot_core.Material()
    for z in (-2.0, 2.0):
        both = lit([glow, glow], z)
        assert both > 0.1
        np.testing.assert_allclose(lit([glow, black], z) + lit([black, glow], z), both, rtol=0.02)


@pytest.mark.parametrize("mode", ["JOINT", "LIGHT", "MIS", "BSDF"])
def test_faces_in_one_place_shine_once(mode: str) -> None:
    """Of a copy that a modifier leaves, turned over, rays meet one face of two."""

    def lit(copies: int) -> float:
        scene = pivot_core.Scene()
        grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5,) * 3))
        scene.add_instances("floor", add_plane(scene, 10), place(0, 0, -2), [grey])
        corners = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]] * copies, np.float32)
        triangles = np.array([[0, 1, 2], [0, 2, 3], [6, 5, 4], [7, 6, 4]][: 2 * copies])
        panel = scene.add_mesh("panel", corners, np.arange(4 * copies), triangles)
        glow = scene.add_material("glow", pivot_core.Material(emission=EMISSION))
        scene.add_instances("panel", panel, place(), [glow], hidden_from=["CAMERA"])
        set_camera(scene, (0, -0.1, 20), (0, 0, -2), (8, 8), 0.05)
        return float(render(scene, samples=256, max_bounces=0, light_sampling=mode)[..., :3].mean())

    assert lit(2) == pytest.approx(lit(1), rel=0.02)


def test_emission_is_followed_by_edits() -> None:
    scene = floor_under("mesh", 8)
    first = render(scene, samples=16, max_bounces=0)[..., 0].mean()
    scene.set_material(1, pivot_core.Material(emission=tuple(2 * e for e in EMISSION)))
    np.testing.assert_allclose(render(scene, samples=16, max_bounces=0)[..., 0].mean(), 2 * first, rtol=1e-5)
    scene.set_material(1, pivot_core.Material())
    assert render(scene, samples=16, max_bounces=0)[..., 0].max() == 0.0


def test_many_triangles_are_less_noise_than_material_samples() -> None:
    """What sampling them is for."""
    scene = floor_under("mesh", 32)
    exact = render(scene, samples=4096, max_bounces=0, light_sampling="LIGHT")[..., 0]
    errors = {
        mode: float(np.mean((render(scene, samples=16, max_bounces=0, light_sampling=mode)[..., 0] - exact) ** 2))
        for mode in ("JOINT", "BSDF")
    }
    assert errors["JOINT"] < 0.02 * errors["BSDF"]

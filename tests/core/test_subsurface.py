"""Light that walks beneath a surface: what comes out, and where, against closed forms and a walk of its own."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from numpy.typing import NDArray
from scenes import add_box, add_plane, add_sphere, place, render, set_camera

Array = NDArray[np.float64]
GREY = (0.5, 0.5, 0.5)


def beneath(**given: object) -> pivot_core.Material:
    """Of one number for all colours where that is given; what enters does so by the cosine."""
    wide = {name: (value,) * 3 if np.isscalar(value) else value for name, value in given.items() if name in WIDE}
    return pivot_core.Material(lobes=[("subsurface", {"cosine_entry": 1.0} | given | wide)])


WIDE = {"color", "albedo", "radius_m"}


def scene_of(mesh: str, material: pivot_core.Material) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    add = {
        "ball": lambda: add_sphere(scene),
        "sheet": lambda: add_plane(scene, 50.0),
        "slab": lambda: add_box(scene, (-50, -50, -1), (50, 50, 0)),
    }
    scene.add_instances("object", add[mesh](), place(), [scene.add_material("inside", material)])
    set_camera(scene, (0, 0, 5), size=(16, 16), half_width=0.1)
    return scene


def furnace(mesh: str, material: pivot_core.Material, samples: int = 64) -> Array:
    scene = scene_of(mesh, material)
    scene.set_world((1, 1, 1))
    return render(scene, samples=samples, max_bounces=0)[..., :3].mean((0, 1)).astype(float)


@pytest.mark.parametrize(
    "inside",
    [
        {"radius_m": 0.3},
        {"radius_m": 0.01},
        {"radius_m": 0.1, "anisotropy": 0.8},
        {"radius_m": 0.1, "anisotropy": -0.5, "is_similar": 1.0},
        {"radius_m": 0.1, "cosine_entry": 0.0, "entry_alpha": 0.3, "ior": 1.5},
        {"radius_m": 0.3, "is_diffusion_length": 1.0, "cosine_entry": 0.5},
    ],
)
def test_white_keeps_all_light(inside: dict[str, object]) -> None:
    """But for the millionth of each scattering that is absorbed."""
    np.testing.assert_allclose(furnace("ball", beneath(color=1.0, albedo=1.0, **inside)), 1, rtol=2e-3)


def test_colours_whose_radii_differ_share_walks_without_bias() -> None:
    seen = furnace("ball", beneath(color=1.0, albedo=1.0, radius_m=(0.3, 0.1, 0.03)), 512)
    np.testing.assert_allclose(seen, 1, rtol=0.01)


@pytest.mark.parametrize("kind", [{}, {"is_similar": 1.0}, {"anisotropy": 0.5, "is_similar": 1.0}])
@pytest.mark.parametrize("albedo", [0.15, 0.5, 0.85])
def test_a_half_space_sends_back_the_colour(albedo: float, kind: dict[str, object]) -> None:
    """As well as the fits of the albedo do."""
    seen = furnace("sheet", beneath(color=albedo, albedo=albedo, radius_m=0.1, **kind), 128)
    np.testing.assert_allclose(seen, albedo, rtol=0.035)


def test_next_to_no_radius_is_a_diffuse_surface() -> None:
    pictures = [
        render(lit, samples=64, max_bounces=2)[..., :3]
        for lit in map(
            under_sphere,
            (beneath(color=GREY, albedo=GREY, radius_m=1e-9), pivot_core.Material(diffuse=GREY)),
        )
    ]
    np.testing.assert_allclose(pictures[0].mean(), pictures[1].mean(), rtol=5e-3)


def under_sphere(material: pivot_core.Material) -> pivot_core.Scene:
    scene = scene_of("ball", material)
    scene.add_light("sphere", pivot_core.SphereLight((1, 1, 4), 0.5, (5, 5, 5)))
    scene.set_world((0.2, 0.2, 0.2))
    return scene


def shares_of_slab(sigma_t: float, scattered: float, g: float, count: int = 200_000) -> tuple[float, float]:
    """What of light that enters a slab 1 m thick by the cosine comes back, and what comes through."""
    random = np.random.default_rng(1)
    depth, weight = np.zeros(count), np.ones(count)
    down = np.sqrt(random.random(count))
    out = np.zeros(2)
    while len(depth) > 0:
        depth = depth + down * random.exponential(1 / sigma_t, len(depth))
        for side, is_out in enumerate((depth <= 0, depth >= 1)):
            out[side] += weight[is_out].sum()
        stays = (depth > 0) & (depth < 1) & (weight > 1e-4)
        depth, weight, down = depth[stays], weight[stays] * scattered, down[stays]
        xi, turn = random.random(len(depth)), 2 * np.pi * random.random(len(depth))
        mu = 2 * xi - 1
        if g != 0:
            mu = (1 + g * g - ((1 - g * g) / (1 - g + 2 * g * xi)) ** 2) / (2 * g)
        down = down * mu + np.sqrt((1 - down**2) * (1 - mu**2)) * np.cos(turn)
    return out[0] / count, out[1] / count


@pytest.mark.parametrize("g", [0.0, 0.6])
def test_a_slab_lets_through_what_a_walk_does(g: float) -> None:
    """By similarity, which tells the albedo of a scattering in a line; the walk here is anisotropic throughout."""
    albedo, radius_m = 0.9, 0.4
    s = 4.20863 * albedo + 4.09712 - np.sqrt(9.59217 + 41.6808 * albedo + 17.7126 * albedo**2)
    reflected, through = shares_of_slab(1 / radius_m, (1 - s * s) / (1 - g * s * s), g)
    material = beneath(color=albedo, albedo=albedo, radius_m=radius_m, anisotropy=g, is_similar=1.0)
    for side, share in ((1.0, reflected), (-1.0, through)):
        scene = scene_of("slab", material)
        scene.add_light("sun", pivot_core.SunLight((0, 0, side), 0.01, (1, 1, 1)))
        seen = render(scene, samples=256, max_bounces=0)[..., :3].mean()
        assert seen * np.pi == pytest.approx(share, rel=0.02)


def test_a_dark_path_keeps_its_bounds() -> None:
    """Whatever the numbers: render() refuses pictures with bad samples."""
    for albedo in (0.0, 1e-6, 1.0):
        for radius_m in (0.0, 1e-8, 1e-4, 1e9):
            for g in (-0.99, 0.0, 0.99):
                material = beneath(color=1.0, albedo=albedo, radius_m=radius_m, anisotropy=g)
                scene = under_sphere(material)
                seen = render(scene, samples=1, max_bounces=2)
                assert np.isfinite(seen).all(), (albedo, radius_m, g)


def test_what_is_scaled_flat_is_a_diffuse_surface() -> None:
    scene = pivot_core.Scene()
    flat = place()
    flat[0, 2, 2] = 0.0
    inside = scene.add_material("inside", beneath(color=0.8, albedo=0.8, radius_m=0.1))
    scene.add_instances("flat", add_sphere(scene), flat, [inside])
    scene.set_world((1, 1, 1))
    set_camera(scene, (0, 0, 5), size=(8, 8))
    seen = render(scene, samples=16, max_bounces=0)[3:5, 3:5, :3]
    np.testing.assert_allclose(seen, 0.8, rtol=0.1)


def test_only_some_walk_after_diffuse_reflection() -> None:
    """A sheet that is seen by way of a white wall shines through from behind, or is a diffuse surface there."""

    def by_the_wall(always: float) -> float:
        scene = scene_of("slab", beneath(color=0.8, albedo=0.8, radius_m=0.5, is_always_walked=always))
        white = scene.add_material("white", pivot_core.Material(diffuse=(1, 1, 1)))
        wall = place(scale=1.0)
        wall[0, :3, :3] = [[1, 0, 0], [0, -1, 0], [0, 0, -1]]
        wall[0, 2, 3] = 2.0
        scene.add_instances("wall", add_plane(scene, 50.0), wall, [white])
        scene.add_light("below", pivot_core.SunLight((0, 0, -1), 0.01, (1, 1, 1)))
        set_camera(scene, (0, 0.5, 1), (0, 0, 2), size=(4, 4))
        return float(render(scene, samples=64, max_bounces=1)[..., :3].mean())

    assert by_the_wall(1.0) > 0.01
    assert by_the_wall(0.0) == 0.0

"""What a film keeps for a denoiser: of each pixel, its own samples."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import Floats, add_plane, add_sphere, place, set_camera

DENOISING_PASSES = ("Noisy Image", "Noisy Indirect", "Denoising Albedo", "Denoising Normal")
VARIANCES = ("Direct Variance", "Indirect Variance")
BOX = {"pixel_filter": "BOX", "filter_width_px": 0.0}


def ball_on_a_floor() -> pivot_core.Scene:
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.6, 0.5, 0.4)))
    metal = scene.add_material(
        "metal", pivot_core.Material(alpha=0.3, conductor_f0=(0.9, 0.6, 0.3), conductor_f90=(1,) * 3)
    )
    scene.add_instances("floor", add_plane(scene, 5), place(), [grey])
    scene.add_instances("ball", add_sphere(scene), place(0, 0, 0.6, 0.6), [metal])
    scene.add_light("light", pivot_core.SphereLight((1.5, -1, 2), 0.3, (20, 20, 20)))
    set_camera(scene, (0, -4, 3), size=(48, 36))
    return scene


def passes(*names: str, scene: pivot_core.Scene | None = None, **settings: object) -> list[Floats]:
    session = pivot_core.Session(scene or ball_on_a_floor(), pivot_core.RenderSettings(**settings))
    session.start()
    assert session.wait(60)
    return [session.read(name).astype(np.float64) for name in names]


@pytest.mark.parametrize("adaptive", [False, True])
def test_where_no_samples_are_shared_own_sums_are_all(adaptive: bool) -> None:
    settings = {"samples": 64, "adaptive": adaptive, "error_budget_percent": 1.0, **BOX}
    combined, indirect, normal, *own = passes(
        "Combined", "Indirect", "Normal", *DENOISING_PASSES, denoising_passes=True, **settings
    )
    noisy, noisy_indirect, _, noisy_normal = own
    np.testing.assert_allclose(noisy, combined, rtol=1e-4, atol=1e-5)
    np.testing.assert_allclose(noisy_indirect, indirect, rtol=1e-4, atol=1e-5)
    np.testing.assert_allclose(noisy_normal, normal, rtol=1e-4, atol=1e-5)


def test_noise_for_a_denoiser_is_each_pixels_own() -> None:
    """Pixels that share samples are off alike; what a denoiser gets is not."""
    settings = {"samples": 4, "filter_width_px": 3.0, "denoising_passes": True}
    pairs = [passes("Combined", "Noisy Image", seed=seed, **settings) for seed in range(8)]

    def correlation(number: int) -> float:
        pictures = np.array([pair[number][:12, :, :3].mean(-1) for pair in pairs])  # of the floor
        off = pictures - pictures.mean(0)
        left, right = off[:, :, :-1].ravel(), off[:, :, 1:].ravel()
        return float(np.corrcoef(left, right)[0, 1])

    assert correlation(0) > 0.15
    assert abs(correlation(1)) < 0.1


@pytest.mark.parametrize("light", ["Direct", "Indirect"])
def test_noise_is_told_by_halves_of_what_comes_together(light: str) -> None:
    settings = {"samples": 16, "filter_width_px": 3.0, "denoising_passes": True}
    runs = [passes("Combined", "Indirect", f"{light} Variance", seed=seed, **settings) for seed in range(8)]
    lights = np.array(
        [indirect if light == "Indirect" else combined[..., :3] - indirect for combined, indirect, _ in runs]
    )
    told = np.mean([variance for *_, variance in runs])
    # What varies smoothly is spread better in all of a pixel's samples than in those that came together.
    assert 0.7 < told / lights.var(0, ddof=1).mean() < 3


def test_a_picture_that_will_be_denoised_takes_fewer_samples() -> None:
    def samples(is_denoised: bool) -> int:
        settings = {"samples": 512, "adaptive": True, "error_budget_percent": 1.0, "denoising_passes": is_denoised}
        session = pivot_core.Session(ball_on_a_floor(), pivot_core.RenderSettings(**settings))
        session.start()
        assert session.wait(60)
        return int(session.pixel_samples)

    assert samples(is_denoised=True) < 0.7 * samples(is_denoised=False)


def test_light_is_direct_or_has_bounced() -> None:
    combined, indirect = passes("Combined", "Indirect", samples=256, max_bounces=3, **BOX)
    direct, none = passes("Combined", "Indirect", samples=256, max_bounces=0, seed=1, **BOX)
    assert np.all(none == 0)
    assert indirect.mean() > 0.03 * combined[..., :3].mean()
    np.testing.assert_allclose((combined[..., :3] - indirect).mean(), direct[..., :3].mean(), rtol=3e-3)


def test_albedo_for_a_denoiser_is_of_all_lobes() -> None:
    albedo, diffuse = passes("Denoising Albedo", "DiffCol", samples=16, denoising_passes=True, **BOX)
    np.testing.assert_allclose(albedo[0, 0], (0.6, 0.5, 0.4), rtol=1e-3)  # the floor
    ball = np.all(diffuse == 0, axis=-1) & np.any(albedo > 0, axis=-1)
    assert ball.sum() > 100
    assert np.all(albedo[ball] > (0.7, 0.48, 0.25))  # single scattering loses some
    assert np.all(albedo <= 1)


def test_a_denoiser_goes_by_what_mirrors_and_glass_show() -> None:
    """A red wall in a mirror, through a pane of glass: the Normal pass is of the pane, a denoiser's of the wall."""
    scene = pivot_core.Scene()
    red = scene.add_material("red", pivot_core.Material(diffuse=(0.8, 0.1, 0.1)))
    mirror = scene.add_material(
        "mirror", pivot_core.Material(alpha=1e-3, conductor_f0=(0.5,) * 3, conductor_f90=(0.5,) * 3)
    )
    pane = scene.add_material("pane", pivot_core.Material(lobes=[("dielectric", {"ior": 1.001, "alpha": 1e-3})]))
    turned = place(0, 0, 3, 1)
    turned[0, :3, :3] = np.diag([1.0, -1.0, -1.0])
    scene.add_instances("mirror", add_plane(scene, 9), place(), [mirror])
    scene.add_instances("wall", add_plane(scene, 9), turned, [red])
    set_camera(scene, (0, -0.4, 2.5), size=(8, 8))
    scene.add_instances("pane", add_plane(scene, 1), place(0, 0, 1, 1), [pane])
    albedo, normal, first = passes(
        "Denoising Albedo",
        "Denoising Normal",
        "Normal",
        scene=scene,
        samples=4,
        max_bounces=6,
        denoising_passes=True,
        **BOX,
    )
    np.testing.assert_allclose(albedo, np.broadcast_to((0.4, 0.05, 0.05), albedo.shape), rtol=0.02)
    np.testing.assert_allclose(normal[..., 2], -1, atol=1e-3)
    np.testing.assert_allclose(first[..., 2], 1, atol=1e-3)


def test_passes_for_a_denoiser_must_be_asked_for() -> None:
    for name in (*DENOISING_PASSES, *VARIANCES):
        with pytest.raises(ValueError, match=f"the pass '{name}' is for a denoiser: render with denoising_passes"):
            passes(name, samples=1)
    assert pivot_core.Session.bytes_per_pixel(False, True) > pivot_core.Session.bytes_per_pixel(False)

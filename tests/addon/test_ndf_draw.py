"""Pictures of microfacets against formulas: integrals, means over pixels, and histograms of maps that are known."""

from __future__ import annotations

import sys
from importlib.util import module_from_spec, spec_from_file_location
from pathlib import Path
from types import ModuleType
from typing import Any

import numpy as np
import pytest

_FOLDER = Path(__file__).parents[2] / "addon/ndf"


def _package() -> ModuleType:
    """addon/ndf without addon, which is there in Blender alone."""
    spec = spec_from_file_location("ndf", _FOLDER / "__init__.py", submodule_search_locations=[str(_FOLDER)])
    package = module_from_spec(spec)
    sys.modules["ndf"] = package
    spec.loader.exec_module(package)
    return package


_package()
from ndf.draw import Lobe, Yarn, drawn, share_inside  # noqa: E402
from ndf.histogram import height_map_patches, histogram, normal_map_patches  # noqa: E402

ROUND = (0.3, 0.3)


def integral(picture: Any, of: Any = 1) -> float:
    """of: (size, size)."""
    return float((picture * of * share_inside(len(picture))).sum(dtype=np.float64) * 4 / picture.size)


def places(size: int) -> tuple[Any, Any, Any]:
    """x, y and z at the middles of pixels."""
    centres = (np.arange(size) + 0.5) * 2 / size - 1
    x, y = np.meshgrid(centres, centres)
    return x, y, np.sqrt(np.maximum(1 - x * x - y * y, 0))


def ggx(x: Any, y: Any, z: Any, alpha: tuple[float, float]) -> Any:
    return 1 / (np.pi * alpha[0] * alpha[1] * ((x / alpha[0]) ** 2 + (y / alpha[1]) ** 2 + z * z) ** 2)


def test_the_shares_of_pixels_make_the_disk() -> None:
    for size in (64, 65, 513):
        assert share_inside(size).sum() * 4 / size**2 == pytest.approx(np.pi, rel=1e-5)


@pytest.mark.parametrize("is_beckmann", [False, True])
@pytest.mark.parametrize("alpha", [(1e-4, 1e-4), (0.003, 0.3), ROUND, (1.0, 0.01), (1.0, 1.0)])
@pytest.mark.parametrize("size", [64, 200])
def test_a_lobe_integrates_to_its_share(size: int, alpha: tuple[float, float], is_beckmann: bool) -> None:
    for rotation, slope in ((0.0, 0.0), (0.7, 0.4)):
        picture = drawn(size, [Lobe(alpha, rotation, slope, share=0.25, is_beckmann=is_beckmann)])
        assert np.isfinite(picture).all()
        assert integral(picture) == pytest.approx(0.25, rel=2e-3)


def test_smooth_lobes_are_their_formulas() -> None:
    x, y, z = places(256)
    inside = z > 0.1
    alpha = (0.4, 0.7)
    np.testing.assert_allclose(drawn(256, [Lobe(alpha)])[inside], ggx(x, y, z, alpha)[inside], rtol=2e-3)
    slopes_squared = ((x / alpha[0]) ** 2 + (y / alpha[1]) ** 2)[inside] / z[inside] ** 2
    beckmann = np.exp(-slopes_squared) / (np.pi * alpha[0] * alpha[1] * z[inside] ** 4)
    np.testing.assert_allclose(
        drawn(256, [Lobe(alpha, is_beckmann=True)])[inside], beckmann, rtol=5e-3, atol=1e-3 * beckmann.max()
    )
    tilted = 1 / (
        np.pi * 0.28 * z[inside] ** 4
        * (1 + ((x[inside] / z[inside] - 0.3) / 0.4) ** 2 + (y[inside] / z[inside] / 0.7) ** 2) ** 2
    )  # fmt: skip
    np.testing.assert_allclose(drawn(256, [Lobe(alpha, slope=0.3)])[inside], tilted, rtol=5e-3)


@pytest.mark.parametrize("alpha", [0.002, 0.01, 0.05])
def test_a_pixel_of_a_sharp_lobe_holds_the_mean(alpha: float) -> None:
    """Coarse pixels are the means of fine ones, and GGX has 1 / (1 + alpha^2 cot^2) of itself within an angle."""
    fine, coarse = drawn(512, [Lobe((alpha, alpha))]), drawn(64, [Lobe((alpha, alpha))])
    middle = slice(24, 40)
    means = fine.reshape(64, 8, 64, 8).mean(axis=(1, 3))
    np.testing.assert_allclose(coarse[middle, middle], means[middle, middle], rtol=1e-3)
    x, y, _ = places(512)
    radius = 0.25
    inside = integral(fine, x * x + y * y < radius * radius)
    assert inside == pytest.approx(1 / (1 + alpha**2 * (1 - radius**2) / radius**2), abs=2e-3)


def test_beckmann_has_its_variance() -> None:
    x, _, z = places(512)
    slope = np.divide(x, z, out=np.zeros_like(x), where=z > 0)
    picture = drawn(512, [Lobe((0.2, 0.1), is_beckmann=True)])
    assert integral(picture, slope * slope) == pytest.approx(0.2**2 / 2, rel=1e-3)
    turned = drawn(512, [Lobe((0.1, 0.2), np.pi / 2, is_beckmann=True)])
    np.testing.assert_allclose(turned, picture, atol=1e-4 * picture.max())


def test_a_yarns_fibres_tilt_both_ways_along_it() -> None:
    picture = drawn(128, Yarn(np.pi / 2, 0.1, 0.4, np.radians(20), 0.5).lobes())
    np.testing.assert_allclose(picture, picture[::-1, ::-1], rtol=1e-4)
    row, column = np.unravel_index(picture.argmax(), picture.shape)
    assert abs(column - 63.5) < 2
    assert abs(abs(row - 63.5) / 64 - np.sin(np.radians(20))) < 0.05


def _map(size: int, spread: float) -> Any:
    """(size, size, 3): normals with slopes of a normal distribution, as a normal map's texels."""
    slopes = np.random.default_rng(1).normal(0, spread, (size, size, 2))
    normals = np.dstack((slopes, np.ones((size, size))))
    normals /= np.linalg.norm(normals, axis=2, keepdims=True)
    return (normals / 2 + 0.5).astype(np.float32)


def test_a_map_of_texels_that_are_planes_is_counted() -> None:
    """Two halves of one normal each: what is between them is a texel wide."""
    texels = np.full((8, 1024, 3), (0.75, 0.5, 0.9), np.float32)
    texels[:, 512:] = (0.2, 0.8, 0.9)
    picture = histogram(64, normal_map_patches(texels), texels[..., 0].size)
    assert integral(picture) == pytest.approx(1, rel=1e-5)
    for texel in (texels[0, 0], texels[0, -1]):
        normal = 2 * texel - 1
        x, y, _ = normal / np.linalg.norm(normal)
        share = picture[int((y + 1) * 32), int((x + 1) * 32)] * 4 / 64**2
        assert share == pytest.approx(0.5, abs=2e-3)


def test_directx_turns_y() -> None:
    texels = _map(64, 0.3)
    opengl, directx = (histogram(64, normal_map_patches(texels, turned), 64 * 64) for turned in (False, True))
    assert not np.allclose(opengl, opengl[::-1], rtol=0.1)
    np.testing.assert_allclose(directx, opengl[::-1], atol=0.02 * opengl.max())


def test_a_height_map_has_the_normals_of_its_surface() -> None:
    """A wave h = sin(2 pi x) of amplitude a: its slope s is distributed as 1 / (pi sqrt(s0^2 - s^2)), s0 = 2 pi a."""
    size, amplitude = 512, 0.05
    wave = np.broadcast_to(np.sin(2 * np.pi * np.arange(size) / size), (size // 2, size)).astype(np.float32)
    picture = histogram(128, height_map_patches(wave, amplitude), wave.size)
    x, y, _ = places(128)
    steepest = 2 * np.pi * amplitude
    slopes = np.random.default_rng(2).uniform(0, np.pi, 1_000_000)
    normal_x = np.sin(np.arctan(steepest * np.cos(slopes)))
    assert integral(picture) == pytest.approx(1, rel=1e-5)
    assert integral(picture, x * x) == pytest.approx((normal_x**2).mean(), rel=0.02)
    assert integral(picture, np.abs(y)) == pytest.approx(1 / 128)  # one row of pixels
    assert np.abs(x[picture > 0]).max() == pytest.approx(np.sin(np.arctan(steepest)), abs=1 / 64)


@pytest.mark.parametrize("alpha", [0.01, 0.05, 0.3])
def test_a_plane_that_is_rough_is_its_roughness(alpha: float) -> None:
    flat = histogram(128, height_map_patches(np.zeros((4, 4), np.float32), 0.1), 16, alpha)
    lobe = drawn(128, [Lobe((alpha, alpha))])
    x, y, z = places(128)
    inside = z > 0.2
    near = inside & (np.hypot(x, y) < 12 * alpha)
    np.testing.assert_allclose(flat[near], lobe[near], rtol=0.015)
    np.testing.assert_allclose(flat[inside], lobe[inside], rtol=0.02, atol=1e-4 * lobe.max())


@pytest.mark.parametrize("alpha", [0.03, 0.1, 0.4])
def test_a_rough_map_is_the_sum_of_lobes_around_its_normals(alpha: float) -> None:
    texels = _map(16, 0.4)
    picture = histogram(32, normal_map_patches(texels), 16 * 16, alpha)
    normals = 2 * texels - 1
    padded = np.pad(normals, ((0, 1), (0, 1), (0, 0)), mode="wrap")
    x, y, z = places(32 * 4)
    h = np.stack((x, y, z), axis=2).reshape(-1, 3)
    expected = np.zeros(len(h))
    fractions = (np.arange(12) + 0.5) / 12
    for up in fractions:
        for along in fractions:
            left = padded[:-1, :-1] * (1 - up) + padded[1:, :-1] * up
            right = padded[:-1, 1:] * (1 - up) + padded[1:, 1:] * up
            n = (left * (1 - along) + right * along).reshape(-1, 3)
            n /= np.linalg.norm(n, axis=1, keepdims=True)
            cosine = h @ n.T
            lobes = alpha**2 / (np.pi * (1 - (1 - alpha**2) * cosine**2) ** 2) * (cosine > 0)
            expected += (lobes / n[:, 2]).mean(axis=1) / 144
    expected = expected.reshape(32, 4, 32, 4).mean(axis=(1, 3))
    inside = places(32)[2] > 0.3
    np.testing.assert_allclose(picture[inside], expected[inside], rtol=0.02, atol=2e-3 * expected.max())


def test_normals_into_the_surface_are_refused() -> None:
    texels = np.full((2, 2, 3), 0.8, np.float32)
    texels[0, 0, 2] = 0.5
    with pytest.raises(ValueError, match=r"1 of its 4 texels look into the surface"):
        next(normal_map_patches(texels))

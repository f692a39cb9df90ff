"""A picture of microfacets' normals as the core takes it: what it refuses, its scale, how much each direction sees."""

from __future__ import annotations

import numpy as np
import pivot_core
import pytest
from ndf_pictures import Array, draw, ggx, points, sharp

ELEVATIONS_RAD = np.radians([90, 80, 60, 40, 20, 10, 5, 2, 1, 0.2])


def directions(azimuth: float) -> Array:
    z = np.sin(ELEVATIONS_RAD)
    sine = np.cos(ELEVATIONS_RAD)
    return np.stack([sine * np.cos(azimuth), sine * np.sin(azimuth), z], 1)


@pytest.mark.parametrize(
    ("pixels", "said"),
    [
        (np.zeros((8, 8)), "it is black within the unit disk"),
        (np.pad([[1.0]], ((0, 63), (0, 63))), "it is black within the unit disk"),
        (np.full((8, 8), -1.0), "it has negative pixels"),
        (np.full((8, 8), np.nan), "it has pixels that are not finite"),
        (np.full((8, 8), np.inf), "it has pixels that are not finite"),
        (np.ones((8, 9)), "it must be square"),
        (np.ones((0, 0)), "it must be square"),
        (np.ones((7, 7)), "it is 7 pixels wide, fewer than 8, which tell nothing"),
        (np.ones((4097, 4097)), "it is 4097 pixels wide, more than 4096; scale it down"),
    ],
)
def test_what_is_no_density_is_refused(pixels: Array, said: str) -> None:
    with pytest.raises(ValueError, match=said):
        pivot_core.TabulatedNdf(pixels)


@pytest.mark.parametrize("size", [8, 11, 64, 513])
@pytest.mark.parametrize("scale", [1e-20, 1.0, 1e20])
def test_the_projected_area_is_one(size: int, scale: float) -> None:
    """The integral of D h.z dw, which is D dx dy, rim pixels in part: of even pictures as of steep ones."""
    for picture in (np.ones((size, size)), draw(size, 0.3), np.random.default_rng(size).random((size, size)) ** 8):
        if not picture.max() > 0:
            continue
        ndf = pivot_core.TabulatedNdf(picture * scale)
        x, y, z2 = points(size, max(4, 512 // size))
        inside = z2 > 0
        h = np.stack([x, y, np.sqrt(np.maximum(z2, 0))], -1)[inside]
        area = ndf.density(h).astype(float).sum() * (x[0, 1] - x[0, 0]) ** 2
        assert area == pytest.approx(1, rel=5e-3)


@pytest.mark.parametrize("size", [64, 256, 512, 2048])
@pytest.mark.parametrize("roughness", [0.1, 0.3, 0.6, 1.0])
def test_masking_of_ggx_is_smiths(size: int, roughness: float) -> None:
    """At every elevation; where a pixel is not wider than the lobe."""
    alpha = roughness**2
    if 2 / size > alpha / 2:
        pytest.skip("the picture does not resolve it")
    ndf = pivot_core.TabulatedNdf(draw(size, alpha, across=4 if size < 2048 else 2))
    slope2 = (alpha / np.tan(ELEVATIONS_RAD)) ** 2
    smith = 2 / (1 + np.sqrt(1 + slope2))
    np.testing.assert_allclose(ndf.g1(directions(0.7)), smith, rtol=6e-3)


@pytest.mark.parametrize("size", [64, 256, 1024])
@pytest.mark.parametrize(
    ("alpha", "alpha_y", "tilt"), [(0.1, 0.1, 0.0), (0.1, 0.4, 0.0), (0.08, 0.3, 0.5), (0.2, 0.2, 1.0)]
)
def test_masking_is_that_of_quadrature(size: int, alpha: float, alpha_y: float, tilt: float) -> None:
    """Over all pixels, of weaves and brushed surfaces seen along them, across and between."""
    ndf = pivot_core.TabulatedNdf(draw(size, alpha, alpha_y, tilt))
    x, y, z2 = points(2048, 1)
    inside = z2 > 1e-5
    d = (ggx(x, y, z2, alpha, alpha_y, tilt) + ggx(x, y, z2, alpha, alpha_y, -tilt))[inside]
    h = np.stack([x, y, np.sqrt(np.maximum(z2, 0))], -1)[inside]
    weights = d / h[:, 2]
    area = (weights * h[:, 2]).sum()
    for azimuth in (0.0, 0.03, 0.8, np.pi / 2):
        w = directions(azimuth)
        seen = np.array([(weights * np.maximum(h @ direction, 0)).sum() for direction in w]) / area
        np.testing.assert_allclose(ndf.sigma(w), seen, rtol=5e-3 if size > 64 else 2e-2)


@pytest.mark.parametrize("kind", ["pixel", "tilted pixel", "ring", "grid", "rim"])
def test_sharp_pictures_mask_by_part(kind: str) -> None:
    ndf = pivot_core.TabulatedNdf(sharp(kind))
    for azimuth in (0.0, 1.0, 3.0):
        g1 = ndf.g1(directions(azimuth))
        assert np.all(np.isfinite(g1))
        assert np.all((g1 > 0) & (g1 <= 1))


def test_the_fit_of_ggx_is_one_lobe_of_its_alphas() -> None:
    (weight, shift, (xx, yx, yy)), *others = pivot_core.TabulatedNdf(draw(256, 0.1, 0.3)).fit
    assert not others
    np.testing.assert_allclose((weight, *shift, xx, yx, yy), (1, 0, 0, 0.1, 0, 0.3), atol=4e-3)


def test_the_fit_of_a_weave_is_its_yarns() -> None:
    ndf = pivot_core.TabulatedNdf(draw(256, 0.1, 0.25, 0.5))
    shifts = sorted(shift[0] for weight, shift, _ in ndf.fit if weight > 0.2)
    np.testing.assert_allclose(shifts, (-0.5, 0.5), atol=0.02)
    assert ndf.fit_error < 0.02


def test_the_fit_is_soon_made_and_bounded() -> None:
    for kind in ("ring", "grid"):
        ndf = pivot_core.TabulatedNdf(sharp(kind))
        assert len(ndf.fit) <= 8
        assert 0.1 < ndf.fit_error <= 1
        assert sum(weight for weight, _, _ in ndf.fit) == pytest.approx(1, abs=1e-5)

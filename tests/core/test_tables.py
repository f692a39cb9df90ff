"""The fitted tables: made by the programs in lut/, within the errors that lut/README.md states, and continuous."""

import sys
from pathlib import Path

import numpy as np
import pivot_core
import pivot_core.distributions as pd
import pivot_core.tables as tables
import pytest

LUT = Path(__file__).parents[2] / "lut"
sys.path.insert(0, str(LUT))

import ggx_dielectric  # noqa: E402
import ggx_glass  # noqa: E402
import ggx_ltc  # noqa: E402
import ggx_sptd  # noqa: E402
import sheen_ltc  # noqa: E402
import velvet_albedo  # noqa: E402
from errors import random_views  # noqa: E402
from ggx_average_albedo import average_albedo  # noqa: E402
from quadrature import view  # noqa: E402

NORMAL = np.array([0.0, 0.0, 1.0])


def stored(name: str, *shape: int) -> np.ndarray:
    return np.fromfile(LUT / "data" / f"{name}.f32", "<f4").reshape(shape)


@pytest.mark.parametrize(("row", "column"), [(0, 40), (20, 10), (40, 60), (63, 5)])
def test_sptd_table_is_what_its_program_fits(row: int, column: int) -> None:
    table = stored("ggx_sptd", 64, 64, 3)
    alpha, cos_o = tables.alpha_nodes(64)[row], tables.cos_nodes(64)[column]
    lobe = ggx_sptd.make_lobe(float(alpha), float(cos_o))
    np.testing.assert_allclose(table[row, column, :2], ggx_sptd.fit(lobe, (-0.5, 1.0)), rtol=2e-3, atol=1e-3)
    np.testing.assert_allclose(table[row, column, 2], lobe.albedo, rtol=1e-6)


def test_sptd_fetch_at_a_node_is_the_node() -> None:
    alpha, cos_o = tables.alpha_nodes(64)[1:63, None], tables.cos_nodes(64)[None, 1:63]
    shift, width, albedo = np.moveaxis(stored("ggx_sptd", 64, 64, 3)[1:63, 1:63], -1, 0)
    wo = np.stack([np.sqrt(1 - cos_o**2), 0 * cos_o, cos_o], -1)
    pivot, delta, fetched, _ = tables.ggx_sptd(alpha, wo)
    expected_pivot, expected_delta = tables.ggx_sptd_from_node(alpha, wo, shift, width)
    np.testing.assert_allclose(fetched, albedo, rtol=1e-4)
    np.testing.assert_allclose(delta, expected_delta, rtol=1e-3)
    np.testing.assert_allclose(pivot, expected_pivot, atol=1e-4)


def test_sptd_pivot_turns_with_the_view() -> None:
    wo = np.array([0.6, 0.0, 0.8])
    turned = np.array([0.0, 0.6, 0.8])
    pivot, delta, *_ = tables.ggx_sptd(0.3, wo)
    pivot_turned, delta_turned, *_ = tables.ggx_sptd(0.3, turned)
    assert delta == delta_turned
    np.testing.assert_allclose(pivot_turned, [0, pivot[0], pivot[2]], atol=1e-7)
    assert np.linalg.norm(pivot) == pytest.approx(1, abs=1e-6)


def test_sptd_keeps_the_albedo_above_the_horizon() -> None:
    for alpha, cos_o in zip(*random_views(200, 2), strict=True):
        pivot, delta, albedo, amplitude = tables.ggx_sptd(alpha, view(cos_o))
        above = pd.sptd_uniform_integral(NORMAL, 1.0, pivot / np.linalg.norm(pivot), delta)
        assert amplitude * above == pytest.approx(albedo, rel=1e-5)


@pytest.mark.parametrize(("row", "column"), [(20, 40), (40, 10), (40, 60), (63, 5), (55, 63)])
def test_ltc_table_is_what_its_program_fits(row: int, column: int) -> None:
    stands = stored("ggx_ltc", 64, 64, 4)[row, column].astype(np.float64)
    lobe = ggx_sptd.make_lobe(float(tables.alpha_nodes(64)[row]), float(tables.cos_nodes(64)[column]))
    best = ggx_ltc.fit(lobe, np.array(ggx_ltc.START))
    distance, least = (ggx_ltc.hellinger(lobe, ggx_ltc.matrix(lobe, values)) for values in (stands, best))
    assert distance == pytest.approx(least, rel=1e-3)
    np.testing.assert_allclose(stands[1:3], best[1:3], rtol=1e-2)


def test_ltc_fetch_at_a_node_is_the_node() -> None:
    alpha, cos_o = tables.alpha_nodes(64)[1:63, None], tables.cos_nodes(64)[None, 1:63]
    wo = np.stack([np.sqrt(1 - cos_o**2), 0 * cos_o, cos_o], -1)
    m, albedo, _ = tables.ggx_ltc(alpha, wo)
    node = tables.ggx_ltc_from_node(alpha, wo, *np.moveaxis(stored("ggx_ltc", 64, 64, 4)[1:63, 1:63], -1, 0))
    np.testing.assert_array_equal(albedo, tables.ggx_albedo(alpha, cos_o))
    columns = np.linalg.norm(node, axis=-2, keepdims=True)
    assert np.abs((m - node) / columns).max() < 5e-3


@pytest.mark.parametrize(
    ("alpha", "theta_deg", "percent"), [(0.1, 30, 3), (0.1, 75, 21), (0.25, 75, 26), (0.5, 75, 16), (0.9, 30, 3)]
)
def test_ltc_is_as_near_to_ggx_as_one_can_be(alpha: float, theta_deg: float, percent: float) -> None:
    """As near as lut/README.md says, and far nearer than one SPTD."""
    lobe = ggx_sptd.make_lobe(alpha, float(np.cos(np.radians(theta_deg))))
    distance = ggx_ltc.l1_distance(lobe, tables.ggx_ltc(alpha, lobe.wo_local)[0])
    assert round(100 * distance) == percent
    pivot, delta, *_ = tables.ggx_sptd(alpha, lobe.wo_local)
    assert distance < 0.6 * ggx_sptd.l1_distance(lobe, pivot, delta)


def test_ltc_turns_with_the_view() -> None:
    m = tables.ggx_ltc(0.3, np.array([0.6, 0.0, 0.8]))[0]
    turned = tables.ggx_ltc(0.3, np.array([0.0, 0.6, 0.8]))[0]
    quarter = np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    np.testing.assert_allclose(turned, quarter @ m, atol=1e-6)


def test_ltc_keeps_the_albedo_above_the_horizon() -> None:
    for alpha, cos_o in zip(*random_views(200, 2), strict=True):
        m, albedo, amplitude = tables.ggx_ltc(alpha, view(cos_o))
        assert amplitude * pd.ltc_integrate_cap(m, NORMAL, 1.0) == pytest.approx(albedo, rel=1e-5)


def test_albedo_between_nodes() -> None:
    alpha, cos_o = random_views(200, 3)
    rough = alpha > 0.01
    exact = np.array([ggx_sptd.make_lobe(a, c).albedo for a, c in zip(alpha, cos_o, strict=True)])
    error = np.abs(tables.ggx_albedo(alpha, cos_o) - exact)
    assert error[rough].max() < 1.5e-3
    assert error.max() < 1.5e-2


def test_average_albedo() -> None:
    alphas = tables.alpha_nodes(64).astype(np.float64)
    averages = np.array([average_albedo(alpha) for alpha in alphas])
    np.testing.assert_allclose(tables.ggx_average_albedo(alphas), averages, rtol=1e-5)
    assert averages[0] == pytest.approx(1, abs=1e-3)  # a mirror keeps all
    assert np.all(np.diff(averages) < 0)  # rougher loses more


def test_dielectric_table_is_what_its_program_makes() -> None:
    table = stored("ggx_dielectric", 32, 32, 16)
    alpha, cos_o = float(tables.alpha_nodes(32)[9]), float(tables.cos_nodes(32)[14])
    iors = tables.ior_nodes(16).astype(np.float64)
    np.testing.assert_allclose(table[9, 14], ggx_dielectric.weights(alpha, cos_o, iors), rtol=1e-5, atol=1e-7)


def test_dielectric_between_nodes() -> None:
    iors = np.array([1.33, 1.5, 1.8, 2.4])
    for alpha, cos_o in zip(*random_views(100, 4), strict=True):
        exact = ggx_dielectric.weights(alpha, cos_o, iors)
        assert np.abs(tables.ggx_dielectric_weight(alpha, cos_o, iors) - exact).max() < 1e-2


@pytest.mark.parametrize("seed", range(4))
def test_fetches_are_continuous(seed: int) -> None:
    """Across cells: along a fine line through the domain no step exceeds what the steepest cell allows."""
    (a0, a1), (c0, c1) = np.random.default_rng(seed).random((2, 2))
    t = np.linspace(0, 1, 20001)
    low = np.sqrt(1e-3)
    alpha = (low + (1 - low) * (a0 + (a1 - a0) * t)) ** 2
    cos_o = (c0 + (c1 - c0) * t) ** 2
    wo = np.stack([np.sqrt(1 - cos_o**2), 0 * t, cos_o], -1)
    pivot, delta, *_ = tables.ggx_sptd(alpha, wo)
    assert np.linalg.norm(np.diff(pivot, axis=0), axis=-1).max() < 2e-3
    assert np.abs(np.diff(delta)).max() < 5e-4
    assert np.abs(np.diff(tables.ggx_ltc(alpha, wo)[0], axis=0)).max() < 2e-3
    assert np.abs(np.diff(tables.ggx_albedo(alpha, cos_o))).max() < 5e-4
    assert np.abs(np.diff(tables.ggx_dielectric_weight(alpha, cos_o, 1.5))).max() < 5e-4


@pytest.mark.parametrize("ior", [1.0, 1.01, 1.5, 3.0, 5.0])
def test_dielectric_weight_is_a_weight(ior: float) -> None:
    alpha, cos_o = random_views(500, 5)
    weight = tables.ggx_dielectric_weight(alpha, cos_o, ior)
    assert weight.min() >= 0
    assert weight.max() <= 1


@pytest.mark.parametrize(("row", "column"), [(5, 20), (20, 5), (31, 31)])
def test_glass_table_is_what_its_program_makes(row: int, column: int) -> None:
    alpha, cos_o = float(tables.alpha_nodes(32)[row]), float(tables.cos_nodes(32)[column])
    layers = [3, 12, 20, 29]
    made = ggx_glass.albedos(alpha, cos_o, tables.eta_nodes(33)[layers].astype(np.float64))
    np.testing.assert_allclose(stored("ggx_glass", 32, 32, 33, 2)[row, column, layers], made, rtol=1e-5, atol=1e-6)
    fetched = np.stack(tables.ggx_glass_albedo(alpha, cos_o, tables.eta_nodes(33)[layers]), -1)
    np.testing.assert_allclose(fetched, made, atol=1e-4)


def test_glass_table_is_near_what_it_stands_for() -> None:
    """Between its nodes, for the indices of water to diamond from either side."""
    etas = np.array([1.33, 1.5, 2.4, 1 / 1.33, 1 / 1.5, 1 / 2.4])
    errors = []
    for alpha, cos_o in zip(*random_views(100, 6), strict=True):
        made = ggx_glass.albedos(alpha, cos_o, etas).sum(-1)
        errors.append(np.abs(np.sum(tables.ggx_glass_albedo(alpha, cos_o, etas), 0) / made - 1))
    assert np.all(np.median(errors, 0) < 2e-3)
    assert np.all(np.quantile(errors, 0.95, 0) < 1e-2)
    assert np.max(errors) < 3e-2


def test_glass_average_is_the_mean_over_the_hemisphere() -> None:
    for alpha, eta in ((0.1, 1.5), (0.6, 1 / 1.5), (1.0, 2.0)):
        cosines = (np.arange(2000) + 0.5) / 2000
        both = sum(tables.ggx_glass_albedo(alpha, cosines, eta))
        assert tables.ggx_glass_average_albedo(alpha, eta) == pytest.approx((2 * cosines * both).mean(), abs=5e-3)


@pytest.mark.parametrize(("row", "column"), [(31, 31), (20, 8), (10, 2), (12, 20)])
def test_sheen_table_is_what_its_program_fits(row: int, column: int) -> None:
    walks = sheen_ltc.reflected(row / 31, column / 31, np.random.default_rng(2))
    albedo, a, b = stored("sheen_ltc", 32, 32, 3)[row, column]
    rarity = np.sqrt((1 - walks.albedo) / len(walks.wi))
    assert albedo == pytest.approx(walks.albedo, rel=6 * rarity)
    assert (a, b) == pytest.approx(sheen_ltc.fit(walks.wi), rel=0.02, abs=10 / np.sqrt(len(walks.wi)))


def test_velvet_table_is_the_lobes_albedo() -> None:
    random = np.random.default_rng(1)
    for sigma, cos_o in zip(random.uniform(0.2, 1, 20), random.uniform(0.05, 1, 20), strict=True):
        material = pivot_core.Material(lobes=[("velvet", {"sigma": sigma})])
        assert material.albedo(tuple(view(cos_o)))[0] == pytest.approx(velvet_albedo.albedo(sigma, cos_o), rel=0.03)

"""Identities of LTSDs, spherical Gaussians, pixels and phase functions, over random input; and bad input."""

from collections.abc import Callable

import hypothesis.extra.numpy as hnp
import hypothesis.strategies as st
import numpy as np
import pivot_core.distributions as pd
import pytest
from hypothesis import assume, given, settings
from scipy.integrate import dblquad, quad

Array = np.ndarray
BASES = ("uniform_sphere", "uniform_hemisphere", "clamped_cosine", "squared_clamped_cosine")
Z = np.array([0.0, 0.0, 1.0])

unit_interval = st.floats(0, 1)
coordinate = st.floats(-1, 1)
base = st.sampled_from(BASES)
vectors = hnp.arrays(np.float64, 3, elements=coordinate).filter(lambda v: np.linalg.norm(v) > 0.1)
directions = vectors.map(lambda v: v / np.linalg.norm(v))
matrices = hnp.arrays(np.float64, (3, 3), elements=coordinate).filter(lambda m: abs(np.linalg.det(m)) > 0.05)
triangles = hnp.arrays(np.float64, (3, 3), elements=coordinate).filter(lambda p: abs(np.linalg.det(p)) > 0.02)
anisotropies = st.floats(-0.999, 0.999)

# A cube's faces: together all directions, each once.
FACES = [
    np.roll(np.array([[-1, -1, sign], [1, -1, sign], [1, 1, sign], [-1, 1, sign]], np.float64), axis, -1)
    for axis in range(3)
    for sign in (-1, 1)
]


@given(base, matrices)
def test_ltsd_integrates_to_one(name: str, m: Array) -> None:
    total = sum(pd.ltsd_integrate_polygon(name, m, face) for face in FACES)
    assert total == pytest.approx(1, abs=1e-11)


@given(base, matrices, triangles, unit_interval, unit_interval)
def test_ltsd_of_a_polygon_is_the_sum_of_its_parts(name: str, m: Array, triangle: Array, s: float, t: float) -> None:
    a, b, c = triangle
    middle = a + s * (b - a)
    tip = middle + t * (c - middle)
    parts = [p for p in ((a, middle, c), (middle, b, tip), (b, c, tip)) if abs(np.linalg.det(p)) > 1e-9]
    whole = pd.ltsd_integrate_polygon(name, m, triangle)
    assert sum(pd.ltsd_integrate_polygon(name, m, np.array(p)) for p in parts) == pytest.approx(whole, abs=1e-10)


@given(base, matrices, triangles, st.integers(0, 2))
def test_ltsd_polygon_forgets_order_and_distance(name: str, m: Array, triangle: Array, start: int) -> None:
    integral = pd.ltsd_integrate_polygon(name, m, triangle)
    again = np.roll(triangle[::-1], start, axis=0) * np.array([[0.3], [2.0], [7.0]])
    assert pd.ltsd_integrate_polygon(name, m, again) == pytest.approx(integral, abs=1e-12)
    assert pd.ltsd_integrate_polygon(name, -3e-4 * m, -triangle) == pytest.approx(integral, abs=1e-12)
    assert -1e-15 <= integral <= 1 + 1e-12


@settings(max_examples=20, deadline=None)
@given(base, matrices)
def test_ltsd_mean_direction_is_that_of_its_samples(name: str, m: Array) -> None:
    cells = (np.arange(200) + 0.5) / 200
    u = np.stack(np.meshgrid(cells, cells), -1).reshape(-1, 2)
    mean = pd.ltsd_sample(name, m, u).mean(0)
    np.testing.assert_allclose(pd.ltsd_mean_direction(name, m), mean, atol=2e-3)


def test_seed_prints_its_riemann_rule_and_not_the_integral() -> None:
    """The supplement's example: exact is 0.00589054787, its own rule of step 0.0025 gives 0.0059141."""
    m = np.array([[0.1, 0.5, 1], [0.2, 1, 1], [0, 2, 0.5]])
    polygon = np.array([[0.0, 0, 1], [1, 0, 1], [1, 1, 1]])
    assert pd.ltsd_integrate_polygon("clamped_cosine", m, polygon) == pytest.approx(0.005890547872735, rel=1e-12)


@given(directions, st.floats(0, 1e7), directions, st.floats(0, 1e7), directions)
def test_sg_product_is_the_product(a: Array, sharpness_a: float, b: Array, sharpness_b: float, omega: Array) -> None:
    axis, sharpness, log_amplitude = pd.sg_product(a, sharpness_a, b, sharpness_b)
    exponent = log_amplitude - sharpness * ((omega - axis) ** 2).sum() / 2
    expected = -(sharpness_a * ((omega - a) ** 2).sum() + sharpness_b * ((omega - b) ** 2).sum()) / 2
    assert exponent == pytest.approx(expected, abs=1e-7 + 1e-12 * (sharpness_a + sharpness_b))


@given(st.floats(0, 1e6), coordinate)
def test_sg_irradiance_of_opposite_sides_is_the_mean_cosine(sharpness: float, cosine: float) -> None:
    """max(c, 0) - max(-c, 0) = c: the two hemispheres' difference is closed, A (coth lambda - 1 / lambda) cos."""
    assume(sharpness > 1e-3)
    difference = pd.sg_irradiance(sharpness, cosine) - pd.sg_irradiance(sharpness, -cosine)
    mean = 1 / np.tanh(sharpness) - 1 / sharpness
    assert difference == pytest.approx(pd.sg_integral(sharpness) * mean * cosine, rel=1e-9, abs=1e-10)


@pytest.mark.parametrize(("eta_x", "eta_y", "sharpness"), [(50, 50, 100), (200, 20, 100), (5, 5, 10), (1000, 4, 100)])
def test_asg_product_integral_is_near(eta_x: float, eta_y: float, sharpness: float) -> None:
    axis = np.array([np.sin(0.15), 0.0, np.cos(0.15)])

    def product(phi: float, z: float) -> float:
        radius = np.sqrt(1 - z * z)
        omega = np.array([radius * np.cos(phi), radius * np.sin(phi), z])
        return pd.asg_eval(np.eye(3), eta_x, eta_y, omega) * pd.sg_eval(axis, sharpness, omega)

    exact = dblquad(product, 0.3, 1, 0, 2 * np.pi, epsabs=1e-7)[0]
    assert pd.asg_integrate_sg(np.eye(3), eta_x, eta_y, axis, sharpness) == pytest.approx(exact, rel=0.05)


@given(st.integers(1, 40))
def test_orthographic_pixels_cover_the_hemisphere(count: int) -> None:
    """The seed reports slow convergence: its rim pixels were dropped."""
    edges = np.linspace(-1, 1, count + 1)
    x, y = edges[:-1, None], edges[None, :-1]
    pixels = pd.orthographic_pixel_solid_angle(x, x + 2 / count, y, y + 2 / count)
    assert pixels.sum() == pytest.approx(2 * np.pi, rel=1e-10)
    assert pixels.min() >= 0


@given(coordinate, coordinate, coordinate, coordinate)
def test_orthographic_pixel_is_the_difference_of_corners(a: float, b: float, c: float, d: float) -> None:
    (x0, x1), (y0, y1) = sorted((a, b)), sorted((c, d))
    corner = pd.orthographic_corner_solid_angle
    expected = corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)
    assert pd.orthographic_pixel_solid_angle(x0, x1, y0, y1) == pytest.approx(expected, abs=2e-11)


@given(coordinate, coordinate, coordinate, coordinate)
def test_cubemap_pixel_is_the_difference_of_corners(a: float, b: float, c: float, d: float) -> None:
    (x0, x1), (y0, y1) = sorted((a, b)), sorted((c, d))
    corner = pd.cubemap_corner_solid_angle
    expected = corner(x1, y1) - corner(x0, y1) - corner(x1, y0) + corner(x0, y0)
    assert pd.cubemap_pixel_solid_angle(x0, x1, y0, y1) == pytest.approx(expected, abs=1e-14)


def test_cubemap_faces_cover_the_sphere() -> None:
    assert 6 * pd.cubemap_pixel_solid_angle(-1.0, 1.0, -1.0, 1.0) == pytest.approx(4 * np.pi, rel=1e-14)


PHASES: dict[str, tuple[Callable, Callable, Callable, Callable]] = {
    name: tuple(getattr(pd, f"{name}_{part}") for part in ("eval", "cdf", "sample_cosine", "mean_cosine"))
    for name in ("henyey_greenstein", "pivot_phase")
}


@pytest.mark.parametrize("name", PHASES)
@given(g=anisotropies, xi=unit_interval)
def test_phase_sampling_inverts_the_cdf(name: str, g: float, xi: float) -> None:
    _, cdf, sample, _ = PHASES[name]
    mu, sine = sample(g, xi)
    assert mu**2 + sine**2 == pytest.approx(1, abs=1e-14)
    assert cdf(g, np.clip(mu, -1, 1)) == pytest.approx(xi, abs=1e-9)


@pytest.mark.parametrize("name", PHASES)
@pytest.mark.parametrize("g", [-0.95, -0.4, 0.0, 1e-5, 0.25, 0.35, 0.9])
def test_phase_functions_agree_with_quadrature(name: str, g: float) -> None:
    density, cdf, _, mean = PHASES[name]
    assert quad(lambda mu: 2 * np.pi * density(g, mu), -1, 0.3, epsabs=1e-13)[0] == pytest.approx(
        cdf(g, 0.3), abs=1e-11
    )
    moment = quad(lambda mu: 2 * np.pi * mu * density(g, mu), -1, 1, epsabs=1e-13, limit=200)[0]
    assert moment == pytest.approx(mean(g), abs=1e-10)


@given(st.floats(-0.999, 0.999))
def test_pivot_phase_of_mean_cosine_has_it(g: float) -> None:
    assert pd.pivot_phase_mean_cosine(pd.pivot_phase_of_mean_cosine(g)) == pytest.approx(g, abs=1e-12)


@given(st.floats(-0.999, 0.999))
def test_rational_fit_is_near_the_mean_cosine(g: float) -> None:
    assert pd.pivot_phase_like(g) == pytest.approx(pd.pivot_phase_of_mean_cosine(g), abs=0.03)
    assert pd.pivot_phase_like(-g) == -pd.pivot_phase_like(g)


@given(st.floats(-0.99, 0.99), directions, directions, st.floats(0.01, 1.99))
def test_pivot_phase_of_a_light_and_of_the_rest_is_one(
    g_p: float, omega_o: Array, light: Array, versine: float
) -> None:
    inside = pd.pivot_phase_cap_integral(g_p, omega_o, light, versine)
    assert inside + pd.pivot_phase_cap_integral(g_p, omega_o, -light, 2 - versine) == pytest.approx(1, abs=1e-12)


@given(st.floats(-0.9, 0.9), st.floats(0.01, 1.99))
def test_pivot_phase_of_a_light_ahead_is_the_cdf(g_p: float, versine: float) -> None:
    ahead = pd.pivot_phase_cap_integral(g_p, Z, Z, versine)
    assert ahead == pytest.approx(1 - pd.pivot_phase_cdf(g_p, 1 - versine), abs=1e-12)


SINGULAR = np.array([[1.0, 2, 3], [2, 4, 6], [0, 1, 0]])
TRIANGLE = np.eye(3)


@pytest.mark.parametrize(
    ("argument", "call"),
    [
        ("m", lambda: pd.ltsd_eval("clamped_cosine", SINGULAR, Z)),
        ("m", lambda: pd.ltsd_sample("clamped_cosine", SINGULAR, [0.5, 0.5])),
        ("m", lambda: pd.ltsd_mean_direction("clamped_cosine", np.zeros((3, 3)))),
        ("m", lambda: pd.ltsd_integrate_polygon("clamped_cosine", np.eye(3) * np.nan, TRIANGLE)),
        ("base", lambda: pd.ltsd_eval("cosine", np.eye(3), Z)),
        ("omega", lambda: pd.ltsd_eval("clamped_cosine", np.eye(3), 2 * Z)),
        ("polygon", lambda: pd.ltsd_integrate_polygon("clamped_cosine", np.eye(3), TRIANGLE[:2])),
        ("polygon", lambda: pd.ltsd_integrate_polygon("clamped_cosine", np.eye(3), np.zeros((3, 3)))),
        ("xi", lambda: pd.ltsd_base_sample_cosine("clamped_cosine", 1.5)),
        ("u", lambda: pd.ltsd_sample("clamped_cosine", np.eye(3), [0.5, 1.0])),
        ("sharpness", lambda: pd.sg_eval(Z, -1.0, Z)),
        ("sharpness", lambda: pd.sg_integral(np.nan)),
        ("axis", lambda: pd.sg_eval(0.5 * Z, 1.0, Z)),
        ("alpha", lambda: pd.sg_ggx_lobe(0.0, Z)),
        ("wo_local", lambda: pd.sg_ggx_lobe(0.5, [1.0, 0.0, 0.0])),
        ("frame", lambda: pd.asg_eval(SINGULAR, 1.0, 1.0, Z)),
        ("cos_axis", lambda: pd.sg_irradiance(1.0, 1.1)),
        ("x", lambda: pd.orthographic_corner_solid_angle(np.inf, 0.0)),
        ("y1", lambda: pd.orthographic_pixel_solid_angle(0.0, 1.0, 0.0, np.nan)),
        ("g", lambda: pd.henyey_greenstein_eval(1.0, 0.0)),
        ("g_p", lambda: pd.pivot_phase_eval(-1.0, 0.0)),
        ("mu", lambda: pd.pivot_phase_cdf(0.5, 1.5)),
        ("light_versine", lambda: pd.pivot_phase_cap_integral(0.5, Z, Z, 0.0)),
    ],
)
def test_bad_input_names_the_argument(argument: str, call: Callable) -> None:
    with pytest.raises(ValueError, match=rf"^{argument} "):
        call()

"""Identities of caps, the pivot transformation, SPTDs and GGX under lights, on random and on extreme input."""

from typing import Any

import numpy as np
import pivot_core.distributions as pd
import pytest
from hypothesis import assume, example, given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

settings.register_profile("identities", deadline=None, max_examples=60, derandomize=True)
settings.load_profile("identities")

Array = Any
PI = np.pi
Z = np.array([0.0, 0.0, 1.0])


@st.composite
def directions(draw: st.DrawFn) -> Array:
    """Unit vectors, the axes among them."""
    v = draw(arrays(np.float64, 3, elements=st.floats(-1, 1)))
    norm = np.linalg.norm(v)
    assume(norm > 1e-3)
    return v / norm


def log_floats(low: float, high: float) -> st.SearchStrategy[float]:
    """Even over the decades of [low, high]."""
    return st.floats(np.log(low), np.log(high)).map(lambda x: float(np.clip(np.exp(x), low, high)))


deltas = st.one_of(log_floats(1e-6, 1.0), st.just(1.0))
versines = st.one_of(log_floats(1e-12, 2.0), st.floats(1e-3, 2.0), st.sampled_from([1.0, 2.0]))
squares = st.tuples(st.floats(0, 1, exclude_max=True), st.floats(0, 1, exclude_max=True)).map(np.array)
alphas = log_floats(1e-3, 1.0)


def inside(axis: Array, versine: float, omega: Array, slack: float = 1e-12) -> bool:
    return bool(np.linalg.norm(omega - axis) ** 2 / 2 <= versine * (1 + 1e-9) + slack)


def cap_rule(axis: Array, versine: float, order: int = 48) -> tuple[Array, Array]:
    """Directions and weights of a quadrature over a cap: Gauss in the versine, trapezoid in azimuth."""
    x, w = np.polynomial.legendre.leggauss(order)
    v = versine * (1 + x) / 2
    phi = 2 * PI * np.arange(2 * order) / (2 * order)
    helper = np.eye(3)[np.argmin(np.abs(axis))]
    side = np.cross(helper, axis) / np.linalg.norm(np.cross(helper, axis))
    r = np.sqrt(v * (2 - v))[:, None, None]
    around = np.cos(phi)[:, None] * side + np.sin(phi)[:, None] * np.cross(axis, side)
    omega = (1 - v)[:, None, None] * axis + r * around
    return omega, np.broadcast_to((w * versine / 2 * PI / order)[:, None], omega.shape[:2])


# ---- caps -----------------------------------------------------------------------------------------------------------


@given(directions(), versines, squares)
def test_cap_samples_are_inside(axis: Array, versine: float, u: Array) -> None:
    omega = pd.cap_sample(axis, versine, u)
    assert inside(axis, versine, omega)
    assert np.linalg.norm(omega) == pytest.approx(1, abs=1e-14)


@given(directions(), versines, directions(), versines)
@example(Z, 1.0, Z, 1.0)
@example(Z, 1.0, -Z, 1.0)
@example(Z, 0.3, Z, 0.3)
@example(Z, 2.0, -Z, 1e-12)
def test_intersection_of_two_caps(axis1: Array, h1: float, axis2: Array, h2: float) -> None:
    """Symmetric, at most the smaller cap, and what the other cap's complement leaves of the first."""
    both = pd.cap_intersection(axis1, h1, axis2, h2)
    assert both == pytest.approx(pd.cap_intersection(axis2, h2, axis1, h1), rel=1e-12, abs=1e-14 * min(h1, h2))
    assert 0 <= both <= 2 * PI * min(h1, h2) * (1 + 1e-12)
    rest = pd.cap_intersection(axis1, h1, -axis2, 2 - h2)
    assert both + rest == pytest.approx(2 * PI * h1, rel=1e-10)


@given(directions(), versines, directions(), versines, st.floats(0, 1))
def test_intersection_grows_with_the_cap(axis1: Array, h1: float, axis2: Array, h2: float, part: float) -> None:
    smaller, larger = pd.cap_intersection(axis1, np.array([part * h1, h1]), axis2, h2)
    assert smaller <= larger * (1 + 1e-10) + 1e-14 * min(h1, h2)


@given(versines, versines, st.floats(0, PI))
def test_approximate_intersection_is_exact_at_its_ends(h1: float, h2: float, separation: float) -> None:
    psi1, psi2 = (2 * np.arcsin(np.sqrt(h / 2)) for h in sorted((h1, h2)))
    approximate = pd.cap_intersection_approximate_at(h1, h2, separation)
    if separation >= psi1 + psi2:
        assert approximate == 0
    elif separation <= psi2 - psi1:
        assert approximate == pytest.approx(2 * PI * min(h1, h2), rel=1e-12)
    assert 0 <= approximate <= 2 * PI * min(h1, h2) * (1 + 1e-12)


@given(directions(), versines, directions(), versines, directions(), versines)
@example(Z, 1.0, Z, 1.0, -Z, 1.0)
@example(Z, 0.5, Z, 0.5, Z, 0.5)
def test_intersection_of_three_caps(a: Array, h1: float, b: Array, h2: float, c: Array, h3: float) -> None:
    """Symmetric; a third cap that is the sphere, or one of the two, changes nothing; complements add up."""
    scale = min(h1, h2, h3)
    three = pd.cap_intersection3(a, h1, b, h2, c, h3)
    assert three == pytest.approx(pd.cap_intersection3(c, h3, a, h1, b, h2), rel=1e-9, abs=1e-11 * scale)
    two = pd.cap_intersection(a, h1, b, h2)
    tolerance = {"rel": 1e-9, "abs": 1e-11 * min(h1, h2)}
    assert pd.cap_intersection3(a, h1, b, h2, c, 2.0) == pytest.approx(two, **tolerance)
    assert pd.cap_intersection3(a, h1, b, h2, b, h2) == pytest.approx(two, **tolerance)
    rest = pd.cap_intersection3(a, h1, b, h2, -c, 2 - h3)
    assert three + rest == pytest.approx(two, rel=1e-9, abs=1e-9 * min(h1, h2) + 3e-15)  # 2 - h3 is rounded


@given(directions(), versines, directions(), versines, squares)
def test_clipped_cap_samples_are_inside(axis1: Array, h1: float, axis2: Array, h2: float, u: Array) -> None:
    assume(pd.cap_intersection(axis1, h1, axis2, h2) > 1e-6 * min(h1, h2))
    omega = pd.cap_intersection_sample(axis1, h1, axis2, h2, u)
    assert inside(axis1, h1, omega)
    assert inside(axis2, h2, omega)


@given(directions(), versines, directions())
@example(Z, 1.0, Z)
@example(Z, 1.0, -Z)
@example(np.array([1.0, 0.0, 0.0]), 1.0, Z)
def test_clamped_cosine_over_a_cap_and_its_complement(axis: Array, versine: float, normal: Array) -> None:
    integral = pd.cap_cosine_integral(axis, versine, normal)
    rest = pd.cap_cosine_integral(-axis, 2 - versine, normal)
    assert 0 <= integral <= min(PI, 2 * PI * versine) * (1 + 1e-12)
    assert integral + rest == pytest.approx(PI, rel=1e-12)
    # the integral of the cosine itself is signed: above less below
    below = pd.cap_cosine_integral(axis, versine, -normal)
    signed = PI * versine * (2 - versine) * (axis @ normal)
    assert integral - below == pytest.approx(signed, rel=1e-9, abs=1e-12 * min(versine, 1))


@given(directions(), versines, directions(), versines, directions())
def test_clamped_cosine_over_two_caps(a: Array, h1: float, b: Array, h2: float, normal: Array) -> None:
    """As the cosine SPTD at r_p = 0, where g is the antipodal map."""
    both = PI * pd.sptd_cosine_integral2(a, h1, b, h2, Z, 1.0, -normal)
    rest = PI * pd.sptd_cosine_integral2(a, h1, -b, 2 - h2, Z, 1.0, -normal)
    assert both + rest == pytest.approx(pd.cap_cosine_integral(a, h1, normal), rel=1e-8, abs=1e-9 * h1 + 2e-15)


# ---- projected caps -------------------------------------------------------------------------------------------------


@given(directions(), st.one_of(log_floats(1e-10, 1.0), st.just(1.0)), directions(), squares)
def test_projected_cap_inverse(axis: Array, versine: float, normal: Array, u: Array) -> None:
    """invert(sample(u)) = u, and the sample is in the cap and above the horizon."""
    sine = np.sqrt(versine * (2 - versine))
    z = axis @ normal
    assume(z > -0.999 * sine)
    # near-degenerate ellipses, and the branch cut of the polar angle, have no inverse to rounding
    assume(abs(z) > 1e-3 * sine)
    assume(abs(z - sine) > 1e-6)
    assume(0.01 < u[0] < 0.99)
    assume(0.01 < u[1] < 0.99)
    omega = pd.projected_cap_sample(axis, versine, normal, u)
    assert inside(axis, versine, omega)
    assert omega @ normal >= -1e-15
    assert pd.projected_cap_pdf(axis, versine, normal, omega) > 0
    np.testing.assert_allclose(pd.projected_cap_invert(axis, versine, normal, omega), u, atol=1e-10 / sine + 1e-9)


@given(st.floats(PI / 2 + 1e-3, PI - 1e-3), st.floats(1e-3, 1 - 1e-3), st.floats(1e-4, 1 - 1e-4))
def test_projected_cap_density_is_bounded(theta: float, versine: float, u: float) -> None:
    sine = np.sqrt(versine * (2 - versine))
    assume(-np.cos(theta) < sine * 0.999)
    axis = np.array([np.sin(theta), 0, np.cos(theta)])
    side = np.linspace(1e-6, 1 - 1e-6, 24)
    omega = pd.projected_cap_sample(axis, versine, Z, np.stack(np.meshgrid(side, side), -1))
    density = pd.projected_cap_pdf(axis, versine, Z, omega) / omega[..., 2]
    density = density[density > 0]
    bound = pd.projected_cap_density_bound(axis, versine, Z)
    assert density.max() / density.min() <= bound * (1 + 1e-6)
    assert bound <= pd.projected_cap_worst_density_bound(1 / sine) * (1 + 1e-9)


# ---- the pivot transformation and its distributions ------------------------------------------------------------------


@given(directions(), directions(), deltas)
def test_pivot_is_its_own_inverse(omega: Array, u: Array, delta: float) -> None:
    g = pd.pivot_transform(omega, u, delta)
    back = pd.pivot_transform(g, u, delta)
    jacobians = pd.pivot_jacobian(omega, u, delta), pd.pivot_jacobian(g, u, delta)
    # the way back stretches by the square root of a Jacobian
    np.testing.assert_allclose(back, omega, atol=1e-14 * max(1, np.sqrt(max(jacobians))) / np.sqrt(delta))
    assert jacobians[0] * jacobians[1] == pytest.approx(1, rel=1e-13 / delta)


@given(arrays(np.float64, 3, elements=st.floats(-5, 5)), directions(), st.floats(0.05, 1.0))
def test_pivot_of_points_is_its_own_inverse(r: Array, u: Array, delta: float) -> None:
    if delta < 1:
        assume(np.linalg.norm(r - u / (1 - delta)) > 1e-3)
    back = pd.pivot_transform_point(pd.pivot_transform_point(r, u, delta), u, delta)
    np.testing.assert_allclose(back, r, atol=1e-8)


@given(directions(), versines, directions(), deltas)
def test_pivoted_cap(axis: Array, versine: float, u: Array, delta: float) -> None:
    """Mapped twice it is the cap; its complement maps to the complement; its rim to the rim."""
    assume(delta > 1e-3)
    image, h = pd.pivot_transform_cap(axis, versine, u, delta)
    assert np.linalg.norm(image) == pytest.approx(1, abs=1e-14)
    assert 0 <= h <= 2
    rest, h_rest = pd.pivot_transform_cap(-axis, 2 - versine, u, delta)
    np.testing.assert_allclose(rest, -image, atol=1e-11 / delta)
    assert h + h_rest == pytest.approx(2, abs=1e-14 / delta**2)  # 2 - versine is rounded, and stretched
    if h < 1.999:
        back, h_back = pd.pivot_transform_cap(image, h, u, delta)
        assert h_back == pytest.approx(versine, rel=1e-9 / delta)
        np.testing.assert_allclose(back, axis, atol=1e-11 / delta)
    rim = pd.pivot_transform(pd.cap_sample(axis, versine, np.array([1 - 1e-16, 0.3])), u, delta)
    assert np.linalg.norm(rim - image) ** 2 / 2 == pytest.approx(h, rel=1e-6 / delta, abs=1e-9 / delta)


@given(directions(), st.floats(0.05, 1.0), directions(), versines, directions())
def test_sptd_integral_is_the_integral_of_eval(u: Array, delta: float, axis: Array, versine: float, n: Array) -> None:
    assume(delta > 0.2)
    omega, weight = cap_rule(axis, versine)
    uniform = (pd.sptd_uniform_eval(omega, u, delta) * weight).sum()
    assert pd.sptd_uniform_integral(axis, versine, u, delta) == pytest.approx(uniform, rel=1e-6)
    cosine = (pd.sptd_cosine_eval(omega, u, delta, n) * weight).sum()  # with a crease where the cosine is clamped
    assert pd.sptd_cosine_integral(axis, versine, u, delta, n) == pytest.approx(cosine, rel=2e-2, abs=2e-3 * uniform)


@given(directions(), deltas, directions())
def test_sptd_is_normalised(u: Array, delta: float, n: Array) -> None:
    assert pd.sptd_uniform_integral(Z, 2.0, u, delta) == pytest.approx(1, rel=1e-12)
    assert pd.sptd_cosine_integral(Z, 2.0, u, delta, n) == pytest.approx(1, rel=1e-12)


@given(directions(), deltas, directions(), versines, directions(), versines, directions())
def test_sptd_over_several_caps(u: Array, d: float, a: Array, h1: float, b: Array, h2: float, n: Array) -> None:
    """Two caps that cover the sphere between them, one of them twice, and the sphere as a third."""
    assume(d > 1e-3)
    for one, two, three, extra in (
        (pd.sptd_uniform_integral, pd.sptd_uniform_integral2, pd.sptd_uniform_integral3, ()),
        (pd.sptd_cosine_integral, pd.sptd_cosine_integral2, pd.sptd_cosine_integral3, (n,)),
    ):
        alone = one(a, h1, u, d, *extra)
        both = two(a, h1, b, h2, u, d, *extra)
        rest = two(a, h1, -b, 2 - h2, u, d, *extra)
        assert both + rest == pytest.approx(alone, rel=1e-7, abs=1e-10)
        assert three(a, h1, b, h2, Z, 2.0, u, d, *extra) == pytest.approx(both, rel=1e-7, abs=1e-10)


@given(directions(), deltas, directions(), log_floats(1e-8, 2.0), squares)
def test_sptd_cap_samples_are_inside(u: Array, delta: float, axis: Array, versine: float, random: Array) -> None:
    assume(delta > 1e-4)
    omega = pd.sptd_uniform_cap_sample(axis, versine, u, delta, random)
    assert inside(axis, versine, omega, slack=1e-13 / delta**2)


# ---- GGX under lights -----------------------------------------------------------------------------------------------


@st.composite
def views(draw: st.DrawFn) -> Array:
    theta, phi = draw(st.floats(0, 1.53)), draw(st.floats(0, 2 * PI))
    return np.array([np.sin(theta) * np.cos(phi), np.sin(theta) * np.sin(phi), np.cos(theta)])


@given(views(), directions(), log_floats(1e-10, 0.5), alphas, alphas, squares)
@example(Z, Z, 1e-4, 0.01, 0.01, np.array([0.0, 0.0]))
def test_ggx_under_a_cap(wo: Array, axis: Array, versine: float, ax: float, ay: float, u: Array) -> None:
    """Monotone in the cap; samples inside it; weight times pdf is D / (4 cos_o)."""
    integral, valid = pd.ggx_cap_integral(wo, axis, versine, ax, ay)
    if not valid:
        assert integral == 0
        return
    assert 0 <= integral <= (1 + 1e-9) / wo[2]
    smaller, smaller_valid = pd.ggx_cap_integral(wo, axis, versine * 0.9, ax, ay)
    assert smaller_valid
    assert smaller <= integral * (1 + 1e-12)
    omega, weight, pdf = pd.ggx_cap_sample(wo, axis, versine, ax, ay, u)
    assert inside(axis, versine, omega, slack=1e-15)
    half = (wo + omega) / np.linalg.norm(wo + omega)
    ndf = 1 / (PI * ax * ay * ((half / [ax, ay, 1]) ** 2).sum() ** 2)
    assert weight * pdf == pytest.approx(ndf / (4 * wo[2]), rel=1e-6)


@given(views(), directions(), st.floats(1e-3, 0.3), st.floats(0.05, 1.0))
def test_ggx_cap_is_the_limit_of_polygons(wo: Array, axis: Array, versine: float, alpha: float) -> None:
    integral, valid = pd.ggx_cap_integral(wo, axis, versine, alpha, alpha)
    assume(valid)
    assume(axis[2] > np.sqrt(versine * (2 - versine)))  # all above the horizon
    rim = pd.cap_sample(axis, versine, np.stack([np.full(256, 1 - 1e-16), np.arange(256) / 256], -1))
    polygon, half = pd.ggx_polygon_integral(wo, alpha, alpha, rim)
    assert polygon == pytest.approx(integral, rel=2e-3)
    assert np.linalg.norm(half) == pytest.approx(1, abs=1e-12)
    assert half[2] > 0


@given(views(), arrays(np.float64, (4, 3), elements=st.floats(-2, 2)), alphas, alphas)
def test_ggx_over_polygons(wo: Array, vertices: Array, ax: float, ay: float) -> None:
    """Scale and sense do not matter, a polygon is the sum of its triangles, and chords converge."""
    assume((np.linalg.norm(vertices, axis=-1) > 0.1).all())
    # convex and seen from outside its plane: a star from the origin is not needed, a plane is
    origin, x, y = vertices[0], vertices[1], vertices[2]
    normal = np.cross(x, y)
    assume(abs(origin @ normal) > 0.05)
    square = np.array([origin, origin + x, origin + x + y, origin + y])
    assume((np.linalg.norm(square, axis=-1) > 0.05).all())
    alpha = max(ax, 0.05), max(ay, 0.05)
    whole, _ = pd.ggx_polygon_integral(wo, *alpha, square)
    tolerance = {"rel": 1e-8, "abs": 1e-12}
    assert pd.ggx_polygon_integral(wo, *alpha, square[::-1] * 3)[0] == pytest.approx(whole, **tolerance)
    triangles = [pd.ggx_polygon_integral(wo, *alpha, square[k])[0] for k in ([0, 1, 2], [0, 2, 3])]
    assert sum(triangles) == pytest.approx(whole, **tolerance)
    assert pd.ggx_polygon_chords_integral(wo, *alpha, square, 2000)[0] == pytest.approx(whole, rel=1e-3, abs=1e-6)


# ---- input ----------------------------------------------------------------------------------------------------------

BAD = [
    (lambda: pd.cap_solid_angle(2.5), "versine"),
    (lambda: pd.cap_solid_angle(np.nan), "versine"),
    (lambda: pd.cap_sample([1.0, 1.0, 0.0], 0.5, [0.5, 0.5]), "axis"),
    (lambda: pd.cap_sample(Z, 0.5, [0.5, 1.0]), "u"),
    (lambda: pd.cap_sample(Z, 0.5, [0.5, 0.5, 0.5]), "u"),
    (lambda: pd.cap_intersection(Z, 0.5, [np.inf, 0.0, 0.0], 0.5), "axis2"),
    (lambda: pd.sphere_light_cap(Z, -1.0), "radius"),
    (lambda: pd.projected_cap_sample(Z, 1.5, Z, [0.5, 0.5]), "versine"),
    (lambda: pd.projected_cap_warp(Z, 0.5, Z, -0.5, 0.0), "axis"),
    (lambda: pd.pivot_transform(Z, Z, 0.0), "delta"),
    (lambda: pd.pivot_transform(Z, Z, 1.5), "delta"),
    (lambda: pd.pivot_transform(Z, 2 * Z, 0.5), "pivot_direction"),
    (lambda: pd.pivot_transform_point(2 * Z, Z, 0.5), "r"),
    (lambda: pd.ggx_cap_integral(-Z, Z, 0.1, 0.5, 0.5), "wo"),
    (lambda: pd.ggx_cap_integral(Z, Z, 0.1, 0.0, 0.5), "alpha_x"),
    (lambda: pd.ggx_cap_sample(Z, -Z, 0.5, 0.5, 0.5, [0.5, 0.5]), "versine"),
    (lambda: pd.ggx_polygon_integral(Z, 0.5, 0.5, [[1.0, 0.0, 1.0], [0.0, 1.0, 1.0]]), "polygon"),
    (lambda: pd.ggx_polygon_integral(Z, 0.5, 0.5, np.eye(3) * [0.0, 1.0, 1.0]), "polygon"),
    (lambda: pd.ggx_polygon_chords_integral(Z, 0.5, 0.5, np.eye(3), 2.5), "chords"),
    (lambda: pd.cap_intersection(np.ones((2, 3)) / np.sqrt(3), 0.5, Z, np.ones(3)), "versine2"),
    (lambda: pd.cap_solid_angle("half"), "versine"),
]


@pytest.mark.parametrize(("call", "argument"), BAD)
def test_bad_input_is_named(call: Any, argument: str) -> None:
    with pytest.raises(ValueError, match=rf"^{argument} "):
        call()


@pytest.mark.parametrize(
    ("arguments", "expected"),
    [
        ((np.float32(0.5),), np.float32),
        ((np.float64(0.5),), np.float64),
        ((0.5,), np.float64),
        ((1,), np.float64),
        ((np.ones((2, 3), np.float32),), np.float32),
    ],
)
def test_results_have_the_precision_of_the_input(arguments: tuple, expected: type) -> None:
    assert pd.cap_solid_angle(*arguments).dtype == expected


def test_arguments_broadcast() -> None:
    axes = np.eye(3)[:, None, :]
    versine = np.linspace(0, 1, 5)
    areas = pd.cap_intersection(axes, versine, Z, 1.0)
    assert areas.shape == (3, 5)
    assert areas[2, 3] == pd.cap_intersection(Z, versine[3], Z, 1.0)
    single = pd.cap_sample(Z.astype(np.float32), 0.5, np.array([0.5, 0.5], np.float32))
    assert single.dtype == np.float32
    assert pd.cap_sample(Z.astype(np.float32), 0.5, [0.5, 0.5]).dtype == np.float64

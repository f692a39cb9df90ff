"""Stability of caps, the pivot transformation, SPTDs and GGX under lights: float32 against double towards each limit.

`python -m tests.core.test_stability` prints the table.
"""

from collections.abc import Callable, Iterator, Sequence

import numpy as np
import pivot_core.distributions as pd
import pytest

from tests.core.stability import Sweep, print_table

Array = np.ndarray
Z = np.array([0.0, 0.0, 1.0])
U = np.array([0.3, 0.6])
AXIS = np.array([0.48, 0.6, 0.64])
ROUNDING = "so does the rounding of the input"


def powers(first: int, last: int) -> Sequence[float]:
    """10^first .. 10^last, three a decade."""
    return list(10.0 ** np.linspace(first, last, 3 * abs(last - first) + 1))


def turned(axis: Array, angle: float, azimuth: float = 0.7) -> Array:
    """axis turned by an angle."""
    side = np.cross(axis, np.eye(3)[np.argmin(np.abs(axis))])
    side /= np.linalg.norm(side)
    side = np.cos(azimuth) * side + np.sin(azimuth) * np.cross(axis, side)
    return np.cos(angle) * axis + np.sin(angle) * side


def elevated(z: float, azimuth: float = 0.4) -> Array:
    """The direction at the height z."""
    r = np.sqrt((1 - z) * (1 + z))
    return np.array([r * np.cos(azimuth), r * np.sin(azimuth), z])


def sine(versine: float) -> float:
    return float(np.sqrt(versine * (2 - versine)))


def caps() -> Iterator[Sweep]:
    small, large = powers(0, -12), [2 - t for t in powers(0, -7)]
    yield Sweep("cap_solid_angle", pd.cap_solid_angle, "versine -> 0", small, lambda h: (h,))
    yield Sweep("cap_sample", pd.cap_sample, "versine -> 0", small, lambda h: (AXIS, h, U))
    yield Sweep("cap_sample", pd.cap_sample, "versine -> 2", large, lambda h: (AXIS, h, U))
    yield Sweep("cap_pdf", pd.cap_pdf, "versine -> 0", small, lambda h: (AXIS, h, AXIS))
    yield Sweep("sphere_light_cap", pd.sphere_light_cap, "radius -> 0", small, lambda r: (2 * AXIS, r))
    for what, index in (("axis", 0), ("versine", 1)):
        yield Sweep(
            f"sphere_light_cap's {what}",
            lambda c, r, i=index: pd.sphere_light_cap(c, r)[i],
            "touching",
            powers(0, -7),
            lambda t: ((1 + t) * Z, 1.0),
        )
    for name, z in (("above", 0.6), ("on the horizon", 0.0), ("just above", 1e-4)):
        yield Sweep(
            "cap_cosine_integral",
            pd.cap_cosine_integral,
            f"versine -> 0, {name}",
            small,
            lambda h, z=z: (elevated(z), h, Z),
        )
    for part in (-0.9, -0.5, 0.5, 0.999):
        yield Sweep(
            "cap_cosine_integral",
            pd.cap_cosine_integral,
            f"versine -> 0, axis at {part} sin psi",
            powers(0, -9),
            lambda h, part=part: (elevated(part * sine(h)), h, Z),
        )
    for h in (0.3, 1e-3):
        yield Sweep(
            "cap_cosine_integral",
            pd.cap_cosine_integral,
            f"horizon grazed from below, versine {h}",
            powers(-1, -5),
            lambda t, h=h: (elevated(-sine(h) * (1 - t)), h, Z),
            2e-2,
            f"(sin psi - |z|)^(5/2): {ROUNDING}",
        )
        yield Sweep(
            "cap_cosine_integral",
            pd.cap_cosine_integral,
            f"horizon grazed from above, versine {h}",
            powers(-1, -7),
            lambda t, h=h: (elevated(sine(h) * (1 - t)), h, Z),
        )
    yield Sweep("cap_cosine_integral", pd.cap_cosine_integral, "versine -> 2", large, lambda h: (AXIS, h, Z))


def intersections() -> Iterator[Sweep]:
    two, three = pd.cap_intersection, pd.cap_intersection3
    for separation in (0.3, 0.7, 1.2):

        def both_small(h: float, s: float = separation) -> tuple:
            return h, 2 * h, s * 2 * sine(h)

        for name, function in (
            ("cap_intersection_at", pd.cap_intersection_at),
            ("cap_intersection_approximate_at", pd.cap_intersection_approximate_at),
        ):
            yield Sweep(name, function, f"both versines -> 0, apart {separation}", powers(-1, -12), both_small)
    for part in (-0.9, -0.3, 0.0, 0.5, 0.9):

        def on_horizon(h: float, part: float = part) -> tuple:
            return elevated(part * sine(h)), h, Z, 1.0

        yield Sweep("cap_intersection", two, f"versine -> 0, axis at {part} sin psi", powers(0, -9), on_horizon)
        yield Sweep(
            "cap_intersection_sample",
            pd.cap_intersection_sample,
            f"versine -> 0, axis at {part} sin psi",
            powers(0, -9),
            lambda h, f=on_horizon: (*f(h), U),
        )
        yield Sweep(
            "cap_intersection3",
            three,
            f"versine -> 0, axis at {part} sin psi, in a cone",
            powers(0, -5),
            lambda h, f=on_horizon: (*f(h), elevated(0.5), 0.6),
        )
    yield Sweep("cap_intersection", two, "coinciding", powers(0, -6), lambda t: (AXIS, 0.3, turned(AXIS, t), 0.3))
    yield Sweep(
        "cap_intersection", two, "versines -> 2", powers(0, -6), lambda t: (AXIS, 2 - t, turned(AXIS, 1.0), 2 - t / 2)
    )
    yield Sweep(
        "cap_intersection",
        two,
        "touching from inside",
        powers(-1, -6),
        lambda t: (turned(Z, 0.3 - t), 0.1, Z, 1 - np.cos(0.3 + np.arccos(0.9))),
    )
    yield Sweep(
        "cap_intersection_at",
        pd.cap_intersection_at,
        "touching from outside",
        powers(-1, -4),
        lambda t: (0.1, 0.2, np.arccos(0.9) + np.arccos(0.8) - t),
        2e-3,
        f"gap^(3/2): {ROUNDING}",
    )


def projected() -> Iterator[Sweep]:
    for part in (2.0, 0.5, -0.5, -0.95):

        def light(h: float, part: float = part) -> tuple:
            return elevated(part * sine(h)), h, Z

        walk, case = powers(-1, -9), f"versine -> 0, axis at {part} sin psi"
        yield Sweep("projected_cap_sample", pd.projected_cap_sample, case, walk, lambda h, f=light: (*f(h), U))
        yield Sweep(
            "projected_cap_invert",
            pd.projected_cap_invert,
            case,
            powers(-1, -5),
            lambda h, f=light: (*f(h), pd.projected_cap_sample(*f(h), U)),
        )
        yield Sweep(
            "projected_cap_pdf",
            pd.projected_cap_pdf,
            case,
            powers(-1, -5),
            lambda h, f=light: (*f(h), pd.projected_cap_sample(*f(h), U)),
        )
    yield Sweep(
        "projected_cap_sample",
        pd.projected_cap_sample,
        "r_y -> 1",
        powers(-1, -6),
        lambda t: (elevated(-0.4), 1 - t, Z, U),
    )
    yield Sweep(
        "projected_cap_pdf",
        pd.projected_cap_pdf,
        "r_y -> 1",
        powers(-1, -6),
        lambda t: (elevated(-0.4), 1 - t, Z, elevated(0.3)),
    )
    for h in (0.3, 1e-3):
        yield Sweep(
            "projected_cap_sample",
            pd.projected_cap_sample,
            f"horizon grazed, versine {h}",
            powers(-1, -5),
            lambda t, h=h: (elevated(-sine(h) * (1 - t)), h, Z, U),
        )
        yield Sweep(
            "projected_cap_sample",
            pd.projected_cap_sample,
            f"axis on the horizon, versine {h}",
            powers(-1, -9),
            lambda t, h=h: (elevated(t), h, Z, U),
        )
    yield Sweep(
        "projected_cap_density_bound",
        pd.projected_cap_density_bound,
        "r_y -> 1",
        powers(-1, -6),
        lambda t: (elevated(-0.4), 1 - t, Z),
    )
    bound = pd.projected_cap_worst_density_bound
    yield Sweep("projected_cap_worst_density_bound", bound, "r_y -> 1", powers(0, -6), lambda t: (1 + t,))
    yield Sweep("projected_cap_worst_density_bound", bound, "r_y -> 0", powers(0, 12), lambda t: (1 + t,))


def pivots() -> Iterator[Sweep]:
    for name, delta in (("delta -> 0", lambda t: t), ("delta -> 1", lambda t: 1 - t)):
        walk = powers(0, -7)[1:]
        yield Sweep("pivot_transform", pd.pivot_transform, name, walk, lambda t, d=delta: (Z, AXIS, d(t)))
        yield Sweep("pivot_jacobian", pd.pivot_jacobian, name, walk, lambda t, d=delta: (Z, AXIS, d(t)))
        for h in (1e-10, 1e-4, 0.3, 1.0, 1.7):
            yield Sweep(
                f"pivot_transform_cap, versine {h}",
                pd.pivot_transform_cap,
                name,
                walk,
                lambda t, d=delta, h=h: (Z, h, AXIS, d(t)),
            )
            yield Sweep(
                f"sptd_uniform_integral, versine {h}",
                pd.sptd_uniform_integral,
                name,
                walk,
                lambda t, d=delta, h=h: (Z, h, AXIS, d(t)),
            )
            for points in (3.0, 1.0, 0.3):  # cap and lobe aligned to within a multiple of the lobe's width

                def aligned(t: float, d: Callable = delta, h: float = h, points: float = points) -> tuple:
                    return turned(AXIS, min(points * d(t), 3.0)), h, AXIS, d(t)

                yield Sweep(
                    f"sptd_uniform_integral, versine {h}",
                    pd.sptd_uniform_integral,
                    f"{name}, {points} widths apart",
                    walk,
                    aligned,
                )
    for t in (1e-2, 1e-4, 1e-6):
        yield Sweep(
            "pivot_transform_cap",
            pd.pivot_transform_cap,
            f"versine -> 0, delta {t}",
            powers(0, -12),
            lambda h, t=t: (turned(AXIS, t), h, AXIS, t),
        )
        yield Sweep(
            "sptd_uniform_cap_sample",
            pd.sptd_uniform_cap_sample,
            f"versine -> 0, delta {t}",
            powers(0, -12),
            lambda h, t=t: (turned(AXIS, t), h, AXIS, t, U),
        )
        yield Sweep(
            "sptd_uniform_eval",
            pd.sptd_uniform_eval,
            f"omega -> pivot, delta {t}",
            powers(0, -7),
            lambda a, t=t: (turned(AXIS, a), AXIS, t),
        )
        yield Sweep(
            "sptd_uniform_integral2",
            pd.sptd_uniform_integral2,
            f"versine -> 0, delta {t}, at the horizon",
            powers(0, -9),
            lambda h, t=t: (elevated(0.5 * sine(h)), h, Z, 1.0, elevated(0.3), t),
        )
    yield Sweep(
        "pivot_transform_cap", pd.pivot_transform_cap, "versine -> 2", powers(0, -6), lambda t: (Z, 2 - t, AXIS, 0.3)
    )
    yield Sweep("sptd_cosine_eval", pd.sptd_cosine_eval, "delta -> 0", powers(0, -6), lambda t: (Z, AXIS, t, -AXIS))
    yield Sweep(
        "sptd_cosine_integral",
        pd.sptd_cosine_integral,
        "versine -> 0",
        powers(0, -12),
        lambda h: (Z, h, AXIS, 0.3, -AXIS),
    )
    yield Sweep(
        "sptd_cosine_integral2",
        pd.sptd_cosine_integral2,
        "versine -> 0 at the horizon",
        powers(0, -6),
        lambda h: (elevated(0.3 * sine(h)), h, Z, 1.0, AXIS, 0.3, -AXIS),
    )


def ggx() -> Iterator[Sweep]:
    def integral(*arguments: Array) -> Array:
        value, valid = pd.ggx_cap_integral(*arguments)
        assert valid
        return value

    for degrees in (0.0, 60.0, 88.0):
        wo = turned(Z, np.radians(degrees))
        mirror = wo * [-1, -1, 1]
        for alpha in (1e-3, 0.03, 1.0):
            for off in (0.0, 1.0, 5.0):
                axis = turned(mirror, off * alpha * 0.3 * wo[2])
                if axis[2] < 0.01:
                    continue
                case = f"alpha {alpha:g}, {degrees:g} deg, off {off:g}"
                yield Sweep(
                    "ggx_cap_integral",
                    integral,
                    f"versine -> 0, {case}",
                    powers(-3, -10),
                    lambda h, w=wo, c=axis, a=alpha: (w, c, h, a, a),
                )
                yield Sweep(
                    "ggx_cap_sample",
                    lambda *a: pd.ggx_cap_sample(*a)[:2],
                    f"versine -> 0, {case}",
                    powers(-3, -10),
                    lambda h, w=wo, c=axis, a=alpha: (w, c, h, a, a, U),
                )
        yield Sweep(
            "ggx_cap_integral",
            integral,
            f"alpha -> 1e-3, {degrees:g} deg",
            powers(0, -3),
            lambda a, w=wo, c=mirror: (w, turned(c, 0.3 * w[2] * a), 1e-4, a, min(1.0, 3 * a)),
        )
    yield Sweep(
        "ggx_cap_integral", integral, "view -> light", powers(-1, -7), lambda t: (AXIS, turned(AXIS, t), 0.01, 0.3, 0.5)
    )
    yield Sweep(
        "ggx_cap_integral",
        integral,
        "view -> 88 deg",
        list(np.linspace(1.0, 1.536, 12)),
        lambda t: (turned(Z, t), turned(Z, t) * [-1, -1, 1], 1e-4, 0.1, 0.1),
    )
    square = np.array([[-1.0, -1.0, 0.1], [1.0, -1.0, -0.1], [1.0, 1.0, 0.2], [-1.0, 1.0, 0.4]])
    for alpha in (0.02, 0.2, 1.0):
        wo = elevated(0.5)
        mirror = wo * [-1, -1, 1]
        yield Sweep(
            "ggx_polygon_integral",
            pd.ggx_polygon_integral,
            f"size -> 0, alpha {alpha:g}",
            powers(0, -5),
            lambda t, a=alpha, w=wo, m=mirror: (w, a, a, m + t * square),
        )
        yield Sweep(
            "ggx_polygon_integral",
            pd.ggx_polygon_integral,
            f"horizon grazed, alpha {alpha:g}",
            powers(0, -4),
            lambda t, a=alpha: (elevated(0.1), a, a, np.array([[-1, -0.5, -t], [-1, 0.5, t], [-1, 0, t]])),
        )


SWEEPS = [*caps(), *intersections(), *projected(), *pivots(), *ggx()]


@pytest.mark.parametrize("sweep", SWEEPS, ids=[f"{sweep.name}: {sweep.limit}" for sweep in SWEEPS])
def test_float32_holds_on_the_way_to_a_limit(sweep: Sweep) -> None:
    error, t = sweep.worst()
    assert error <= sweep.bound, f"at {t}"


if __name__ == "__main__":
    print_table(SWEEPS)

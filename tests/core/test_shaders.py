"""Shaders: what a program makes of a place is what the surface is made of there, by every way that light takes."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np
import pivot_core
import pytest

from tests.core.scenes import Floats, add_plane, add_sphere, place, render, set_camera

Program = pivot_core.Program
DARK = (0.0, 0.0, 0.0)


def constant(program: Program, *numbers: float) -> list[int]:
    """Registers that hold numbers, by way of the place: nothing that knows what varies can fold them."""
    x = program.add("position", [])
    return [program.add("math_multiply_add", [(x, 0.0), (-1, 0.0), (-1, number)]) for number in numbers]


def shader(material: pivot_core.Material, **varying: tuple[float, ...]) -> pivot_core.Shader:
    program = Program()
    registers = {name: constant(program, *numbers) for name, numbers in varying.items()}
    return pivot_core.Shader(material, program, registers)


def lit_floor(material: pivot_core.Material | pivot_core.Shader, lamp: bool = True, **mesh: object) -> pivot_core.Scene:
    scene = pivot_core.Scene()
    positions = np.array([[-1, -1, 0], [1, -1, 0], [1, 1, 0], [-1, 1, 0]], np.float32)
    floor = scene.add_mesh("floor", positions, np.arange(4), np.array([[0, 1, 2], [0, 2, 3]]), **mesh)
    scene.add_instances("floor", floor, place(), [scene.add_material("floor", material)])
    if lamp:
        scene.add_light("sun", pivot_core.SunLight((0, 0, 1), 0.01, (np.pi,) * 3))
    set_camera(scene, (0, 0, 2), size=(16, 16), half_width=0.4)
    return scene


def test_numbers_of_a_program_are_those_of_a_material() -> None:
    numbers = {
        "diffuse": (0.2, 0.4, 0.6),
        "alpha": (0.3,),
        "conductor_f0": (0.1, 0.2, 0.3),
        "conductor_f90": (0.3, 0.3, 0.3),
        "conductor_weight": (0.3,),
        "dielectric_weight": (0.5,),
        "dielectric_ior": (1.4,),
        "dielectric_tint": (0.9, 0.8, 0.7),
        "emission": (0.1, 0.0, 0.2),
    }
    plain = {name: value[0] if len(value) == 1 else value for name, value in numbers.items()}
    expected = render(lit_floor(pivot_core.Material(**plain)), samples=4)
    made = render(lit_floor(shader(pivot_core.Material(), **numbers)), samples=4)
    np.testing.assert_allclose(made, expected, rtol=1e-4, atol=1e-5)
    analytic = [
        render(lit_floor(m), samples=1, integrator="ANALYTIC")
        for m in (pivot_core.Material(**plain), shader(pivot_core.Material(), **numbers))
    ]
    np.testing.assert_allclose(analytic[1], analytic[0], rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
@pytest.mark.parametrize("domain", ["vertex", "corner"])
def test_an_attribute_is_interpolated(domain: str, integrator: str) -> None:
    program = Program()
    scene = pivot_core.Scene()
    uv = program.add("attribute", [], [scene.attribute_id("uv"), 1.0])
    material = pivot_core.Shader(pivot_core.Material(), program, {"emission": [uv, uv + 1, -1]})
    values = {"uv": np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32)}
    picture = render(
        lit_floor(material, lamp=False, **{f"{domain}_attributes": values}),
        samples=1,
        integrator=integrator,
        filter_width_px=0.01,
    )
    # The view plane's half width 0.4 at distance 1 sees 0.8 m of the floor's 1 m at distance 2.
    across = 0.5 + 0.8 * (np.arange(16) + 0.5 - 8) / 16
    np.testing.assert_allclose(picture[..., 0], np.broadcast_to(across, (16, 16)), atol=2e-3)
    np.testing.assert_allclose(picture[..., 1], np.broadcast_to(across[:, None], (16, 16)), atol=2e-3)
    assert np.all(picture[..., 2] == 0)


@pytest.mark.parametrize("max_bounces", [0, 1, 5])
def test_what_shines_by_a_program_lights_as_what_shines_alike(max_bounces: int) -> None:
    def room(glow: pivot_core.Material | pivot_core.Shader) -> Floats:
        scene = pivot_core.Scene()
        grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5,) * 3))
        scene.add_instances("floor", add_plane(scene, 3), place(), [grey])
        scene.add_instances("ceiling", add_plane(scene, 1), place(z=1.0), [scene.add_material("glow", glow)])
        set_camera(scene, (0, -3, 0.8), (0, 0, 0.5), size=(16, 12), half_width=0.5)
        pictures = [
            render(scene, samples=256, seed=seed, max_bounces=max_bounces, light_sampling="BSDF") for seed in range(4)
        ]
        return np.mean(pictures, axis=0)

    plain = room(pivot_core.Material(emission=(1.0, 2.0, 3.0), diffuse=(0.3,) * 3))
    made = room(shader(pivot_core.Material(diffuse=(0.3,) * 3), emission=(1.0, 2.0, 3.0)))
    assert plain.mean() > 0.3
    np.testing.assert_allclose(made.mean(axis=(0, 1)), plain.mean(axis=(0, 1)), rtol=5e-3)


def test_a_normal_turns_the_surface() -> None:
    program = Program()
    leaning = np.array([np.sin(0.5), 0, np.cos(0.5)], np.float32)
    normal = constant(program, *leaning)
    made = pivot_core.Shader(pivot_core.Material(diffuse=(0.5,) * 3), program, {"normal": normal})
    straight = render(lit_floor(pivot_core.Material(diffuse=(0.5,) * 3)), samples=16, max_bounces=0)
    turned = render(lit_floor(made), samples=16, max_bounces=0)
    np.testing.assert_allclose(turned[..., 0] / straight[..., 0], np.cos(0.5), rtol=1e-2)
    np.testing.assert_allclose(render(lit_floor(made), "Normal", samples=1)[8, 8], leaning, atol=1e-5)


@pytest.mark.parametrize("integrator", ["MONTE_CARLO", "ANALYTIC"])
def test_what_is_no_number_reaches_no_light(integrator: str) -> None:
    program = Program()
    x = program.add("position", [])
    huge = program.add("math_multiply_add", [(x, 0.0), (-1, 0.0), (-1, 3e38)])
    infinite = program.add("math_multiply", [(huge, 0.0), (-1, 1e10)])
    nothing = program.add("math_subtract", [(infinite, 0.0), (infinite, 0.0)])
    for register in (infinite, nothing):
        wrong = {"diffuse": [register] * 3, "alpha": [register], "emission": [register] * 3, "normal": [register] * 3}
        picture = render(lit_floor(pivot_core.Shader(pivot_core.Material(), program, wrong)), integrator=integrator)
        assert np.all(picture[..., :3] == 0)


def test_a_world_shines_by_its_direction() -> None:
    program = Program()
    direction = program.add("position", [])
    up = program.add("math_maximum", [(direction + 2, 0.0), (-1, 0.0)])
    sky = pivot_core.Shader(pivot_core.Material(emission=(0.25,) * 3), program, {"emission": [up] * 3})
    scene = lit_floor(pivot_core.Material(diffuse=(0.5,) * 3), lamp=False)
    scene.set_world_shader(sky)
    # Half of the integral of cos^2 over the hemisphere, over pi.
    picture = render(scene, samples=1024, max_bounces=0)
    np.testing.assert_allclose(picture[..., :3].mean(), 0.5 * 2 / 3, rtol=5e-3)
    set_camera(scene, (0, 0, 1), (5, 0, 1), size=(16, 16))
    seen = render(scene, samples=1, filter_width_px=0.01)[12, 8, 0]
    y = 0.4 * (12.5 - 8) / 8
    np.testing.assert_allclose(seen, y / np.hypot(np.hypot(1, y), 0.4 / 16), rtol=1e-3)


def under_a_sky(alpha: float | None, brightness: tuple[float, float, float]) -> pivot_core.Scene:
    """A floor and a ball below a sky that is bright in a patch of some 10 degrees, and dim around."""
    program = Program()
    towards = np.array([0.6, 0.0, 0.8], np.float32)
    direction = program.add("position", [])
    cosine = program.add(
        "vector_dot_product", [(direction + i, 0.0) for i in range(3)] + [(-1, float(part)) for part in towards]
    )
    patch = program.add("math_greater_than", [(cosine, 0.0), (-1, float(np.cos(0.1)))])
    sky = [program.add("math_multiply_add", [(patch, 0.0), (-1, part), (-1, 0.1)]) for part in brightness]
    material = (
        pivot_core.Material(diffuse=(0.6,) * 3)
        if alpha is None
        else pivot_core.Material(alpha=alpha, conductor_f0=(0.8,) * 3, conductor_f90=(1,) * 3)
    )
    scene = pivot_core.Scene()
    grey = scene.add_material("grey", pivot_core.Material(diffuse=(0.5,) * 3))
    scene.add_instances("floor", add_plane(scene, 10), place(), [grey])
    scene.add_instances("ball", add_sphere(scene), place(0, 0, 0.5, 0.5), [scene.add_material("ball", material)])
    scene.set_world_shader(pivot_core.Shader(pivot_core.Material(emission=(0.1,) * 3), program, {"emission": sky}))
    set_camera(scene, (0, -4, 2), (0, 0, 0.4), (24, 18), 0.3)
    return scene


@pytest.mark.parametrize("alpha", [None, 0.09, 0.5])
def test_every_way_to_sample_a_sky_gives_one_picture(alpha: float | None) -> None:
    scene = under_a_sky(alpha, (60.0, 40.0, 20.0))
    results = {}
    for mode in ("JOINT", "SPTD", "MIS", "LIGHT", "BSDF"):
        samples = 1024 if mode == "BSDF" else 64
        means = [
            render(scene, samples=samples, seed=seed, light_sampling=mode, max_bounces=1)[..., :3].mean(dtype=float)
            for seed in range(6)
        ]
        results[mode] = np.mean(means), np.std(means, ddof=1) / np.sqrt(len(means))
    mean, error = results.pop("MIS")
    assert error < 0.01 * mean
    for mode, (other, other_error) in results.items():
        assert abs(other - mean) < 4 * np.hypot(error, other_error) + 1e-3 * mean, (mode, other, mean)


def test_a_bright_patch_of_sky_is_sampled() -> None:
    """The floor's noise: BSDF samples alone find the patch, a hundredth of the hemisphere, seldom."""
    scene = under_a_sky(None, (60.0, 40.0, 20.0))
    noise = {}
    for mode in ("JOINT", "BSDF"):
        pictures = [render(scene, samples=16, seed=seed, light_sampling=mode, max_bounces=0) for seed in range(8)]
        noise[mode] = float(np.var(pictures, axis=0)[..., :3].mean())
    assert noise["JOINT"] < noise["BSDF"] / 20


WRONG: dict[str, Callable[[], object]] = {
    "there is no op 'math_wonder'": lambda: Program().add("math_wonder", []),
    "it takes 2 numbers, not 1": lambda: Program().add("math_add", [(-1, 1.0)]),
    "of settings it takes 1, not 0": lambda: Program().add("magic", [(-1, 0.0)] * 5),
    "of settings it takes 6 or more, not 5": lambda: pivot_core.run_op(
        "table", np.zeros((1, 1), np.float32), [0.0] * 5
    ),
    "register 3 holds nothing yet": lambda: Program().add("math_add", [(3, 0.0), (-1, 1.0)]),
    "there is no neighbour 3": lambda: Program().add("position", [], [], 3),
    "what may vary of this material is normal": lambda: shader(pivot_core.Material(), gloss=(1.0,)),
    "diffuse is 3 numbers": lambda: shader(pivot_core.Material(), diffuse=(1.0,)),
    "the program has no register 7": lambda: pivot_core.Shader(pivot_core.Material(), Program(), {"alpha": [7]}),
    "depends on where it runs": lambda: pivot_core.run_op("position", np.zeros((1, 0), np.float32)),
    "must have shape": lambda: pivot_core.run_op("math_add", np.zeros((1, 3), np.float32)),
    "attribute 'uv' must have shape": lambda: lit_floor(
        pivot_core.Material(), vertex_attributes={"uv": np.zeros((3, 2), np.float32)}
    ),
    "must have 1 to 4 numbers": lambda: lit_floor(
        pivot_core.Material(), vertex_attributes={"uv": np.zeros((4, 5), np.float32)}
    ),
}


@pytest.mark.parametrize("message", WRONG)
def test_what_is_wrong_is_named(message: str) -> None:
    with pytest.raises(ValueError, match=message):
        WRONG[message]()

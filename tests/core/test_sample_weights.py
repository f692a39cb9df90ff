"""No fireflies: what one joint light sample may add.

Of a light of radiance 1, at most RADIANCE_BOUND, whatever it is and wherever it stands. Of a spherical light all above
the horizon, no more than so many times what it adds in the mean: SINGLE_BOUND on a surface of one lobe, LAYERED_BOUND
on one of two, where the lobes' shares are guessed with Fresnel at the light's middle, and none is drawn less often than
0.05. (A light that all but hides behind the horizon adds so little in the mean that no such ratio is bounded; nor is it
for an area light much larger than the lobe, which is cut into patches.)
"""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pivot_core
import pytest
from light_cells import Array, CapLight, SeenLight, flat, sphere, sun
from scenes import set_camera

from tests.core.stability_scenes import SCENES, EdgeScene

RADIANCE_BOUND, SINGLE_BOUND, LAYERED_BOUND = 10.0, 2.5, 20.0
CASES, SAMPLES = 2_000, 512  # 1e6 samples
WHITE = (1.0, 1.0, 1.0)


def unit(v: Array) -> Array:
    return v / np.linalg.norm(v)


def samples(mode: str, material: pivot_core.Material, wo: Array, seen: SeenLight, seed: int) -> Array:
    """What each sample adds (n,), 0 for those that add nothing."""
    scene = pivot_core.Scene()
    scene.add_light("light", seen.light)
    set_camera(scene, (0, 0, 10))
    radiance = scene.sample_lights(material, (0.0, 0.0, 0.0), tuple(wo), mode, 1, SAMPLES, seed)[1].max(-1)
    return np.append(radiance, np.zeros(SAMPLES - len(radiance)))


def metal(alpha: float) -> pivot_core.Material:
    return pivot_core.Material(alpha=alpha, conductor_f0=WHITE, conductor_f90=WHITE)


def random_cases() -> Iterator[tuple[pivot_core.Material, Array, SeenLight]]:
    """Roughness 1e-3 to 1, views to 89 degrees, lights of radiance 1 from 1e-3 to 1.5 rad: half of them about the
    mirrored view, the others anywhere; all at least in part above the horizon."""
    random = np.random.default_rng(3)
    for index in range(CASES):
        alpha = 10 ** random.uniform(-3, 0)
        plastic = pivot_core.Material(diffuse=(0.5,) * 3, alpha=alpha, dielectric_weight=1.0)
        material = (metal(alpha), plastic, pivot_core.Material(diffuse=WHITE))[index % 3]
        cos_o, phi = random.uniform(0.02, 1), random.uniform(0, 2 * np.pi)
        sin_o = np.sqrt(1 - cos_o**2)
        wo = np.array([sin_o * np.cos(phi), sin_o * np.sin(phi), cos_o])
        half_angle = 10 ** random.uniform(-3, np.log10(1.5))
        axis = unit(random.normal(size=3))
        if random.random() < 0.5:
            axis = unit(wo * [-1, -1, 1] + 2 * max(alpha, half_angle) * random.random() * axis)
        axis[2] = abs(axis[2]) if axis[2] < -np.sin(half_angle) else axis[2]
        distance = 10 ** random.uniform(-1, 1)
        if index // 3 % 3 == 0:
            seen: SeenLight = sphere(tuple(distance * axis), distance * np.sin(half_angle))
        elif index // 3 % 3 == 1:
            seen = sun(tuple(axis), half_angle)
        else:
            u = unit(np.cross(axis, random.normal(size=3)))
            v = unit(np.cross(axis, u) + random.uniform(-1, 1) * axis)
            size = distance * np.tan(half_angle)
            shape = (tuple(distance * axis), tuple(size * u), tuple(size * 10 ** random.uniform(-1, 0) * v))
            seen = flat(*shape, ellipse=random.random() < 0.5)
        yield material, wo, seen


def test_joint_samples_are_bounded() -> None:
    most, most_of_uniform = 0.0, 0.0
    most_over_mean = {"single": 0.0, "layered": 0.0}
    for seed, (material, wo, seen) in enumerate(random_cases()):
        added = samples("JOINT", material, wo, seen, seed)
        most = max(most, added.max())
        if isinstance(seen, CapLight) and seen.axis[2] > np.sqrt(seen.versine * (2 - seen.versine)):
            lobes = "layered" if seed % 3 == 1 else "single"
            most_over_mean[lobes] = max(most_over_mean[lobes], added.max() / added.mean())
            most_of_uniform = max(most_of_uniform, samples("LIGHT", material, wo, seen, seed).max())
    assert most < RADIANCE_BOUND
    assert most_over_mean["single"] < SINGLE_BOUND
    assert most_over_mean["layered"] < LAYERED_BOUND
    assert most_of_uniform > 100 * RADIANCE_BOUND  # the same cases are hard


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name.replace(" ", "-"))
def test_joint_samples_are_bounded_on_the_stability_scenes(scene: EdgeScene) -> None:
    seen = sphere(scene.light, scene.radius_m)
    added = samples("JOINT", metal(scene.alpha), unit(np.array(scene.eye)), seen, 1)
    assert added.mean() > 0
    assert added.max() < RADIANCE_BOUND

"""The light tree: every light hangs in it once, groups enclose what is below them, and choices add up."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pivot_core
import pytest
from scenes import set_camera

RANDOM = np.random.default_rng(3)
MATERIALS = {
    "chalk": pivot_core.Material(diffuse=(0.8, 0.8, 0.8)),
    "steel": pivot_core.Material(alpha=0.02, conductor_f0=(0.9, 0.9, 0.9), conductor_f90=(1, 1, 1)),
    "plastic": pivot_core.Material(diffuse=(0.5, 0.1, 0.1), alpha=0.1, dielectric_weight=1.0),
}


class Lights:
    """A scene of many lights of every kind around the origin, and what the tree should know of each."""

    def __init__(self, count: int) -> None:
        self.scene = pivot_core.Scene()
        set_camera(self.scene, (0, 0, 10))
        self.center = RANDOM.uniform(-20, 20, (count, 3)).astype(np.float32)  # of a sun: towards it
        self.reach_m = RANDOM.uniform(0.01, 1.0, count)  # how far from its centre a light extends
        self.intensity = RANDOM.uniform(0.1, 10.0, count)
        self.kind = np.array([("sphere", "spot", "area", "sun")[i % 4] for i in range(count)], object)
        self.center[self.kind == "sun", 2] = 20.0
        for i in range(count):
            self.scene.add_light(f"light {i}", self._light(i))

    def _light(self, i: int) -> object:
        center, reach_m, white = self.center[i].tolist(), self.reach_m[i], (1, 1, 1)
        intensity = (self.intensity[i] * np.array(white)).tolist()
        if self.kind[i] == "sphere":
            return pivot_core.SphereLight(center, reach_m, intensity)
        if self.kind[i] == "spot":
            return pivot_core.SpotLight(center, reach_m, intensity, (0, 0, -1), 0.5, 0.2)
        if self.kind[i] == "area":
            half = reach_m / 2  # the tree takes the sum of both half-extents for the reach
            radiance = self.intensity[i] / (4 * half**2)
            return pivot_core.AreaLight(center, (half, 0, 0), (0, -half, 0), (radiance * np.array(white)).tolist())
        direction = self.center[i] / np.linalg.norm(self.center[i])
        return pivot_core.SunLight(direction.tolist(), 0.01, intensity)


def lights_below(tree: list, node: int) -> Iterator[int]:
    for child in tree[node][0]:
        if child < 0:
            yield ~child
        else:
            yield from lights_below(tree, child)


@pytest.mark.parametrize("count", [0, 1, 7, 8, 9, 64, 65, 500])
def test_every_light_is_a_leaf_once(count: int) -> None:
    tree = Lights(count).scene.light_tree()
    if count == 0:
        assert tree == []
        return
    assert sorted(lights_below(tree, 0)) == list(range(count))
    assert all(len(child) <= 8 for child, *_ in tree)
    groups = [child for children, *_ in tree for child in children if child >= 0]
    assert sorted(groups) == list(range(1, len(tree)))  # each node but the root hangs below one other


def test_groups_enclose_their_lights_and_shine_as_much() -> None:
    lights = Lights(300)
    tree = lights.scene.light_tree()
    seen = 0
    for child, center, radius_m, radiance, sun_versine in tree:
        for i in range(len(child)):
            if child[i] < 0:
                continue
            below = list(lights_below(tree, child[i]))
            is_sun = {lights.kind[light] == "sun" for light in below}
            assert len(is_sun) == 1, "suns are grouped with suns"
            if is_sun == {True}:
                assert sun_versine[i] == 2.0
                np.testing.assert_allclose(radiance[i] * np.pi, lights.intensity[below].sum(), rtol=1e-4)
                continue
            assert sun_versine[i] == 0.0
            apart = np.linalg.norm(lights.center[below] - center[i], axis=1)
            assert (apart + lights.reach_m[below] <= radius_m[i] * (1 + 1e-5)).all()
            np.testing.assert_allclose(np.pi * radius_m[i] ** 2 * radiance[i], lights.intensity[below].sum(), rtol=1e-4)
            seen += 1
    assert seen > 10


@pytest.mark.parametrize("material", MATERIALS)
@pytest.mark.parametrize("count", [1, 20, 300])
def test_choices_have_the_probabilities_they_say(material: str, count: int) -> None:
    lights = Lights(count)
    steps = 20_000
    u = ((np.arange(steps) + 0.5) / steps).astype(np.float32)
    for position in ((0, 0, 0), (5, -3, 1), (0, 0, -30)):
        place = MATERIALS[material], position, (0.6, 0.0, 0.8)
        probabilities = lights.scene.choice_probabilities(*place)
        # a group's sphere may rise above the horizon where none of its lights does: that u finds nothing
        light, probability = lights.scene.choose_lights(*place, u)
        found = light >= 0
        np.testing.assert_allclose(probability[found], probabilities[light[found]], rtol=1e-4)
        np.testing.assert_array_equal(probability[~found], 0)
        shares = np.bincount(light[found], minlength=count) / steps
        np.testing.assert_allclose(shares, probabilities, atol=3e-4)
        np.testing.assert_allclose(probabilities.sum() + (~found).mean(), 1.0, atol=3e-4 * count**0.5)


@pytest.mark.parametrize("material", MATERIALS)
def test_where_every_light_is_in_view_one_is_chosen(material: str) -> None:
    """Below all of them, where they shine to."""
    probabilities = Lights(100).scene.choice_probabilities(MATERIALS[material], (0, 0, -200), (0.6, 0.0, 0.8))
    assert (probabilities > 0).all()
    assert probabilities.sum() == pytest.approx(1.0, rel=1e-5)


def test_no_light_below_the_horizon_is_chosen() -> None:
    lights = Lights(100)
    probabilities = lights.scene.choice_probabilities(MATERIALS["plastic"], (0, 0, 200), (0.6, 0.0, 0.8))
    assert probabilities[lights.kind == "sun"].sum() == pytest.approx(1.0, rel=1e-5)
    assert (probabilities[lights.kind != "sun"] == 0).all()

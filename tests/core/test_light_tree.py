"""The light tree: every light hangs in it once, nodes know the statistics of what is below them, choices down it, with
or without a cut, have the probability they say, and go by what the surface reflects."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np
import pivot_core
import pytest
from numpy.typing import NDArray
from scenes import set_camera

Floats = NDArray[np.float64]
WHITE = (1.0, 1.0, 1.0)
METAL = {"conductor_f0": WHITE, "conductor_f90": WHITE}
MATERIALS = {
    "chalk": pivot_core.Material(diffuse=(0.8, 0.8, 0.8)),
    "steel": pivot_core.Material(alpha=0.02, **METAL),
    "mirror": pivot_core.Material(alpha=0.001, **METAL),
    "plastic": pivot_core.Material(diffuse=(0.5, 0.1, 0.1), alpha=0.1, dielectric_weight=1.0),
    "paper": pivot_core.Material(diffuse=(0.4, 0.4, 0.4), lobes=[("translucent", {"color": (0.3, 0.4, 0.3)})]),
}
CUTS = (1, 16, 64)
BLEND = 0.2


class Lights:
    """A scene of lights of every kind around the origin, and what the tree should know of each."""

    def __init__(self, count: int, seed: int = 3) -> None:
        random = np.random.default_rng(seed)
        self.scene = pivot_core.Scene()
        set_camera(self.scene, (0, 0, 10))
        self.kind = np.array([("sphere", "spot", "rectangle", "ellipse", "sun")[i % 5] for i in range(count)], object)
        self.mean = random.uniform(-20, 20, (count, 3))
        self.mean[self.kind == "sun", 2] = 20.0
        self.mean[self.kind == "sun"] /= np.linalg.norm(self.mean[self.kind == "sun"], axis=1)[:, None]
        self.radius_m = random.uniform(0.01, 1.0, count)  # or half the sides of an area light
        self.peak = random.uniform(0.1, 10.0, count)  # W/sr
        self.axis = random.normal(size=(count, 3))
        self.axis /= np.linalg.norm(self.axis, axis=1)[:, None]
        self.intensity = self.peak.copy()  # the mean over all directions
        self.direction = np.zeros((count, 3))  # the mean of where it shines
        self.scatter_m2 = self.radius_m**2 / 2  # of a sphere, seen as a disk, across any line of sight, twice
        for i in range(count):
            self.scene.add_light(f"light {i}", self._light(i))

    def _light(self, i: int) -> object:
        mean, radius_m, axis = self.mean[i].tolist(), self.radius_m[i], self.axis[i]
        intensity = [self.peak[i]] * 3
        if self.kind[i] == "sphere":
            return pivot_core.SphereLight(mean, radius_m, intensity)
        if self.kind[i] == "spot":
            cosine = np.linspace(0.5, 1.0, 10_001)
            part = np.minimum((cosine - 0.5) / (0.5 * BLEND), 1.0)
            falloff = part**2 * (3 - 2 * part)
            self.intensity[i] *= falloff.mean() * 0.5 / 2  # half the cosines, of two in all
            self.direction[i] = axis * (falloff * cosine).sum() / falloff.sum()
            return pivot_core.SpotLight(mean, radius_m, intensity, axis.tolist(), 0.5, BLEND)
        if self.kind[i] == "sun":
            self.radius_m[i] *= 0.1
            self.scatter_m2[i] = np.sin(self.radius_m[i]) ** 2 / 2
            return pivot_core.SunLight(mean, self.radius_m[i], intensity)
        is_ellipse = self.kind[i] == "ellipse"
        u = np.cross(axis, (0.3, 0.5, 0.8))
        u *= radius_m / np.linalg.norm(u)
        v = 0.5 * np.cross(axis, u)
        self.scatter_m2[i] = (u @ u + v @ v) / (4 if is_ellipse else 3)
        self.intensity[i] /= 4
        self.direction[i] = axis * 2 / 3  # Lambert's cosine
        radiance = self.peak[i] / (np.linalg.norm(np.cross(u, v)) * (np.pi if is_ellipse else 4))
        return pivot_core.AreaLight(mean, u.tolist(), v.tolist(), [radiance] * 3, is_ellipse)


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


def test_lights_at_one_place_are_told_apart() -> None:
    """Nothing can cut them by place."""
    scene = pivot_core.Scene()
    set_camera(scene, (0, 0, 10))
    for _ in range(100):
        scene.add_light("lamp", pivot_core.SphereLight((1, 2, 3), 0.1, WHITE))
    assert sorted(lights_below(scene.light_tree(), 0)) == list(range(100))
    probabilities = scene.choice_probabilities(MATERIALS["chalk"], (0, 0, 0), (0, 0, 1))
    np.testing.assert_allclose(probabilities, 0.01, rtol=1e-4)


def test_groups_have_the_statistics_of_their_lights() -> None:
    lights = Lights(300)
    tree = lights.scene.light_tree()
    seen = 0
    for child, mean, variance_m2, bound_m, intensity, axis, sharpness in tree:
        for i in range(len(child)):
            if child[i] < 0:
                continue
            below = list(lights_below(tree, child[i]))
            is_sun = lights.kind[below] == "sun"
            assert is_sun.all() or not is_sun.any(), "suns are grouped with suns"
            weight = lights.intensity[below]
            if is_sun.all():  # their irradiance
                np.testing.assert_allclose(intensity[i], weight.sum(), rtol=1e-3)
            own_mean = np.average(lights.mean[below], axis=0, weights=weight)
            np.testing.assert_allclose(mean[i], own_mean, atol=0.05)
            apart = np.linalg.norm(lights.mean[below] - own_mean, axis=1)
            scatter_m2 = np.average(apart**2 + lights.scatter_m2[below], weights=weight)
            np.testing.assert_allclose(2 * variance_m2[i], scatter_m2, rtol=0.02)
            assert (apart + 0.5 * lights.radius_m[below] <= bound_m[i] + 0.05).all()
            r = np.linalg.norm(np.average(lights.direction[below], axis=0, weights=weight))
            if r > 1e-3:
                own_axis = np.average(lights.direction[below], axis=0, weights=weight) / r
                assert axis[i] @ own_axis > 1 - 0.02 / r**2
            kappa = r * (3 - r**2) / (1 - r**2)
            np.testing.assert_allclose(sharpness[i], kappa, rtol=0.03, atol=0.03)
            mean_of_lobe = (1 - np.exp(-2 * sharpness[i])) / (2 * sharpness[i]) if sharpness[i] > 0 else 1.0
            np.testing.assert_allclose(intensity[i] * mean_of_lobe, weight.sum(), rtol=0.02)
            seen += 1
    assert seen > 20


@pytest.mark.parametrize("cut_nodes", CUTS)
@pytest.mark.parametrize("material", MATERIALS)
@pytest.mark.parametrize("count", [1, 20, 300])
def test_choices_have_the_probabilities_they_say(material: str, count: int, cut_nodes: int) -> None:
    lights = Lights(count)
    steps = 20_000
    u = ((np.arange(steps) + 0.5) / steps).astype(np.float32)
    for position in ((0, 0, 0), (5, -3, 1), (0, 0, -30)):
        place = MATERIALS[material], position, (0.6, 0.0, 0.8)
        probabilities = lights.scene.choice_probabilities(*place, cut_nodes)
        # a group may reach above the horizon where none of its lights does: that u finds nothing
        light, probability = lights.scene.choose_lights(*place, u, cut_nodes)
        found = light >= 0
        np.testing.assert_allclose(probability[found], probabilities[light[found]], rtol=1e-3)
        np.testing.assert_array_equal(probability[~found], 0)
        shares = np.bincount(light[found], minlength=count) / steps
        np.testing.assert_allclose(shares, probabilities, atol=3e-4)
        np.testing.assert_allclose(probabilities.sum() + (~found).mean(), 1.0, atol=3e-4 * count**0.5)


@pytest.mark.parametrize("cut_nodes", CUTS)
@pytest.mark.parametrize("material", MATERIALS)
def test_every_light_that_adds_something_can_be_chosen(material: str, cut_nodes: int) -> None:
    """Of lights of every kind, seen from places among them."""
    random = np.random.default_rng(4)
    met = 0
    for seed in range(6):
        lights = Lights(60, seed)
        position = tuple(random.uniform(-15, 15, 3).tolist())
        for i, kind in enumerate(lights.kind):
            towards = lights.mean[i] if kind == "sun" else lights.mean[i] - position
            near = towards / np.linalg.norm(towards) + random.normal(scale=0.02, size=(200, 3))
            wi = (near / np.linalg.norm(near, axis=1)[:, None]).astype(np.float32)
            place = MATERIALS[material], position, (0.6, 0.0, 0.8)
            reflected = lights.scene.light_densities(*place, "LIGHT", 1, wi)[1][:, i]
            if (reflected > 0).any():
                assert lights.scene.choice_probabilities(*place, cut_nodes)[i] > 0, kind
                met += 1
    assert met > 50


def spheres(count: int, spread_m: float) -> tuple[pivot_core.Scene, Floats, Floats]:
    """Two crowds of lamps on either side, their places and radii."""
    random = np.random.default_rng(8)
    center = random.normal((0, 0, 5), spread_m, (count, 3))
    center[:, 0] += np.where(np.arange(count) < count // 2, -2.5, 2.5)
    radius_m = random.uniform(0.02, 0.2, count)
    scene = pivot_core.Scene()
    set_camera(scene, (0, 0, 10))
    for place, radius in zip(center, radius_m, strict=True):
        scene.add_light("lamp", pivot_core.SphereLight(place.tolist(), radius, WHITE))
    return scene, center, radius_m


def reflected(alpha: float | None, wo: Floats, center: Floats, radius_m: Floats) -> Floats:
    """What white metal, or without an alpha chalk, at the origin reflects of each lamp of 1 W/sr, in closed form."""
    distance = np.linalg.norm(center, axis=1)
    axis = center / distance[:, None]
    if alpha is None:
        return axis[:, 2] / (np.pi * distance**2)
    value, _, _ = pivot_core.shading.ggx_sphere_light(
        alpha, wo.astype(np.float32), axis.astype(np.float32), np.arcsin(radius_m / distance), 0.1
    )
    return value / (np.pi * radius_m**2)


@pytest.mark.parametrize("wo", [(0.0, 0.0, 1.0), (0.4, 0.3, 0.866), (0.9, 0.1, 0.424)])
@pytest.mark.parametrize("alpha", [None, 0.1, 0.3, 0.6, 1.0])
def test_a_light_is_chosen_by_what_is_reflected_of_it(alpha: float | None, wo: tuple[float, float, float]) -> None:
    scene, center, radius_m = spheres(8, 0.8)
    direction = np.array(wo) / np.linalg.norm(wo)
    material = MATERIALS["chalk"] if alpha is None else pivot_core.Material(alpha=alpha, **METAL)
    share = reflected(alpha, direction, center, radius_m)
    share /= share.sum()
    probability = scene.choice_probabilities(material, (0, 0, 0), wo)
    assert np.sum(share**2 / probability) - 1 < 0.02


@pytest.mark.parametrize("wo", [(0.0, 0.0, 1.0), (0.4, 0.3, 0.866), (0.9, 0.1, 0.424)])
@pytest.mark.parametrize("alpha", [None, 0.2, 0.5])
def test_a_crowd_is_chosen_by_what_is_reflected_of_all(alpha: float | None, wo: tuple[float, float, float]) -> None:
    """Of two nodes, by their Gaussians alone."""
    scene, center, radius_m = spheres(2000, 0.4)
    direction = np.array(wo) / np.linalg.norm(wo)
    material = MATERIALS["chalk"] if alpha is None else pivot_core.Material(alpha=alpha, **METAL)
    share = reflected(alpha, direction, center, radius_m)
    left = share[:1000].sum() / share.sum()
    probability = scene.choice_probabilities(material, (0, 0, 0), wo)[:1000].sum()
    assert probability / (1 - probability) == pytest.approx(left / (1 - left), rel=0.3)


def test_a_cut_finds_the_light_of_a_highlight() -> None:
    """The relative variance of choosing one of a thousand, which the benchmark light_choice.py has in full."""
    random = np.random.default_rng(5)
    scene = pivot_core.Scene()
    set_camera(scene, (0, 0, 10))
    center = np.append(random.uniform(-11, 11, (1000, 2)), np.full((1000, 1), 9.0), axis=1)
    radius_m = np.full(1000, 0.15)
    for place in center:
        scene.add_light("lamp", pivot_core.SphereLight(place.tolist(), 0.15, WHITE))
    steel = pivot_core.Material(alpha=0.1, **METAL)
    variance = {cut_nodes: [] for cut_nodes in CUTS}
    for _ in range(50):
        position = np.append(random.uniform(-8, 8, 2), 0.0)
        wo = random.normal(size=3)
        wo[2] = abs(wo[2]) + 0.3
        share = reflected(0.1, wo / np.linalg.norm(wo), center - position, radius_m)
        share /= share.sum()
        for cut_nodes, values in variance.items():
            probability = scene.choice_probabilities(steel, position.tolist(), wo.tolist(), cut_nodes)
            values.append(np.sum(share**2 / probability) - 1)
    means = [np.mean(values) for values in variance.values()]
    assert means == sorted(means, reverse=True)
    assert means[0] < 0.3
    assert means[-1] < 0.05


@pytest.mark.parametrize("material", MATERIALS)
def test_where_every_light_is_in_view_one_is_chosen(material: str) -> None:
    """Seen by lamps that shine all around."""
    scene, _, _ = spheres(100, 0.5)
    for cut_nodes in CUTS:
        probabilities = scene.choice_probabilities(MATERIALS[material], (0, 0, -200), (0.6, 0.0, 0.8), cut_nodes)
        assert (probabilities > 0).all()
        assert probabilities.sum() == pytest.approx(1.0, rel=1e-5)


def test_no_light_below_the_horizon_is_chosen() -> None:
    lights = Lights(100)
    for cut_nodes in CUTS:
        place = MATERIALS["plastic"], (0, 0, 200), (0.6, 0.0, 0.8)
        probabilities = lights.scene.choice_probabilities(*place, cut_nodes)
        assert probabilities[lights.kind == "sun"].sum() == pytest.approx(1.0, rel=1e-5)
        assert (probabilities[lights.kind != "sun"] == 0).all()

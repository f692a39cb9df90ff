"""The direct-light sampler as a whole, choice of the light included: do its samples follow the density it states, and
do they carry what is reflected over that density?"""

from __future__ import annotations

import itertools

import numpy as np
import pivot_core
import pytest
from light_cells import (
    Array,
    FlatLight,
    SeenLight,
    count_grid,
    density_grid,
    equal_cells,
    flat,
    sphere,
    spot,
    sun,
    triangle,
)
from scenes import place, set_camera
from scipy.stats import chi2

MODES = ("JOINT", "SPTD", "MIS", "LIGHT")  # BSDF draws no light samples
LIGHTS: dict[str, list[SeenLight]] = {
    "sphere": [sphere((1.0, 0.5, 2.0), 0.8)],
    "far sphere": [sphere((20.0, -30.0, 60.0), 0.5)],
    "sphere across the horizon": [sphere((2.0, 0.6, 0.3), 0.9)],
    "spot": [spot((0.5, -1.0, 2.0), 0.4, (0.3, 0.3, 0.0), 0.5)],
    "facing disk": [sphere((0.5, 0.3, 0.9), 1.2, facing_disk=True)],
    "facing disk across the horizon": [sphere((2.0, 0.6, 0.3), 0.9, facing_disk=True)],
    "cosine spot": [spot((0.5, -1.0, 2.0), 0.8, (0.3, 0.3, 0.0), 0.5, facing_disk=True, cosine=True)],
    "sun": [sun((0.6, 0.0, 0.8), 0.1)],
    "rectangle": [flat((-1.0, 0.8, 1.5), (0.9, 0.2, 0.0), (-0.1, 0.45, -0.3))],
    "large rectangle": [flat((0.3, 0.2, 0.4), (2.0, 0.0, 0.3), (0.0, 1.0, 0.0))],
    "disk": [flat((0.5, -1.0, 1.8), (0.6, 0.0, 0.0), (0.0, 0.6, 0.0), ellipse=True)],
    "rectangle across the horizon": [flat((-1.5, 0.6, 0.1), (0.2, 0.3, 0.5), (0.1, 0.7, -0.4))],
    "ellipse across the horizon": [flat((-1.5, 0.6, -0.1), (0.1, 0.4, 0.6), (0.3, 0.5, -0.2), ellipse=True)],
    "triangle": [triangle((-1.0, 0.2, 1.4), (0.7, 0.9, 0.9), (-0.4, -1.3, 0.8))],
    "small triangle": [triangle((-1.0, 0.8, 1.4), (-0.8, 1.0, 1.5), (-1.1, 0.9, 1.8))],
    "triangle across the horizon": [triangle((-1.2, -0.8, 0.3), (-0.9, 0.9, -0.4), (-0.7, 0.4, 0.9))],
    "three lights": [
        sphere((1.0, 0.5, 2.0), 0.3),
        sun((0.0, -0.6, 0.8), 0.05),
        flat((-1.5, 0.5, 2.0), (0.4, 0, 0), (0, 0.4, 0)),
    ],
    "twelve lights": [
        sphere((2 * np.cos(a), 2 * np.sin(a), 1.0 + 0.2 * i), 0.1 + 0.03 * i, 1.0 + i % 3)
        for i, a in enumerate(np.arange(12) * np.pi / 6)
    ],
}
WHITE = (1.0, 1.0, 1.0)
SURFACES = {
    "diffuse": pivot_core.Material(diffuse=(0.6, 0.5, 0.4)),
    "metal 0.02": pivot_core.Material(alpha=0.02, conductor_f0=(0.9, 0.6, 0.3), conductor_f90=WHITE),
    "metal 0.2": pivot_core.Material(alpha=0.2, conductor_f0=(0.9, 0.6, 0.3), conductor_f90=WHITE),
    "metal 0.7": pivot_core.Material(alpha=0.7, conductor_f0=(0.9, 0.6, 0.3), conductor_f90=WHITE),
    "plastic": pivot_core.Material(diffuse=(0.2, 0.3, 0.5), alpha=0.1, dielectric_weight=1.0),
    "both": pivot_core.Material(
        diffuse=(0.1, 0.1, 0.2),
        alpha=0.3,
        conductor_f0=(0.4, 0.3, 0.2),
        conductor_f90=(0.5,) * 3,
        conductor_weight=0.5,
        dielectric_weight=0.5,
        multiscatter=True,
    ),
}
METAL: dict[str, object] = {"conductor_f0": (0.9, 0.6, 0.3), "conductor_f90": WHITE}
BESIDE_BASE = {  # surfaces with lobes that a base has not
    "brushed": pivot_core.Material(lobes=[("anisotropic", METAL | {"alpha_x": 0.4, "alpha_y": 0.05, "rotation": 0.1})]),
    "tilted coat": pivot_core.Material(
        diffuse=(0.2, 0.3, 0.5),
        alpha=0.3,
        dielectric_weight=1.0,
        lobes=[
            ("base", {"alpha": 0.05, "dielectric_weight": 1.0}),
            ("anisotropic", METAL | {"alpha_x": 0.1, "alpha_y": 0.2, "normal": (0.36, 0.0, np.sqrt(1 - 0.36**2))}),
        ],
    ),
    "glass": pivot_core.Material(lobes=[("dielectric", {"alpha": 0.2, "ior": 1.5})]),
    "leaf": pivot_core.Material(diffuse=(0.2, 0.4, 0.1), lobes=[("translucent", {"color": (0.2, 0.3, 0.1)})]),
}
SURFACES |= BESIDE_BASE
VIEWS_RAD = {"from above": 0.5, "grazing": 1.45}  # towards the first light's mirror image, by azimuth
SAMPLES, CELL_DEPTH = 20_000, 6
GRID = 384  # pixels across a light that is alone

SOME_LIGHTS = ("sphere", "sphere across the horizon", "rectangle", "ellipse across the horizon", "small triangle")

# SPTD's lobe is one; modes that do not look at the surface need but one of them.
CASES = [
    (mode, light, surface, view)
    for mode, light, surface, view in itertools.product(MODES, LIGHTS, SURFACES, VIEWS_RAD)
    if (mode == "JOINT" and surface not in BESIDE_BASE)
    or (mode == "JOINT" and light in SOME_LIGHTS and (surface in ("brushed", "tilted coat") or view == "from above"))
    or (mode == "SPTD" and surface in ("metal 0.2", "plastic"))
    or (surface, view) == ("plastic", "from above")
]
SIGNIFICANCE = 1 - (1 - 0.01) ** (1 / len(CASES))  # of one case, for 1 % over all [Sidak]


class Case:
    def __init__(self, mode: str, light: str, surface: str, view: str) -> None:
        self.lights = LIGHTS[light]
        self.scene = pivot_core.Scene()
        for seen in self.lights:
            if isinstance(seen, FlatLight) and seen.triangle:
                mesh = self.scene.add_mesh("mesh", seen.light, np.arange(3), np.arange(3)[None])
                shines = self.scene.add_material("emitter", pivot_core.Material(emission=WHITE))
                self.scene.add_instances("triangle", mesh, place(), [shines])
            else:
                self.scene.add_light("light", seen.light)
        set_camera(self.scene, (0, 0, 10))
        middle = self.lights[0].directions(np.array([[0.5, 0.5]]))[0][0]
        azimuth, angle = np.arctan2(-middle[1], -middle[0]), VIEWS_RAD[view]
        wo = (np.sin(angle) * np.cos(azimuth), np.sin(angle) * np.sin(azimuth), np.cos(angle))
        self._vertex = (SURFACES[surface], (0.0, 0.0, 0.0), wo, mode, 1)  # one sample, of a light that is chosen

    def sample(self, count: int, seed: int) -> tuple[Array, Array]:
        wi, radiance = self.scene.sample_lights(*self._vertex, count, seed)
        return wi.astype(float), radiance.astype(float)

    def densities(self, wi: Array) -> tuple[Array, ...]:
        return tuple(a.astype(float) for a in self.scene.light_densities(*self._vertex, wi.astype(np.float32)))


@pytest.mark.parametrize(("mode", "light", "surface", "view"), CASES, ids=lambda name: name.replace(" ", "-"))
def test_light_samples_follow_their_density(mode: str, light: str, surface: str, view: str) -> None:
    """Pearson's chi^2 over all lights at once: each in cells that expect as many, and one cell for the paths whose
    sample adds nothing; cells that expect fewer than five count as one."""
    case = Case(mode, light, surface, view)
    wi = case.sample(SAMPLES, 2)[0]
    which = np.argmax(case.densities(wi)[0], axis=1)
    finer = 4 if surface == "metal 0.02" else 1  # its highlights are as small as a pixel
    pixels = 16 * round(finer * GRID / 16 / np.sqrt(len(case.lights)))
    observed, expected = [], []
    for index, seen in enumerate(case.lights):
        share = density_grid(lambda w, index=index: case.densities(w)[0][:, index], seen, pixels)
        count = count_grid(seen.places(wi[which == index]), pixels)
        cells = equal_cells(share, CELL_DEPTH)
        expected += [SAMPLES * share[cell].sum() for cell in cells]
        observed += [count[cell].sum() for cell in cells]
    total = np.sum(expected) / SAMPLES
    assert total < 1.003, "the density integrates to more than 1"
    o = np.append(observed, SAMPLES - np.sum(observed))
    e = np.append(expected, max(SAMPLES * (1 - total), 0.0))
    rare = e < 5
    o, e = (np.append(a[~rare], a[rare].sum()) for a in (o, e))
    o, e = (o[:-1], e[:-1]) if e[-1] < 1 and o[-1] < 3 else (o, e)
    statistic = ((o - e) ** 2 / e).sum()
    p = float(chi2.sf(statistic, len(e) - 1))
    assert p > SIGNIFICANCE, f"chi^2 {statistic:.1f} over {len(e)} cells, p = {p:.2g}"


@pytest.mark.parametrize(("mode", "light", "surface", "view"), CASES, ids=lambda name: name.replace(" ", "-"))
def test_light_samples_carry_what_is_reflected_over_their_density(
    mode: str, light: str, surface: str, view: str
) -> None:
    case = Case(mode, light, surface, view)
    wi, radiance = case.sample(2_000, 3)
    assert np.isfinite(radiance).all()
    densities, reflected, pdf_bsdf, shares = case.densities(wi)
    which = np.argmax(densities, axis=1)
    pdf = densities[np.arange(len(wi)), which]
    hit = pdf > 0  # at a light's rim a direction in float may just miss it
    assert hit.mean() > 0.999
    weight = np.where(shares[which] > 0, pdf / (pdf + pdf_bsdf), 1.0)[hit] / pdf[hit]
    expected = reflected[np.arange(len(wi)), which][hit] * weight[:, None]
    np.testing.assert_allclose(radiance[hit], expected, rtol=2e-3, atol=1e-6)

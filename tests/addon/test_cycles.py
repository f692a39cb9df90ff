"""Pivot and Cycles, in one Blender, agree on how bright each light and material is."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb

LIGHT_SAMPLING = ("JOINT", "SPTD", "MIS", "LIGHT", "BSDF")
TOLERANCE = 0.01  # of the picture's mean radiance


@dataclass(frozen=True)
class Rendered:
    folder: Path
    lights: dict[str, list[str]]  # scenes by light sampling
    materials: list[str]

    def picture(self, name: str) -> np.ndarray:
        """(height, width, 3) radiance."""
        return read_rgb(self.folder / f"{name}.exr")


@pytest.fixture(scope="module")
def rendered(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Rendered:
    folder = tmp_path_factory.mktemp("cycles")
    return Rendered(folder, **host.run("cycles_cases", folder))


def wrong(ratios: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """Those of the (3,) mean radiances over Cycles' that are not 1."""
    return {name: ratio for name, ratio in ratios.items() if np.any(np.abs(ratio - 1) > TOLERANCE)}


@pytest.mark.parametrize("light_sampling", LIGHT_SAMPLING)
def test_mean_radiance_of_lights_is_cycles(rendered: Rendered, light_sampling: str) -> None:
    def mean(scene: str, renderer: str) -> np.ndarray:
        return rendered.picture(f"{scene}_{renderer}").mean(axis=(0, 1))

    scenes = rendered.lights[light_sampling]
    assert not wrong({scene: mean(scene, light_sampling) / mean(scene, "CYCLES") for scene in scenes})


def test_mean_radiance_of_materials_is_cycles(rendered: Rendered) -> None:
    """Each material's ball without the world around it."""

    def means(renderer: str) -> list[np.ndarray]:
        balls = np.split(rendered.picture(f"materials_{renderer}"), len(rendered.materials), axis=1)
        return [ball[4:-4, 4:-4].mean(axis=(0, 1)) for ball in balls]

    ratios = [ours / cycles for ours, cycles in zip(means("JOINT"), means("CYCLES"), strict=True)]
    assert not wrong(dict(zip(rendered.materials, ratios, strict=True)))


def test_every_light_type_and_material_is_compared(rendered: Rendered, host: Host) -> None:
    joint = set(rendered.lights["JOINT"])
    wanted = "point spot soft_point soft_spot sun square rectangle disk ellipse nodes world world_nodes lobes"
    assert set(wanted.split()) <= joint
    assert ("raw" in joint) == (host.version >= (4, 4))
    for light_sampling in LIGHT_SAMPLING:
        assert {"disk", "bounces", "lobes"} <= set(rendered.lights[light_sampling])
    assert len(rendered.materials) == (9 if host.version >= (4, 0) else 1)

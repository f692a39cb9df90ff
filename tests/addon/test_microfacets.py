"""Materials whose microfacets an image tells, rendered in Blender."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from blender_host import Host
from exr import read_rgb


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("microfacets")


@pytest.fixture(scope="module")
def cases(host: Host, folder: Path) -> dict[str, object]:
    return host.run("microfacet_cases", folder)


@pytest.mark.parametrize("integrator", ["monte carlo", "analytic"])
def test_a_drawn_roughness_is_the_nodes(cases: object, folder: Path, integrator: str) -> None:
    image, node = (read_rgb(folder / f"{integrator} {part}.exr") for part in ("image", "node"))
    assert node.mean() > 0.01
    assert image.mean() == pytest.approx(node.mean(), rel=0.01)
    np.testing.assert_allclose(image, node, atol=0.05 * node.max())


def test_a_map_seen_from_afar_is_its_normals(cases: object, folder: Path) -> None:
    """Beside Cycles, whose pixels see many of the map's texels."""
    ours, cycles = (read_rgb(folder / f"{name}.exr") for name in ("gathered", "map"))
    assert cycles.mean() > 0.01
    assert ours.mean() == pytest.approx(cycles.mean(), rel=0.03)


@pytest.mark.parametrize(
    ("image", "said"),
    [
        ("black", "object 'quad', material 'metal', image 'black': it is black within the unit disk"),
        ("negative", "object 'quad', material 'metal', image 'negative': it has negative pixels"),
        ("oblong", "object 'quad', material 'metal', image 'oblong': it must be square"),
        ("unread", "object 'quad', material 'metal', image 'unread': it has no pixels"),
        ("none", "object 'quad', material 'metal': its microfacets are to be an image's, but none is chosen"),
    ],
)
def test_what_cannot_be_is_said(cases: dict[str, dict[str, list[str]]], image: str, said: str) -> None:
    assert any(said in text and "Fix: " in text for text in cases["said"][image]), cases["said"][image]


def test_mixes_keep_their_colours(cases: dict[str, list[str]], folder: Path) -> None:
    assert not cases["lobes"]
    red, green, _ = read_rgb(folder / "lobes.exr").mean((0, 1))
    assert red > 0.01
    assert green == pytest.approx(red, rel=0.1)

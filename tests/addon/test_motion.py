"""Pivot and Cycles, in one Blender, agree on what is blurred by motion; the core is told where things are, and when."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import pytest
from beside_cycles import assert_alike
from blender_host import Host
from exr import passes_by_name

PICTURES = ("objects", "curve", "camera", "deformed", "instances", "zoom", "strands")
ANALYTIC = ("objects", "deformed")
MIDDLE = {"START": 2.25, "CENTER": 2.0, "END": 1.75}  # a shutter of half a frame about frame 2


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("motion")


@pytest.fixture(scope="module")
def cases(host: Host, folder: Path) -> Any:
    return host.run("motion_cases", folder)


@pytest.mark.parametrize(
    ("integrator", "name"),
    [("MONTE_CARLO", name) for name in PICTURES] + [("direct_ANALYTIC", name) for name in ANALYTIC],
)
def test_pictures_are_cycles(cases: Any, folder: Path, integrator: str, name: str) -> None:
    assert cases["pictures"] == list(PICTURES)
    assert_alike(folder, name, integrator)


@pytest.mark.parametrize("position", list(MIDDLE))
def test_the_core_is_told_where_things_are_while_the_shutter_is_open(cases: Any, position: str) -> None:
    told, middle = cases["handed over"][position], MIDDLE[position]
    assert told["frame"] == [2, 0.0]  # what the person sees is as before
    assert told["reports"] == []
    assert set(told["x"]) == {"two steps", "four steps"}
    assert told["x"]["two steps"] == pytest.approx(np.linspace(middle - 0.25, middle + 0.25, 3))
    assert told["x"]["four steps"] == pytest.approx(np.linspace(middle - 0.25, middle + 0.25, 5))
    assert told["camera x"] == pytest.approx(np.linspace(middle - 0.25, middle + 0.25, 3))
    assert all(told["middle x"][name] == pytest.approx(middle) for name in ("two steps", "four steps", "off"))
    assert set(told["meshes"]) == {"ball"}
    times = np.linspace(middle - 0.25, middle + 0.25, 3)
    assert told["meshes"]["ball"]["height"] == pytest.approx(1 + (0.5 + (times - 2) * 0.9) * 1.3, rel=1e-5)
    assert told["meshes"]["ball"]["has normals"]
    if position == "END":
        assert told["shutter"][0] == 0
        assert 0.5 < told["shutter"][1] <= 1
        assert told["shutter"][2] == pytest.approx(1)
    else:
        assert told["shutter"] is None


def test_what_is_not_blurred_is_said_by_name(cases: Any) -> None:
    told = cases["left out"]
    assert (set(told["x"]), told["meshes"]) == ({"panel"}, {})
    assert sorted(told["reports"]) == [
        "Pivot: object 'cloud', material 'smoke': in the analytic integrator its volume scatters none of the world's "
        "light. Fix: use Monte Carlo",
        "Pivot: object 'cloud': motion blur of what has a volume is not supported, it is sharp",
        "Pivot: object 'panel': in the analytic integrator it shines on others from where it is in the middle of the "
        "shutter's time. Fix: use Monte Carlo",
        "Pivot: object 'row': its mesh has other vertices at other times of the shutter, it moves as it is in the "
        "middle",
    ]


def test_vectors_are_cycles(cases: Any, folder: Path) -> None:
    """But at edges, where a pixel has the mean of what moves otherwise."""
    ours, cycles = (passes_by_name(folder / f"vectors_{who}.exr")["Vector"] for who in ("PIVOT", "CYCLES"))
    around = np.lib.stride_tricks.sliding_window_view(cycles, (3, 3), axis=(0, 1))
    is_even = np.ptp(around, axis=(3, 4)).max(axis=2) < 1
    off = np.abs(ours - cycles).max(axis=2)[1:-1, 1:-1][is_even]
    assert np.abs(cycles).max(axis=(0, 1)).min() > 3
    assert is_even.mean() > 0.5
    assert np.median(off) < 0.01
    assert (off < 0.1).mean() > 0.97


def test_a_view_layer_without_blur_is_sharp(cases: Any) -> None:
    told = cases["sharp"]
    assert (told["x"], told["camera x"], told["shutter"]) == ({}, None, None)

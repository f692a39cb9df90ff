"""Rendered files hold what the scene says: passes under their Blender's names, view layers, frames, borders."""

from __future__ import annotations

import re
from pathlib import Path

import numpy as np
import pytest
from blender_host import Host
from exr import read_passes

RED, EMISSION = np.array((0.8, 0.1, 0.05)), np.array((2, 1, 4))
SIZE = 32
GROUND, LAMP, OUTSIDE = (16, 8), (16, 24), (1, 1)  # (row from the top, column) in frame 1


@pytest.fixture(scope="module")
def folder(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Path:
    made = tmp_path_factory.mktemp("pictures")
    done = host.start("picture_cases", made)
    assert done.returncode == 0, done.stdout + done.stderr
    (made / "stdout").write_text(done.stdout)
    return made


@pytest.fixture(scope="module")
def names(host: Host) -> dict[str, str]:
    """The passes' names in the host."""
    if host.version >= (5, 0):
        volume = {"volume_direct": "Volume Direct", "volume_indirect": "Volume Indirect"}
        return {"albedo": "Diffuse Color", "emission": "Emission"} | volume
    return {"albedo": "DiffCol", "emission": "Emit", "volume_direct": "VolumeDir", "volume_indirect": "VolumeInd"}


@pytest.fixture(scope="module")
def first(folder: Path) -> dict[str, np.ndarray]:
    return read_passes(folder / "animation_0001.exr")


def test_passes_are_those_that_are_switched_on(first: dict[str, np.ndarray], names: dict[str, str]) -> None:
    everything = {"Combined", "Depth", "Normal", "Position", "Method", "Error", "Indirect", *names.values()}
    assert set(first) == {f"first.{name}" for name in everything} | {"clay.Combined", f"clay.{names['albedo']}"}


def test_passes_hold_what_the_pixel_sees(first: dict[str, np.ndarray], names: dict[str, str]) -> None:
    depth, position = first["first.Depth"], first["first.Position"]
    normal, albedo = first["first.Normal"], first[f"first.{names['albedo']}"]
    emission, combined = first[f"first.{names['emission']}"], first["first.Combined"]
    np.testing.assert_allclose(depth[GROUND], 5, atol=1e-4)
    np.testing.assert_allclose(depth[LAMP], 4, atol=1e-4)
    np.testing.assert_allclose(depth[OUTSIDE], 1e10, rtol=1e-3)
    np.testing.assert_allclose(normal[GROUND], (0, 0, 1), atol=1e-5)
    np.testing.assert_allclose(position[GROUND][2], 0, atol=1e-5)
    pixel_m = 2.5 / SIZE
    x, y = (GROUND[1] + 0.5 - SIZE / 2) * pixel_m, (SIZE / 2 - GROUND[0] - 0.5) * pixel_m
    np.testing.assert_allclose(position[GROUND][:2], (x, y), atol=pixel_m)
    np.testing.assert_allclose(albedo[GROUND], RED, atol=1e-5)
    np.testing.assert_allclose(emission[GROUND], 0)
    np.testing.assert_allclose(emission[LAMP], EMISSION, rtol=1e-5)
    np.testing.assert_allclose(combined[LAMP], (*EMISSION, 1), rtol=1e-5)
    np.testing.assert_allclose(combined[OUTSIDE], 0)  # transparent film
    assert first["first.Method"].shape == (SIZE, SIZE, 3)
    assert first["first.Error"].shape == (SIZE, SIZE, 1)


def test_rows_are_not_mirrored(first: dict[str, np.ndarray]) -> None:
    rows = first["first.Position"][2:-2, 16, 1]
    on_ground = first["first.Depth"][2:-2, 16, 0] < 6
    assert np.all(np.diff(rows[on_ground]) < 0)


def test_view_layers_differ(first: dict[str, np.ndarray], names: dict[str, str]) -> None:
    """The second layer is made of clay, and without the lamp."""
    clay = first[f"clay.{names['albedo']}"]
    np.testing.assert_allclose(clay[GROUND], 0.5, atol=1e-5)
    np.testing.assert_allclose(clay[LAMP], 0.5, atol=1e-5)


def test_frames_differ(folder: Path, first: dict[str, np.ndarray], names: dict[str, str]) -> None:
    emission = f"first.{names['emission']}"
    second = read_passes(folder / "animation_0002.exr")
    np.testing.assert_allclose(second[emission][:, ::-1], first[emission], atol=1e-5)
    assert second[emission][GROUND][0] == pytest.approx(2)


def test_border(folder: Path) -> None:
    """A border renders the same pixels of the full picture; cropped, nothing else is in the file."""
    whole, border, crop = (read_passes(folder / f"{name}.exr") for name in ("seed0", "border", "crop"))
    window = (slice(8, 24), slice(16, 32))
    depth = whole["first.Depth"]
    assert crop["first.Depth"].shape == (16, 16, 1)
    np.testing.assert_allclose(crop["first.Depth"], depth[window], rtol=1e-4)
    assert border["first.Depth"].shape == depth.shape
    np.testing.assert_allclose(border["first.Depth"][window], depth[window], rtol=1e-4)
    assert not border["first.Combined"][:, :16].any()
    assert border["first.Combined"][window].any()


def test_a_seed_is_a_picture(folder: Path) -> None:
    first, again, one_thread, other = (
        read_passes(folder / f"{name}.exr")["first.Combined"]
        for name in ("seed0", "seed0_again", "one_thread", "seed1")
    )
    assert np.array_equal(first, again)
    assert np.array_equal(first, one_thread)
    assert not np.array_equal(first, other)


def test_analytic_integrator_and_opaque_film(folder: Path) -> None:
    combined = read_passes(folder / "analytic.exr")["first.Combined"]
    np.testing.assert_allclose(combined[LAMP], (*EMISSION, 1), rtol=1e-5)
    assert combined[GROUND][0] > 0.05
    opaque = read_passes(folder / "opaque.exr")["first.Combined"]
    np.testing.assert_allclose(opaque[OUTSIDE], (0.25, 0.25, 0.25, 1), rtol=1e-5)


def test_progress_is_printed(folder: Path) -> None:
    """A line for each of the frames, layers and views, whichever way the Blender has it printed."""
    lines = re.findall(r"Sample 4/4 \| 100 % \| 00:00 left$", (folder / "stdout").read_text(), re.MULTILINE)
    assert len(lines) >= 12


def test_stereo_views(folder: Path) -> None:
    stereo = read_passes(folder / "stereo.exr")
    depth = [stereo[name] for name in sorted(stereo) if name.startswith("first.") and ".Depth" in name]
    left, right = (pixels[16, :, 0] < 4.5 for pixels in depth)
    assert left.sum() > 3
    assert right.sum() > 3
    assert np.flatnonzero(left).mean() != np.flatnonzero(right).mean()

"""What is left in Edit Mode renders as it would in Object Mode, with its edits."""

from __future__ import annotations

import subprocess
from pathlib import Path
from typing import Any

import OpenEXR
import pytest
from blender_host import Host, environment

# Each scene and the objects it shows.
SHOWN = {
    "mesh": {"mesh"},
    "modified": {"modified"},
    "several": {"first", "second", "sharing", "bystander"},
    "instanced": {"instanced", "emitter"},
    "emitters": {"scattered", "emitter"},
    "emissive": {"emissive"},
    "armature_deformed": {"deformed"},
    "curve": {"curve"},
    "text": {"text"},
    "surface": {"surface"},
    "metaball": {"ball"},
}


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("edit")


@pytest.fixture(scope="module")
def cases(host: Host, folder: Path) -> Any:
    return host.run("edit_cases", folder)


@pytest.mark.parametrize("scene", SHOWN)
def test_edit_mode_renders_as_object_mode(cases: Any, scene: str) -> None:
    shown = cases["scenes"][scene]
    assert set(shown["EDIT"]["objects"]) == SHOWN[scene]
    assert shown["EDIT"] == shown["OBJECT"]
    assert shown["EDIT"]["reports"] == []


def test_a_detailed_mesh_loses_nothing(cases: Any) -> None:
    mesh = cases["scenes"]["mesh"]["EDIT"]["objects"]["mesh"]
    assert mesh["materials"] == ["mesh a", "mesh b"]
    assert sorted(mesh["triangle_slots"]) == [0, 0, 1, 1]
    assert mesh["uvs"]["uv:"][7] == [7 / 8, 0.5]
    assert mesh["corner_normals"][0] == pytest.approx((0, 0.6, 0.8), abs=1e-3)


def test_every_scene_was_tried(cases: Any) -> None:
    assert set(cases["scenes"]) == set(SHOWN)
    assert len(cases["scenes"]["instanced"]["EDIT"]["objects"]["instanced"]["places"]) == 11


def test_edits_that_have_not_left_edit_mode(cases: Any) -> None:
    assert sorted(cases["edits"]) == [4, 4, 6, 6]


def test_a_file_saved_in_edit_mode(host: Host, cases: Any, folder: Path) -> None:
    assert cases["read_again"] == [4]
    if not host.command[0].endswith("blender"):
        return
    command = [host.command[0], "-b", folder / "edit.blend", "--addons", "pivot", "-E", "PIVOT"]
    command += ["-o", folder / "edit_#", "-F", "OPEN_EXR", "-f", "1"]
    subprocess.run(command, env=environment(folder), capture_output=True, text=True, check=True)
    with OpenEXR.File(str(folder / "edit_1.exr"), separate_channels=True) as file:
        assert file.channels()["G"].pixels.max() > 0

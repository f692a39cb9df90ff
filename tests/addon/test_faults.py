"""A fault is an error that names the object and the fix; no picture pretends success."""

from __future__ import annotations

import json
import subprocess
from pathlib import Path
from typing import Any

import pytest
from blender_host import Host, environment

NAMES = {
    "object_transform": "object 'ground'",
    "light_transform": "light 'lamp'",
    "camera_transform": "camera 'Camera'",
    "mesh_vertex": "object 'ground'",
    "material_value": "material 'red'",
    "light_energy": "light 'lamp'",
    "camera_shift": "camera 'Camera'",
    "camera_scale": "camera 'Camera'",
    "camera_stop": "camera 'Camera'",
    "samples": "samples must be at least 1",
    "too_large": "a picture of 60000 x 60000 pixels takes 7",  # hundred and some GB
}


def run(host: Host, script: str, folder: Path) -> Any:
    """What a script returns whose faults may count for Blender's exit status, though it catches them."""
    done = host.start(script, folder)
    result = folder / "result.json"
    assert result.exists(), done.stdout + done.stderr
    return json.loads(result.read_text())


@pytest.fixture(scope="module")
def cases(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Any:
    return run(host, "fault_cases", tmp_path_factory.mktemp("faults"))


@pytest.mark.parametrize("fault", NAMES)
def test_fault_names_its_cause_and_fix(cases: Any, fault: str) -> None:
    result = cases["faults"][fault]
    assert result["error"], "the render claims success"
    assert NAMES[fault] in result["error"]
    assert "Fix: " in result["error"]
    assert "internal" not in result["error"]
    assert not result["picture"]


def test_every_fault_was_tried(cases: Any) -> None:
    assert set(cases["faults"]) == set(NAMES)


def test_missing_core_names_its_fix(cases: Any) -> None:
    assert "the render core does not load" in cases["missing_core"]["error"]
    assert "./run" in cases["missing_core"]["error"]
    assert not cases["missing_core"]["picture"]


def test_out_of_memory_is_said(cases: Any) -> None:
    assert "out of memory. Fix: " in cases["memory"]["error"]
    assert not cases["memory"]["picture"]


def test_the_memory_a_picture_takes_is_known_before(host: Host, tmp_path: Path) -> None:
    result = host.run("memory_case", tmp_path)
    assert 0.75 < result["taken"] / result["estimate"] < 1.1
    assert 1e8 < result["available"] < 1e14
    assert result["limited"] == 55e6


def test_strict_takes_warnings_for_errors(cases: Any) -> None:
    assert "1 warning, which a strict render takes for errors: scene 'Scene'" in cases["strict"]["error"]
    assert not cases["strict"]["picture"]
    assert cases["strict_without_warnings"] == {"error": None, "picture": True}


def test_ctrl_c_ends_a_render_at_once(host: Host, tmp_path: Path) -> None:
    result = run(host, "cancel_case", tmp_path)
    assert result["latency_s"] < 0.2
    assert not result["picture"]


def test_headless_exit_status(host: Host, tmp_path: Path) -> None:
    done = host.start("uncaught_fault", tmp_path)
    assert done.returncode == 1  # a crash at exit is another
    assert "object 'ground'" in done.stdout + done.stderr
    assert not (tmp_path / "picture.png").exists()
    if host.command[0].endswith("blender"):  # the same from Blender's own command line
        command = [host.command[0], "-b", tmp_path / "fault.blend", "--addons", "pivot", "-E", "PIVOT", "-f", "1"]
        done = subprocess.run(command, env=environment(tmp_path), capture_output=True, text=True, check=False)
        assert done.returncode == 1
        assert not (tmp_path / "picture.png").exists()

"""The Rendered viewport follows edits and the view, and the panels draw, in a Blender with a window."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from blender_host import INSIDE, environment

COMMANDS = [shutil.which(name) for name in ("xvfb-run", "blender")]
pytestmark = pytest.mark.skipif(None in COMMANDS, reason="needs xvfb-run and a Blender with a window")


def in_a_window(script: str, folder: Path) -> Any:
    """What inside/<script>.py, which quits its Blender, wrote to folder/result.json; its output is in folder/output."""
    screen = ["-a", "-s", f"-screen 0 1280x800x24 -fbdir {folder}"]
    blender = ["--factory-startup", "--window-geometry", "0", "0", "640", "400", "--python"]
    command = [COMMANDS[0], *screen, COMMANDS[1], *blender, str(INSIDE / f"{script}.py"), "--", str(folder)]
    done = subprocess.run(command, env=environment(folder), capture_output=True, text=True, timeout=150, check=False)
    output = done.stdout + done.stderr
    (folder / "output").write_text(output)
    assert done.returncode == 0, output
    assert "Traceback" not in output, output
    return json.loads((folder / "result.json").read_text())


def test_viewport_shows_the_scene_and_panels_draw(tmp_path: Path) -> None:
    red, green, blue, red_again, analytic, lit = in_a_window("viewport_case", tmp_path)
    np.testing.assert_array_equal(
        np.round([red, green, blue, red_again, analytic, lit]), [*np.eye(3), *[(1, 0, 0)] * 2, (0, 1, 0)]
    )


@pytest.fixture(scope="module")
def motion(tmp_path_factory: pytest.TempPathFactory) -> Any:
    folder = tmp_path_factory.mktemp("motion")
    return in_a_window("viewport_motion_case", folder) | {"output": (folder / "output").read_text()}


@pytest.mark.parametrize("what", ["orbit", "drag"])
def test_pictures_of_now_are_shown_while_things_move(motion: Any, what: str) -> None:
    seen = motion[what]
    assert seen["draws"] >= 10
    assert len(seen["pictures"]) >= seen["draws"] / 3
    assert set(seen["pictures"]) <= {0, 1, 2}  # draws ago


def test_what_changes_no_picture_restarts_nothing(motion: Any) -> None:
    assert motion["idle"]["sessions"] == 0
    assert motion["hidden"]["sessions"] > 0


def test_settings_start_samples_again_and_export_nothing(motion: Any) -> None:
    assert motion["settings"]["sessions"] >= 2
    assert motion["settings"]["exports"] == 0
    assert motion["hidden"]["exports"] == 1


def test_what_is_left_out_is_said_in_the_view_and_once_on_the_console(motion: Any) -> None:
    assert motion["text"] == [
        "1 thing is not shown as set: object 'catcher': Shadow Catcher is not supported, it is shown as it is"
    ]
    assert motion["output"].count("Warning: Pivot: object 'catcher'") == 1


def test_images_are_read_once_and_in_their_color_space(tmp_path: Path) -> None:
    seen = in_a_window("viewport_image_case", tmp_path)
    still, first_frame, second_frame = seen["expected"]
    assert sorted(seen["opened"]) == sorted([still, first_frame])
    assert seen["moved"] == []
    assert seen["alpha mode"] == [still]
    assert seen["frame"] == [second_frame]

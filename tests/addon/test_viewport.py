"""The Rendered viewport follows edits and the view, and the panels draw, in a Blender with a window."""

from __future__ import annotations

import json
import shutil
import subprocess
from pathlib import Path

import numpy as np
import pytest
from blender_host import INSIDE, environment

COMMANDS = [shutil.which(name) for name in ("xvfb-run", "blender")]


@pytest.mark.skipif(None in COMMANDS, reason="needs xvfb-run and a Blender with a window")
def test_viewport_shows_the_scene_and_panels_draw(tmp_path: Path) -> None:
    screen = ["-a", "-s", "-screen 0 1280x800x24"]
    blender = ["--factory-startup", "--window-geometry", "0", "0", "640", "400", "--python"]
    script = [str(INSIDE / "viewport_case.py"), "--", str(tmp_path)]
    command = [COMMANDS[0], *screen, COMMANDS[1], *blender, *script]
    done = subprocess.run(command, env=environment(tmp_path), capture_output=True, text=True, timeout=150, check=False)
    assert done.returncode == 0, done.stdout + done.stderr
    _, red, green, blue, red_again, analytic, _, lit, *_ = json.loads((tmp_path / "result.json").read_text())
    np.testing.assert_array_equal(
        np.round([red, green, blue, red_again, analytic, lit]), [*np.eye(3), *[(1, 0, 0)] * 2, (0, 1, 0)]
    )
    assert "Traceback" not in done.stdout + done.stderr

"""The Rendered viewport follows edits and the view, and the panels draw, in a Blender with a window."""

from __future__ import annotations

import importlib.util
import json
import os
import shutil
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from blender_host import INSIDE, environment
from numpy.typing import NDArray

Floats = NDArray[np.float32]
COMMANDS = [shutil.which(name) for name in ("Xvfb", "blender")]
pytestmark = pytest.mark.skipif(None in COMMANDS, reason="needs Xvfb and a Blender with a window")


@contextmanager
def screen(folder: Path) -> Iterator[str]:
    """A display of its own, which is there once the server has told its name: others may start theirs meanwhile."""
    told, tells = os.pipe()
    options = ["-screen", "0", "1280x800x24", "-fbdir", str(folder), "-nolisten", "tcp", "-displayfd", str(tells)]
    server = subprocess.Popen([str(COMMANDS[0]), *options], pass_fds=[tells], stderr=subprocess.DEVNULL)
    os.close(tells)
    try:
        with os.fdopen(told) as line:
            yield f":{line.readline().strip()}"
    finally:
        server.terminate()
        server.wait()


def in_a_window(script: str, folder: Path, *arguments: str) -> Any:
    """What inside/<script>.py, which quits its Blender, wrote to folder/result.json; its output is in folder/output."""
    blender = [str(COMMANDS[1]), "--factory-startup", "--window-geometry", "0", "0", "640", "400", "--python"]
    command = [*blender, str(INSIDE / f"{script}.py"), "--", str(folder), *arguments]
    with screen(folder) as display:
        settings = environment(folder) | {"DISPLAY": display}
        done = subprocess.run(command, env=settings, capture_output=True, text=True, timeout=150, check=False)
    output = done.stdout + done.stderr
    (folder / "output").write_text(output)
    assert done.returncode == 0, output
    assert "Traceback" not in output, output
    return json.loads((folder / "result.json").read_text())


def test_viewport_shows_the_scene_and_panels_and_previews_are_drawn(tmp_path: Path) -> None:
    result = in_a_window("viewport_case", tmp_path)
    red, green, blue, red_again, analytic, lit = result["seen"]
    np.testing.assert_array_equal(
        np.round([red, green, blue, red_again, analytic, lit]), [*np.eye(3), *[(1, 0, 0)] * 2, (0, 1, 0)]
    )
    previews = {name: np.array(mean) for name, mean in result["previews"].items()}
    assert previews["red"][0] > 1.2 * previews["red"][1]
    assert previews["world"][2] > 0.5 > 2 * previews["world"][0]
    assert result["said"] == []  # of the previews' own scene, lest the artist's of the same name is passed over


@pytest.fixture(scope="module")
def views(tmp_path_factory: pytest.TempPathFactory) -> Any:
    return in_a_window("viewport_view_case", tmp_path_factory.mktemp("views"))


def test_views_show_what_is_theirs_where_it_belongs(views: Any) -> None:
    seen = {name: (view["found"], view["expected"]) for name, view in views.items() if "found" in view}
    assert len(seen) == 18
    for name, (found, expected) in seen.items():
        assert found == expected, name


def test_only_the_pixels_of_a_render_region_are_rendered(views: Any) -> None:
    width, height = views["region"]
    assert views["perspective"]["size"] == [width, height]
    np.testing.assert_allclose(views["border"]["size"], [width / 2, height / 2], atol=1)
    np.testing.assert_allclose(views["large pixels"]["size"], [width / 2, height / 2], atol=1)
    assert views["camera border"]["size"][0] < width / 2


def test_no_picture_is_stretched_when_the_region_is_resized(views: Any) -> None:
    assert len(views["stretched"]) >= 2
    np.testing.assert_allclose(views["stretched"], 1, atol=0.01)


def denoiser() -> str:
    """The library of this Python's bpy: Debian's Blender has none."""
    package = importlib.util.find_spec("bpy")
    folders = (package and package.submodule_search_locations) or []
    found = [path for folder in folders for path in Path(folder).glob("lib/libOpenImageDenoise.so*")]
    return str(found[0]) if found else ""


@pytest.fixture(scope="module")
def passes(tmp_path_factory: pytest.TempPathFactory) -> tuple[Any, dict[str, Floats]]:
    folder = tmp_path_factory.mktemp("passes")
    result = in_a_window("viewport_pass_case", folder, denoiser())
    return result, {path.stem: np.load(path)[..., :3] for path in folder.glob("*.npy")}


def test_the_viewport_shows_passes(passes: tuple[Any, dict[str, Floats]]) -> None:
    """At the floor in the middle, and at the lamp to the right, which is half as far."""

    def seen(name: str) -> list[list[float]]:
        picture = passes[1][name]
        height, width = picture.shape[:2]
        return np.round(picture[height // 2, [width // 2, int(0.85 * width)]].astype(float), 1).tolist()

    assert seen("depth") == [[0.5] * 3, [1.0] * 3]
    assert seen("normal") == [[0.5, 0.5, 1.0]] * 2
    assert seen("diffuse_color") == [[0.8] * 3, [0.0] * 3]
    assert seen("emission") == [[0.0] * 3, [5.0, 0.0, 0.0]]
    assert seen("method")[0] == seen("error")[0] == [0.0] * 3
    assert seen("analytic method")[0] != [0.0] * 3
    assert 0 < passes[1]["analytic error"].mean() < passes[1]["analytic combined"].mean()
    assert 0 < passes[1]["indirect"].mean() < 0.1 * passes[1]["combined"].mean()


def test_a_pause_renders_nothing_and_viewport_samples_are_its_own(passes: tuple[Any, dict[str, Floats]]) -> None:
    result, pictures = passes
    assert not result["paused"]["renders"]
    assert result["combined"] == result["resumed"] == {"samples": 2, "rests": True}
    np.testing.assert_array_equal(pictures["resumed"], pictures["combined"])


def test_the_viewport_is_denoised_at_rest(passes: tuple[Any, dict[str, Floats]]) -> None:
    result, pictures = passes
    if not result["has denoiser"]:
        pytest.skip("no Open Image Denoise here")
    error = {
        name: float(np.mean((picture.clip(0, 1) - pictures["converged"].clip(0, 1)) ** 2))
        for name, picture in pictures.items()
    }
    assert error["denoise all"] < 0.3 * error["combined"]
    assert error["denoise indirect"] < error["combined"]
    assert np.any(pictures["denoise all"] != pictures["denoise indirect"])
    np.testing.assert_array_equal(pictures["denoise none"], pictures["combined"])


def test_shadow_catchers_show_what_others_do_to_the_world_behind_them(passes: tuple[Any, dict[str, Floats]]) -> None:
    picture = passes[1]["catcher"]
    height, width = picture.shape[:2]
    world = (0.5, 0.25, 0.125)
    assert picture[height // 10, width // 2] == pytest.approx(world, rel=0.1)  # little is hidden there
    darker = (picture < 0.8 * np.array(world)).all(-1)
    assert 0.01 < darker.mean() < 0.5


@pytest.fixture(scope="module")
def edits(tmp_path_factory: pytest.TempPathFactory) -> Any:
    return in_a_window("viewport_edit_case", tmp_path_factory.mktemp("edits"))


def test_after_any_edit_the_scene_is_as_one_exported_anew(edits: Any) -> None:
    assert edits["edits"] >= 100
    assert edits["wrong"] == []
    assert [wrong for _, wrong in edits["undone"]] == [[]] * 8
    assert [extent for extent, _ in edits["undone"][:4]] == [1.5, 1, 1.5, 1]


def test_an_edit_exports_only_the_meshes_that_it_changes(edits: Any) -> None:
    assert [edits["meshes"][kind] for kind in ("color", "power", "move_lamp")] == [0, 0, 0]
    assert edits["meshes"]["vertices"] >= 1
    assert edits["triangles"] >= 990_000
    for moved in ("object", "lamp"):
        assert edits[moved] == {"meshes": 0, "exports": 1, "wrong": []}


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
        "1 thing is not shown as set: light 'oval': an uneven Scale is not supported, the cone is round and as wide as "
        "its Spot Size"
    ]
    assert motion["output"].count("Warning: Pivot: light 'oval'") == 1


def test_images_are_read_once_and_in_their_color_space(tmp_path: Path) -> None:
    seen = in_a_window("viewport_image_case", tmp_path)
    still, first_frame, second_frame = seen["expected"]
    assert sorted(seen["opened"]) == sorted([still, first_frame])
    assert seen["moved"] == []
    assert seen["alpha mode"] == [still]
    assert seen["frame"] == [second_frame]


def test_what_befalls_views_leaves_their_scenes_right(tmp_path: Path) -> None:
    """Modes, playback, 50 undos, 50 switches of the engine, quad view, two views, a file that is loaded."""
    seen = in_a_window("viewport_life_case", tmp_path)
    assert seen["wrong"] == []
    assert seen["undone"] == -1.0
    assert seen["views"]["switches"] == seen["views"]["playback"] == 1
    assert seen["views"]["edit in quad view"] == 4
    assert seen["views"]["edit in two views"] == 2

"""./run as a person uses it: from any folder, with any file name, and with an error that names its fix."""

import csv
import os
import re
import shutil
import subprocess
import sys
from pathlib import Path

import numpy as np
import OpenEXR
import pivot_core
import pytest

ROOT = Path(__file__).resolve().parent.parent
sys.path.insert(0, str(ROOT / ".run"))
import whole_picture  # noqa: E402

RUN = ROOT / "run"
SCENE = ROOT / "tests/scenes/default/default.blend"
QUICK = (
    "import bpy; s = bpy.context.scene; s.render.resolution_percentage = 10; s.pivot.samples = 1;"
    "s.frame_start, s.frame_end = 7, 8"
)


def run(
    *arguments: str | Path, cwd: Path = ROOT, command: Path = RUN, **variables: str
) -> subprocess.CompletedProcess[str]:
    return subprocess.run(
        [command, *arguments],
        cwd=cwd,
        env={**os.environ, **variables},
        stdin=subprocess.DEVNULL,
        capture_output=True,
        text=True,
        timeout=300,
    )


def names(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


@pytest.fixture
def scene(tmp_path: Path) -> Path:
    """The default scene under a name with spaces and dots, in a folder with spaces."""
    folder = tmp_path / "my scenes"
    folder.mkdir()
    return Path(shutil.copy(SCENE, folder / "still life 1.2.blend"))


def png_size(path: Path) -> tuple[int, int]:
    header = path.read_bytes()[:24]
    assert header.startswith(b"\x89PNG\r\n\x1a\n")
    return int.from_bytes(header[16:20], "big"), int.from_bytes(header[20:24], "big")


def test_bare_prints_help() -> None:
    ran = run()
    assert ran.returncode == 0
    for command in ("render", "test", "blender", "python", "chart", "stability"):
        assert f"./run {command} " in ran.stdout


@pytest.mark.parametrize(
    ("arguments", "error"),
    [
        (("rendre",), "no such command: rendre"),
        (("render", "nowhere.blend"), "no such file: nowhere.blend"),
        (("render", SCENE, "-f", "1"), "options come after --"),
        (("render", "--", "-f"), "-f needs a frame"),
        (("chart", "nowhere.blend"), "no such file: nowhere.blend"),
        (("chart", "a.blend", "b.blend"), "chart takes one file"),
        (("chart", "README.md"), "this is no .blend file: README.md. Save one in Blender"),
        (("render", "README.md"), "this is no .blend file: README.md. Save one in Blender"),
        (("render", "/dev/null"), "no such file: /dev/null"),
        (("render", "--strict", "tests"), "this is a folder: tests. Name the .blend in it"),
    ],
)
def test_a_mistake_gets_one_line(arguments: tuple[str, ...], error: str) -> None:
    ran = run(*arguments)
    assert ran.returncode != 0
    assert error in ran.stderr.splitlines()[-1]


def test_render_from_another_folder_through_a_symlink(tmp_path: Path, scene: Path) -> None:
    (tmp_path / "work").mkdir()
    (tmp_path / "home").mkdir()
    (tmp_path / "pivot").symlink_to(RUN)
    before = scene.read_bytes()
    ran = run(
        "render", "../my scenes/still life 1.2.blend", "--", "--python-expr", QUICK,
        cwd=tmp_path / "work", command=tmp_path / "pivot", HOME=str(tmp_path / "home"),
    )  # fmt: skip
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert names(tmp_path / "work") == ["still life 1.2.exr", "still life 1.2.png"]
    assert f"Wrote {tmp_path / 'work' / 'still life 1.2.png'}" in ran.stdout
    assert names(tmp_path / "home") == []
    assert scene.read_bytes() == before
    assert png_size(tmp_path / "work/still life 1.2.png") == (96, 54)
    channels = " ".join(OpenEXR.File(str(tmp_path / "work/still life 1.2.exr"), separate_channels=True).channels())
    for name in ("Combined.R", "Depth.Z", "Normal.X", "Position.X", "DiffCol.R", "Emit.R"):
        assert name in channels


def test_frames_are_numbered(tmp_path: Path, scene: Path) -> None:
    ran = run("render", scene, "--", "--python-expr", QUICK, "-a", cwd=tmp_path)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    made = [f"still life 1.2{frame:04}{suffix}" for frame in (7, 8) for suffix in (".exr", ".png")]
    assert names(tmp_path) == ["my scenes", *made]
    assert "frame 7" in ran.stderr
    assert "frame 8 100%" in ran.stderr


NO_CAMERA = "import bpy; [bpy.data.objects.remove(o) for o in list(bpy.data.objects) if o.type == 'CAMERA']"
TOO_SMALL = "import bpy; r = bpy.context.scene.render; r.use_border = True; r.border_max_x = 1e-4"


@pytest.mark.parametrize(
    ("fault", "error"),
    [
        (NO_CAMERA, "Error: Cannot render, no camera. Fix: add one to the scene"),
        (
            TOO_SMALL,
            "Error: Image too small. Fix: raise the resolution or its percentage, or draw a larger render region",
        ),
    ],
)
def test_a_failed_render_says_why_and_writes_nothing(tmp_path: Path, scene: Path, fault: str, error: str) -> None:
    ran = run("render", scene, "--", "--python-expr", fault, cwd=tmp_path)
    assert ran.returncode != 0
    *_, said, last = ran.stderr.splitlines()
    assert said.startswith(error)
    assert last.startswith("run: rendering failed")
    assert ran.stderr.count("Error") == 1
    assert names(tmp_path) == ["my scenes"]


def test_a_file_cut_off_is_said_in_a_line(tmp_path: Path) -> None:
    (tmp_path / "cut.blend").write_bytes(SCENE.read_bytes()[:200_000])
    rendered = run("render", "cut.blend", cwd=tmp_path)
    assert rendered.returncode != 0
    assert "cut.blend is cut off or damaged: copy it again" in rendered.stderr.splitlines()[-1]
    charted = run("chart", "cut.blend", cwd=tmp_path)
    assert charted.returncode != 0
    assert "Fix: the file is cut off: copy it again" in charted.stderr.splitlines()[-2]
    assert "Traceback" not in charted.stderr
    assert names(tmp_path) == ["cut.blend"]


def test_chart_without_a_camera_says_so_in_a_line(tmp_path: Path) -> None:
    bare = f"{NO_CAMERA}; bpy.ops.wm.save_as_mainfile(filepath='{tmp_path}/bare.blend')"
    assert run("blender", "-b", "--python-exit-code", "1", "--python-expr", bare).returncode == 0
    ran = run("chart", "bare.blend", cwd=tmp_path)
    assert ran.returncode != 0
    assert ran.stderr.splitlines()[-2] == (
        "Error: Cannot render, no camera. Fix: add one to the scene (Add > Camera) and save the file"
    )
    assert "Traceback" not in ran.stderr


CLAMPED = f"{QUICK}; s.cycles.sample_clamp_direct = 1"


def test_a_frame_ends_with_what_it_took_and_warnings_come_once_a_run(tmp_path: Path, scene: Path) -> None:
    ran = run("render", scene, "--", "--python-expr", CLAMPED, "-a", cwd=tmp_path)
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert ran.stderr.count("scene 'Scene': Clamp Direct is not supported") == 1
    took = r" \| Monte Carlo \| 1 sample \| [\d.]+ s \| [\d.]+ s CPU \| (\d+) MB peak \| 1 warning$"
    peaks_mb = [re.search(rf"^Pivot \| Frame {frame}{took}", ran.stderr, re.MULTILINE) for frame in (7, 8)]
    assert all(peak and 50 < int(peak[1]) < 5000 for peak in peaks_mb), ran.stderr


def test_strict_takes_warnings_for_errors(tmp_path: Path, scene: Path) -> None:
    ran = run("render", "--strict", scene, "--", "--python-expr", CLAMPED, cwd=tmp_path)
    assert ran.returncode != 0
    assert "Warning: Pivot: scene 'Scene': Clamp Direct is not supported" in ran.stderr
    assert "Error: Pivot: 1 warning, which a strict render takes for errors: scene 'Scene'" in ran.stderr
    assert names(tmp_path) == ["my scenes"]
    clean = run("render", "--strict", scene, "--", "--python-expr", QUICK, cwd=tmp_path)
    assert clean.returncode == 0, clean.stderr
    assert names(tmp_path) == ["my scenes", "still life 1.2.exr", "still life 1.2.png"]


def test_a_full_disk_leaves_no_half_of_a_picture(tmp_path: Path, scene: Path) -> None:
    disk = tmp_path / "disk"
    disk.mkdir()
    mounted = subprocess.run(
        ["mount", "-t", "tmpfs", "-o", "size=40k", "tmpfs", disk], capture_output=True, check=False
    )
    if mounted.returncode:
        pytest.skip("only root mounts a small disk")
    try:
        ran = run("render", scene, "--", "--python-expr", QUICK, cwd=disk)
        left = names(disk)
    finally:
        subprocess.run(["umount", disk], check=True)
    assert ran.returncode != 0
    assert left == []
    assert f"exr could not be written: 0.0 MB are free on the disk at {disk}. Fix: " in ran.stderr.splitlines()[-2]


@pytest.mark.parametrize("suffix", [".exr", ".png"])
def test_a_picture_cut_anywhere_is_not_whole(suffix: str, tmp_path: Path) -> None:
    whole = tmp_path / f"picture{suffix}"
    rng = np.random.default_rng(1)
    if suffix == ".exr":
        pixels = {"RGB": rng.random((40, 30, 3), dtype=np.float32)}
        OpenEXR.File({"compression": OpenEXR.ZIP_COMPRESSION, "type": OpenEXR.scanlineimage}, pixels).write(str(whole))
    else:
        shutil.copy(ROOT / "tests/scenes/default/default.png", whole)
    data = whole.read_bytes()
    assert whole_picture.is_whole(whole)
    for size in (0, 4, 100, len(data) // 2, len(data) - 1):
        whole.write_bytes(data[:size])
        assert not whole_picture.is_whole(whole)


def test_chart_writes_table_chart_and_sheet_and_keeps_what_it_rendered(scene: Path) -> None:
    output = ROOT / "build/chart"
    made = [output / f"{scene.stem}{kind}" for kind in (".png", ".csv", "-sheet.png")]
    for path in made:
        path.unlink(missing_ok=True)
    ran = run("chart", scene, PIVOT_CHART_LADDER="SMALL")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert [f"Wrote {path}" for path in made] == [line for line in ran.stdout.splitlines() if line.startswith("Wrote")]
    assert "skipped: Mitsuba" in ran.stderr
    for path in (made[0], made[2]):
        assert min(png_size(path)) > 200
    first = made[1].read_text()
    rows = list(csv.DictReader(first.splitlines()))
    assert {row["renderer"] for row in rows} == {"PIVOT", "CYCLES"}
    assert len(rows) == 17
    assert all(0 < float(row["FLIP"]) < 1 for row in rows)
    again = run("chart", scene, PIVOT_CHART_LADDER="SMALL")
    assert again.returncode == 0, again.stderr
    assert "Charting" not in again.stderr.replace("Charting /", "")  # no picture is rendered twice: no bar
    assert made[1].read_text() == first


def test_stability_writes_the_table_and_its_picture() -> None:
    table, picture = (ROOT / "build" / f"stability{kind}" for kind in (".csv", ".png"))
    for path in (table, picture):
        path.unlink(missing_ok=True)
    ran = run("stability")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert table.read_text().splitlines()[0].split(",")[-3:] == ["Pivot: error", "bound", "method"]
    found = re.search(r"(\d+) rows, (\d+) within their bound", ran.stdout)
    assert found
    assert found[1] == found[2]
    assert min(png_size(picture)) > 800


def test_blender_renders_with_pivot(tmp_path: Path, scene: Path) -> None:
    expr = ("--python-expr", QUICK)
    ran = run("blender", "-b", scene, *expr, "-E", "PIVOT", "-o", tmp_path / "out_#", "-f", "1")
    assert ran.returncode == 0, ran.stdout + ran.stderr
    assert png_size(tmp_path / "out_1.png") == (96, 54)
    assert "Pivot | Frame 1 | Monte Carlo | 1 sample | " in ran.stdout
    assert "Sample " in ran.stdout  # Cycles says "Sample n/m" of a scene, Pivot does not
    assert "ViewLayer" not in ran.stdout


def test_blender_says_when_another_engine_renders(tmp_path: Path, scene: Path) -> None:
    """Blender takes -E for nothing after -f, and says nothing."""
    expr = ("--python-expr", f"{QUICK}; s.render.engine = 'BLENDER_WORKBENCH'; s.frame_end = 7")
    ran = run("blender", "-b", scene, *expr, "-o", tmp_path / "out_#", "-a", "-E", "PIVOT")
    assert "is rendered by BLENDER_WORKBENCH, not by Pivot. Fix: put -E PIVOT after the .blend" in ran.stdout


def test_python_imports_core_addon_and_blender() -> None:
    code = "import sys, bpy, addon_utils, pivot_core; addon_utils.enable('pivot'); print(sys.modules['pivot'].__file__)"
    ran = run("python", "-c", code)
    assert ran.returncode == 0, ran.stderr
    *_, printed = ran.stdout.splitlines()  # after what Blender says of the system
    assert Path(printed).resolve() == ROOT / "addon/__init__.py"


def stub(folder: Path, name: str, script: str) -> None:
    path = folder / name
    path.write_text(f"#!/bin/bash\n{script}\n")
    path.chmod(0o755)


# An apt-get that is asked for sizes alone.
SIZES = """if [[ $1 == --assume-no ]]; then
  echo 'Need to get 277 MB of archives.'
  echo 'After this operation, 1077 MB of additional disk space will be used.'
  exit 1
fi
"""


def test_missing_packages_are_installed_with_fresh_lists(tmp_path: Path) -> None:
    """A first install without package lists fails; it is tried again after an update."""
    calls = tmp_path / "calls"
    stub(tmp_path, "dpkg-query", "echo 'installed cmake'")
    stub(tmp_path, "apt-get", f'{SIZES}echo "$@" >> {calls}; [[ $* == *update* ]] || [[ $(wc -l < {calls}) -gt 1 ]]')
    stub(tmp_path, "sudo", '"$@"')
    ran = run("blender", "--version", PATH=f"{tmp_path}:{os.environ['PATH']}")
    assert ran.returncode == 0, ran.stderr
    installs = [line.split() for line in calls.read_text().splitlines()]
    assert ["install" in installs[0], "update" in installs[1], "install" in installs[2]] == [True, True, True]
    assert "libembree-dev" in installs[0]
    assert "cmake" not in installs[0]
    assert "Their size: 277 MB to download, 1077 MB on disk" in ran.stderr


def test_a_failed_install_names_the_fix(tmp_path: Path) -> None:
    stub(tmp_path, "dpkg-query", "true")
    stub(tmp_path, "apt-get", SIZES + "echo 'E: Unable to locate package'; exit 100")
    stub(tmp_path, "sudo", '"$@"')
    ran = run("blender", "--version", PATH=f"{tmp_path}:{os.environ['PATH']}")
    assert ran.returncode != 0
    assert "E: Unable to locate package" in ran.stderr
    assert "apt-get install cmake" in ran.stderr.splitlines()[-1]


@pytest.mark.parametrize(
    ("variables", "fix"),
    [
        ({"PIP_NO_INDEX": "1"}, "change bindings/requirements.txt to what Python 3"),
        ({"PIP_INDEX_URL": "http://127.0.0.1:9/", "PIP_RETRIES": "1"}, "check the network"),
    ],
    ids=["no such package", "no network"],
)
def test_a_failed_pip_names_the_fix(tmp_path: Path, variables: dict[str, str], fix: str) -> None:
    """What PyPI does not have for this Python is no fault of the network."""
    shutil.copy(RUN, tmp_path)
    shutil.copytree(ROOT / "bindings", tmp_path / "bindings")
    stub(tmp_path, "dpkg-query", 'for package; do echo "installed $package"; done')
    path = f"{tmp_path}:{os.environ['PATH']}"
    ran = run("blender", command=tmp_path / "run", PATH=path, PIP_FIND_LINKS="", **variables)
    assert ran.returncode != 0
    assert fix in ran.stderr.splitlines()[-1]


def test_a_render_builds_for_this_cpu_alone_and_tests_keep_warnings_out() -> None:
    """`ninja -n` of what `./run render` builds names one level; this configured build has -Werror."""
    command = ["ninja", "-C", ROOT / "build", "-t", "query", f"render_{pivot_core.arch}"]
    asked = subprocess.run(command, capture_output=True, text=True, check=True).stdout
    assert f"_core_{pivot_core.arch}" in asked
    assert set(re.findall(r"_(?:core|formulas)_v\d", asked)) == {f"_core_{pivot_core.arch}"}
    assert "-Werror" in (ROOT / "build/compile_commands.json").read_text()

"""The zips, installed as an artist does in each Blender here, one without another Pivot: they render and go cleanly."""

import ast
import json
import os
import re
import shutil
import subprocess
import tomllib
import zipfile
from pathlib import Path
from typing import Any

import pytest

from tests.addon.blender_host import Host, hosts

ROOT = Path(__file__).resolve().parent.parent
SCENE = ROOT / "tests/scenes/default/default.blend"


@pytest.fixture(scope="module")
def zips() -> list[Path]:
    packed = subprocess.run([ROOT / "run", "package"], capture_output=True, text=True)
    assert packed.returncode == 0, packed.stderr
    return [Path(path) for path in re.findall(r"^Wrote (\S+): for .*Blender \d", packed.stdout, re.MULTILINE)]


def extension(zips: list[Path]) -> Path:
    return next(path for path in zips if not path.stem.endswith("blender3.4"))


def newer(zip_path: Path, version: str, folder: Path) -> Path:
    """The zip as the next version's would be, but for its core, which is the old one."""
    changed = folder / "newer" / zip_path.name
    shutil.unpack_archive(zip_path, folder / "newer/content")
    for name in ("blender_manifest.toml", "__init__.py", "core.py"):
        for path in (folder / "newer/content").glob(f"**/{name}"):
            if "pivot_core" not in path.parts:
                text = path.read_text().replace(f'"{version}"', '"9.8.7"').replace("(0, 1, 0)", "(9, 8, 7)")
                path.write_text(text)
    shutil.make_archive(str(changed.with_suffix("")), "zip", folder / "newer/content")
    return changed


@pytest.fixture(scope="module", params=hosts(), ids=str)
def installed(request: pytest.FixtureRequest, zips: list[Path], tmp_path_factory: pytest.TempPathFactory) -> Any:
    """What installed.py saw in one Blender, and the folder it worked in."""
    host: Host = request.param
    folder = tmp_path_factory.mktemp("installed")
    is_extension = host.version >= (4, 2)
    zip_path = extension(zips) if is_extension else next(path for path in zips if path.stem.endswith("blender3.4"))
    user = {f"BLENDER_USER_{name}": str(folder / "user" / name.lower()) for name in ("CONFIG", "SCRIPTS", "DATAFILES")}
    if is_extension:
        user = {"BLENDER_USER_RESOURCES": str(folder / "user")}
    kept = {name: value for name, value in os.environ.items() if not name.startswith(("BLENDER_USER", "PIVOT"))}
    command = [*host.command, ROOT / "tests/installed.py", "--"]
    upgrade = newer(zip_path, versions()["addon/core.py"], folder)
    done = subprocess.run(
        [*command, zip_path, upgrade, SCENE, folder], env=kept | user, capture_output=True, text=True, timeout=300
    )
    # An executable exits with 1 after any render that failed, as the upgrade's does.
    assert done.returncode in (0, 1), done.stdout + done.stderr
    assert (folder / "result.json").exists(), done.stdout + done.stderr
    return json.loads((folder / "result.json").read_text()) | {"folder": folder, "is_extension": is_extension}


def test_it_is_valid(installed: Any) -> None:
    assert installed["invalid"] == ""


def test_it_renders_with_the_core_it_brings(installed: Any) -> None:
    assert installed["error"] == ""
    assert Path(installed["core"]).is_relative_to(installed["folder"] / "user")
    assert installed["mean"] == pytest.approx(0.28, abs=0.05)  # of the full picture 0.29, of an empty scene 0.12


def test_an_upgrade_asks_for_a_restart_or_renders(installed: Any) -> None:
    """An extension's new code meets the core in memory; an addon's own code is kept in memory, too."""
    if installed["is_extension"]:
        assert re.search(r"is version \S+, the addon 9.8.7. Fix: restart Blender", installed["error_after_upgrade"])
        assert not (installed["folder"] / "upgraded.png").exists()
    else:
        assert installed["error_after_upgrade"] == ""
        assert (installed["folder"] / "upgraded.png").stat().st_size > 0


def test_removing_leaves_nothing(installed: Any) -> None:
    assert not installed["engine_left"]
    assert installed["after"] == installed["before"]


def test_whose_code_is_inside_is_said(zips: list[Path]) -> None:
    for path in zips:
        with zipfile.ZipFile(path) as archive:
            texts = {Path(name).stem: archive.read(name).decode() for name in archive.namelist() if "LICENSE" in name}
            names = [name for name in archive.namelist() if "licenses/" in name]
            licences = {Path(name).stem: archive.read(name) for name in names if not name.endswith("/")}
        assert "GNU GENERAL PUBLIC LICENSE" in texts["LICENSE"]
        assert {name for name, text in licences.items() if text} == {"Embree", "oneTBB", "GLM", "xsimd", "pybind11"}
        assert b"Apache" in licences["Embree"]


def test_manifest_names_the_wheels_and_who_they_are_for(zips: list[Path]) -> None:
    with zipfile.ZipFile(extension(zips)) as archive:
        manifest = tomllib.loads(archive.read("blender_manifest.toml").decode())
        wheels = sorted(name for name in archive.namelist() if name.endswith(".whl"))
    assert sorted(f"./{name}" for name in wheels) == sorted(manifest["wheels"])
    pythons = {re.search(r"-(cp\d+)-manylinux", name)[1] for name in wheels}
    range_of_blenders = manifest["blender_version_min"], manifest.get("blender_version_max")
    assert (pythons, *range_of_blenders, "-only" in extension(zips).name) in (
        ({"cp311", "cp313"}, "4.2.0", None, False),
        ({"cp311"}, "4.2.0", "5.1.0", True),
        ({"cp313"}, "4.3.0", None, True),
    )


def test_embree_and_tbb_have_names_of_their_own(zips: list[Path], tmp_path: Path) -> None:
    """Else a Blender that links another version of them answers our calls."""
    with zipfile.ZipFile(extension(zips)) as archive:
        wheels = [archive.extract(name, tmp_path) for name in archive.namelist() if name.endswith(".whl")]
    for wheel in wheels:
        shutil.unpack_archive(wheel, tmp_path / Path(wheel).stem, "zip")
        binaries = [path for path in (tmp_path / Path(wheel).stem).rglob("*.so*") if path.is_file()]
        names = subprocess.run(["nm", "-D", *binaries], capture_output=True, text=True, check=True).stdout
        assert " T pivot_rtcNewDevice" in names
        assert " U pivot_rtcNewDevice" in names
        assert not re.findall(r" [TU] (rtc\w+|_ZN3tbb\w+)", names)


def versions() -> dict[str, str]:
    manifest = tomllib.loads((ROOT / "addon/blender_manifest.toml").read_text())
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    found = {"addon/blender_manifest.toml": manifest["version"], "pyproject.toml": project["version"]}
    for file, pattern in (
        ("CMakeLists.txt", r"project\(pivot VERSION (\S+)"),
        ("addon/core.py", r'VERSION = "(\S+)"'),
    ):
        match = re.search(pattern, (ROOT / file).read_text())
        assert match
        found[file] = match[1]
    assigned = re.search(r'"version": (\(.*\))', (ROOT / "addon/__init__.py").read_text())
    assert assigned
    found["addon/__init__.py"] = ".".join(map(str, ast.literal_eval(assigned[1])))
    return found


def test_one_version_everywhere() -> None:
    assert len(set(versions().values())) == 1, versions()

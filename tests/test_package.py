"""The extension's zip, installed as an artist does in a Blender that has no other Pivot, renders."""

import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

INSTALL_AND_RENDER = """
import sys
zip_path, scene, picture = sys.argv[1:]
sys.path = [entry for entry in sys.path if not entry.startswith({build!r}) or "site-packages" in entry]
import bpy
bpy.ops.extensions.package_install_files(filepath=zip_path, repo="user_default", enable_on_install=True)
import pivot_core
print("pivot_core:", pivot_core.__file__)
bpy.ops.wm.open_mainfile(filepath=scene)
scene = bpy.context.scene
scene.render.engine = "PIVOT"
scene.render.resolution_percentage = 5
scene.pivot.samples = 1
scene.render.filepath = picture
bpy.ops.render.render(write_still=True)
"""


def test_the_extension_installs_and_renders(tmp_path: Path) -> None:
    packed = subprocess.run([ROOT / "run", "package"], capture_output=True, text=True)
    assert packed.returncode == 0, packed.stderr
    zip_path = packed.stdout.strip().removeprefix("Wrote ")
    unset = {name: value for name, value in os.environ.items() if not name.startswith(("BLENDER_USER", "PIVOT"))}
    script = INSTALL_AND_RENDER.format(build=str(ROOT / "build"))
    scene, picture = ROOT / "tests/scenes/default/default.blend", tmp_path / "picture.png"
    rendered = subprocess.run(
        [sys.executable, "-c", script, zip_path, scene, picture],
        env={**unset, "BLENDER_USER_RESOURCES": str(tmp_path / "blender")},
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert rendered.returncode == 0, rendered.stdout + rendered.stderr
    assert f"pivot_core: {tmp_path}" in rendered.stdout
    assert picture.stat().st_size > 0

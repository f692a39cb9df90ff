"""Inside Blender, for test_package: what an artist does with a zip, from installing it to removing it.

installed.py -- ZIP NEWER_ZIP SCENE FOLDER   writes FOLDER/result.json and FOLDER/picture.png
"""

import json
import subprocess
import sys
from pathlib import Path
from typing import Any

BUILD = str(Path(__file__).resolve().parent.parent / "build")
sys.path = [entry for entry in sys.path if not entry.startswith(BUILD) or "site-packages" in entry]

import bpy  # noqa: E402

IS_EXTENSION = bpy.app.version >= (4, 2, 0)


def install(zip_path: str) -> None:
    if IS_EXTENSION:
        bpy.ops.extensions.package_install_files(filepath=zip_path, repo="user_default", enable_on_install=True)
    else:
        bpy.ops.preferences.addon_install(filepath=zip_path, overwrite=True)
        bpy.ops.preferences.addon_enable(module="pivot")


def disable_and_remove() -> None:
    module = "bl_ext.user_default.pivot" if IS_EXTENSION else "pivot"
    bpy.ops.preferences.addon_disable(module=module)
    if IS_EXTENSION:
        repos = [repo.module for repo in bpy.context.preferences.extensions.repos]
        bpy.ops.extensions.package_uninstall(repo_index=repos.index("user_default"), pkg_id="pivot")
    else:
        area = bpy.context.window_manager.windows[0].screen.areas[0]
        with bpy.context.temp_override(area=area):  # which it redraws
            bpy.ops.preferences.addon_remove(module=module)


def render(scene_path: str, picture: Path) -> str:
    """The render's error, or nothing."""
    bpy.ops.wm.open_mainfile(filepath=scene_path)
    scene = bpy.context.scene
    scene.render.engine = "PIVOT"
    scene.render.resolution_percentage = 5
    scene.pivot.samples = 1
    scene.render.filepath = str(picture)
    try:
        bpy.ops.render.render(write_still=True)
    except RuntimeError as error:
        return str(error)
    return ""


def mean(picture: Path) -> float:
    """Of its red, green and blue, in 0..1."""
    pixels = bpy.data.images.load(str(picture)).pixels[:]
    return 4 / 3 * sum(value for i, value in enumerate(pixels) if i % 4 < 3) / len(pixels)


def validate(zip_path: str) -> str:
    """What the extension tool of this Blender has against the zip."""
    tool = Path(bpy.utils.system_resource("SCRIPTS"), "addons_core/bl_pkg/cli/blender_ext.py")
    done = subprocess.run([sys.executable, tool, "validate", zip_path], capture_output=True, text=True)
    return done.stdout + done.stderr if done.returncode else ""


def files(folder: Path) -> list[str]:
    """All but what Blender keeps about extensions as such."""
    found = (path.relative_to(folder) for path in folder.rglob("*") if not path.is_dir())
    return sorted(str(path) for path in found if ".cache" not in path.parts)


def main(zip_path: str, newer_zip: str, scene_path: str, folder: Path) -> Any:
    user = folder / "user"
    result: dict[str, Any] = {"invalid": validate(zip_path) if IS_EXTENSION else "", "before": files(user)}
    install(zip_path)
    result["error"] = render(scene_path, folder / "picture.png")
    result["mean"] = mean(folder / "picture.png")
    (core,) = (m for name, m in sys.modules.items() if name.rpartition(".")[2] == "pivot_core")
    result["core"], result["level"] = core.__file__, core.arch
    install(newer_zip)
    result["error_after_upgrade"] = render(scene_path, folder / "upgraded.png")
    disable_and_remove()
    result["engine_left"] = hasattr(bpy.types, "PivotRenderEngine")
    result["after"] = files(user)
    return result


if __name__ == "__main__":
    *arguments, folder_name = sys.argv[sys.argv.index("--") + 1 :]
    done = main(*arguments, Path(folder_name))
    Path(folder_name, "result.json").write_text(json.dumps(done))

"""Inside Blender, for `./run render`: render each frame once and write it twice, as a multilayer EXR and as a PNG.

Arguments after `--`: "strict", where warnings are errors, or nothing; then the frames, as Blender's -f takes them ("3",
"1,5..8", "+2"), "all" for the scene's range, or nothing for the current frame, whose files then have no number. They go
to the scene's output path; the .blend is not saved. A file has its name only when all of it is written.
"""

import glob
import importlib
import re
import shutil
import sys
from collections.abc import Callable
from pathlib import Path

import bpy

sys.path.insert(0, str(Path(__file__).parent))
from fixes import with_fix
from whole_picture import is_whole


def parse_frames(spec: str, scene: bpy.types.Scene) -> list[int]:
    """The frames of Blender's -f syntax; +n and -n count from the scene's start and end."""
    if spec == "all":
        return list(range(scene.frame_start, scene.frame_end + 1, scene.frame_step))

    def number(text: str) -> int:
        return int(text) + {"+": scene.frame_start, "-": scene.frame_end}.get(text[:1], 0)

    frames: list[int] = []
    for part in spec.split(","):
        first, _, last = part.partition("..")
        frames += range(number(first), number(last or first) + 1)
    return frames


def without_suffix(path: str) -> str:
    return re.sub(r"\.(png|exr)$", "", path)


def write(target: Path, save: Callable[[Path], object]) -> None:
    """Have save(path) write beside the target, and give what is whole the target's name; stereo may make two of it."""
    hidden, target_name = f".{target.stem}.part", target.stem

    def parts() -> list[Path]:
        return sorted(target.parent.glob(f"{glob.escape(hidden)}*{target.suffix}"))

    try:
        try:
            save(target.with_name(hidden + target.suffix))
        except RuntimeError:
            if not parts():  # it was not for the file
                raise
        if not parts() or not all(map(is_whole, parts())):
            raise RuntimeError(not_written(target))
        for part in parts():
            named = part.with_name(part.name.replace(hidden, target_name, 1))
            part.replace(named)
            print(f"Wrote {named}", flush=True)
    finally:
        for part in parts():
            part.unlink()


def not_written(target: Path) -> str:
    disk = next(folder for folder in target.parents if folder.is_mount())
    free_mb = shutil.disk_usage(target.parent).free / 1e6
    return (
        f"{target} could not be written: {free_mb:.1f} MB are free on the disk at {disk}. "
        "Fix: make room there, or choose another place by -- -o PATH"
    )


def render(scene: bpy.types.Scene, output: str) -> None:
    """Render the current frame; output is the absolute path without a suffix."""
    image = scene.render.image_settings
    cancelled: list[bpy.types.Scene] = []
    bpy.app.handlers.render_cancel.append(lambda *_: cancelled.append(scene))

    def render_exr(path: Path) -> None:
        image.file_format, image.color_depth, image.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
        scene.render.filepath = str(path)
        bpy.ops.render.render(write_still=True, scene=scene.name)
        if cancelled:
            raise RuntimeError("the render was cancelled; nothing was written")

    def save_png(path: Path) -> None:
        image.file_format, image.color_depth = "PNG", "8"
        image.color_mode = "RGBA" if scene.render.film_transparent else "RGB"
        bpy.data.images["Render Result"].save_render(str(path), scene=scene)

    write(Path(output + ".exr"), render_exr)
    write(Path(output + ".png"), save_png)


def main(strictness: str, spec: str) -> None:
    scene = bpy.context.scene
    importlib.import_module("pivot.engine").PivotRenderEngine.strict = strictness == "strict"
    scene.render.use_file_extension = True
    output = bpy.path.abspath(scene.render.filepath)
    if not spec:
        render(scene, without_suffix(output))
        return
    for frame in parse_frames(spec, scene):
        scene.frame_set(frame)
        scene.render.filepath = without_suffix(output)
        render(scene, without_suffix(scene.render.frame_path(frame=frame)))


if __name__ == "__main__":
    try:
        main(*sys.argv[sys.argv.index("--") + 1 :])
    except (RuntimeError, ValueError) as error:
        sys.exit(with_fix(str(error)))

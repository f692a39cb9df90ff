"""Inside Blender, for `./run render`: render each frame once and write it twice, as a multilayer EXR and as a PNG.

Argument after `--`: the frames, as Blender's -f takes them ("3", "1,5..8", "+2"), "all" for the scene's range, or
nothing for the current frame, whose files then have no number. They go to the scene's output path; the .blend is not
saved.
"""

import re
import sys

import bpy


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


def render(scene: bpy.types.Scene, output: str) -> None:
    """Render the current frame; output is the absolute path without a suffix."""
    image = scene.render.image_settings
    image.file_format, image.color_depth, image.exr_codec = "OPEN_EXR_MULTILAYER", "32", "ZIP"
    scene.render.filepath = output + ".exr"
    cancelled: list[bpy.types.Scene] = []
    bpy.app.handlers.render_cancel.append(lambda *_: cancelled.append(scene))
    bpy.ops.render.render(write_still=True, scene=scene.name)
    if cancelled:
        raise RuntimeError("the render was cancelled; nothing was written")
    image.file_format, image.color_depth = "PNG", "8"
    image.color_mode = "RGBA" if scene.render.film_transparent else "RGB"
    bpy.data.images["Render Result"].save_render(output + ".png", scene=scene)
    for suffix in (".png", ".exr"):
        print(f"Wrote {output}{suffix}", flush=True)


def main(spec: str) -> None:
    scene = bpy.context.scene
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
        main(sys.argv[sys.argv.index("--") + 1])
    except (RuntimeError, ValueError) as error:
        sys.exit(f"Error: {str(error).strip().removeprefix('Error: ')}")

"""What images of 8192 x 8192 pixels take in memory, by Blender alone, by Pivot and by Cycles, each in its own process.

    ./run python tests/benchmark/image_memory.py [COUNT]

PNG files of 8 bits, RGBA or RGB, COUNT or 4 of them. By Blender alone: all are loaded. Pictures of 64 x 64 pixels, one
sample. In MiB.
"""

from __future__ import annotations

import struct
import subprocess
import sys
import tempfile
import zlib
from pathlib import Path

import bpy

# isort: split
import addon_utils
import numpy as np
from memory import status_mib

SIDE_PX = 8192
CONTENDERS = {"BLENDER": "", "PIVOT": "pivot", "CYCLES": "cycles"}


def write_images(folder: Path, count: int, mode: str) -> None:
    channels = len(mode)
    row = b"\0" + np.linspace(20, 230, SIDE_PX * channels).astype(np.uint8).tobytes()
    header = struct.pack(">2I5B", SIDE_PX, SIDE_PX, 8, {"RGB": 2, "RGBA": 6}[mode], 0, 0, 0)
    png = b"\x89PNG\r\n\x1a\n"
    for kind, data in ((b"IHDR", header), (b"IDAT", zlib.compress(row * SIDE_PX, 1)), (b"IEND", b"")):
        png += struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    for index in range(count):
        (folder / f"{index}.png").write_bytes(png)


def scene_of(files: list[Path]) -> None:
    """A square that shows the sum of all images."""
    bpy.ops.wm.read_homefile(use_empty=True, use_factory_startup=True)
    scene = bpy.context.scene
    scene.render.resolution_x = scene.render.resolution_y = 64
    material = bpy.data.materials.new("images")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    surface = None
    for file in files:
        node, emission = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeEmission")
        node.image = bpy.data.images.load(str(file))
        tree.links.new(node.outputs["Color"], emission.inputs["Color"])
        added = emission
        if surface is not None:
            added = tree.nodes.new("ShaderNodeAddShader")
            tree.links.new(surface.outputs[0], added.inputs[0])
            tree.links.new(emission.outputs[0], added.inputs[1])
        surface = added
    tree.links.new(surface.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    bpy.ops.mesh.primitive_plane_add()
    bpy.context.object.data.materials.append(material)
    scene.camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    scene.camera.location.z = 3
    scene.collection.objects.link(scene.camera)


def measure(contender: str, folder: str) -> None:
    if CONTENDERS[contender]:
        addon_utils.enable(CONTENDERS[contender])
    scene_of(sorted(Path(folder).glob("*.png")))
    before_mib = status_mib("VmRSS")
    if contender == "BLENDER":
        channels = [image.channels for image in bpy.data.images if image.size[0]]  # asking for them loads them
        print(f"{len(channels)} images of {channels[0]} channels")
    else:
        scene = bpy.context.scene
        scene.render.engine = contender
        if contender == "CYCLES":
            scene.cycles.samples, scene.cycles.use_denoising = 1, False
        else:
            scene.pivot.samples = 1
        bpy.ops.render.render()
    print(f"{contender:8} {status_mib('VmHWM') - before_mib:6.0f} MiB at the peak beside {before_mib:.0f}", flush=True)


def main(count: int) -> None:
    for mode in ("RGBA", "RGB"):
        print(f"{count} x {SIDE_PX} x {SIDE_PX} {mode}", flush=True)
        with tempfile.TemporaryDirectory() as folder:
            write_images(Path(folder), count, mode)
            for contender in CONTENDERS:
                subprocess.run([sys.executable, __file__, contender, folder], check=True)


if __name__ == "__main__":
    measure(*sys.argv[1:]) if len(sys.argv) > 2 else main(int(sys.argv[1]) if len(sys.argv) > 1 else 4)

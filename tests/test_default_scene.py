"""The default scene's .blend is what its script makes of the meshes."""

import subprocess
import sys
from pathlib import Path

import pytest

from tests.addon.blender_host import hosts

ROOT = Path(__file__).resolve().parent.parent
SCENE = ROOT / "tests/scenes/default"

DESCRIBE = """
import sys, bpy, addon_utils
addon_utils.enable("pivot")
bpy.ops.wm.open_mainfile(filepath=sys.argv[1])
sys.stdout = open(sys.argv[2], "w")  # where Blender prints nothing
print(bpy.context.scene.render.engine)
for thing in sorted(bpy.context.scene.objects, key=lambda o: o.name):
    mesh = thing.type == "MESH" and (len(thing.data.vertices), len(thing.data.polygons), len(thing.data.materials))
    light = thing.type == "LIGHT" and (thing.data.energy, tuple(thing.data.color))
    print(thing.name, thing.type, [round(x, 5) for row in thing.matrix_world for x in row], mesh, light)
for material in bpy.data.materials:
    for node in material.node_tree.nodes:
        print(material.name, node.type, [socket.name for socket in node.inputs if socket.is_linked],
              [str(getattr(socket, "default_value", "")) and socket.name for socket in node.inputs])
for image in bpy.data.images:
    print(image.name, list(image.size), image.packed_file and image.packed_file.size)
"""


def describe(path: Path, out: Path) -> list[str]:
    subprocess.run([sys.executable, "-c", DESCRIBE, path, out], capture_output=True, check=True)
    return out.read_text().splitlines()


@pytest.mark.skipif(
    all(host.version != (3, 4) for host in hosts()),
    reason="default.blend was saved by Blender 3.4: a newer one converts its disk lights when it loads it",
)
def test_the_script_rebuilds_the_scene(tmp_path: Path) -> None:
    script = SCENE / "build_default.py"
    command = [
        ROOT / "run",
        "blender",
        "-b",
        "--python-exit-code",
        "1",
        "--python",
        script,
        "--",
        tmp_path / "new.blend",
    ]
    subprocess.run(command, check=True, capture_output=True)
    built = describe(tmp_path / "new.blend", tmp_path / "description")
    assert len(built) > 20
    assert built[0] == "PIVOT"
    assert built == describe(SCENE / "default.blend", tmp_path / "description")

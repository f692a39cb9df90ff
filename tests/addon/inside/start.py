"""Run another script of this folder inside Blender: start.py -- SCRIPT FOLDER."""

import importlib
import json
import sys
from pathlib import Path

import bpy

# isort: split
import addon_utils  # found once bpy is there


def main(script: str, folder: Path) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    if addon_utils.enable("pivot") is None:
        raise RuntimeError("the addon does not enable")
    sys.path.insert(0, str(Path(__file__).resolve().parent))
    result = importlib.import_module(script).main(folder)
    (folder / "result.json").write_text(json.dumps(result))


if __name__ == "__main__":
    script, folder = sys.argv[sys.argv.index("--") + 1 :]
    main(script, Path(folder))

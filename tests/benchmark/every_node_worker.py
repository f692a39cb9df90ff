"""Inside Blender: every case of tests/addon/inside/every_node.py by Cycles and by Pivot.

every_node_worker.py < JOB: JSON of {"folder", "only"}. Writes NUMBER_CYCLES.exr and NUMBER_PIVOT.exr of each, and
rows.json with their names and what Pivot said of the node.
"""

from __future__ import annotations

import json
import sys
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "tests" / "addon" / "inside")]
SAMPLES = {"CYCLES": 64, "PIVOT": 16}


def main() -> None:
    job = json.load(sys.stdin)
    for addon in ("cycles", "pivot"):
        if addon_utils.enable(addon) is None:
            raise RuntimeError(f"the addon {addon} does not enable")
    import every_node

    folder, rows = Path(job["folder"]), list[dict[str, Any]]()
    sheet = every_node.sheet()
    for name, _, make in every_node.cases():
        if any(part in name for part in job["only"]):
            said = _render(sheet, make, folder / str(len(rows)))
            rows.append({"number": len(rows), "name": name, "said": said})
    (folder / "rows.json").write_text(json.dumps(rows))


def _render(sheet: Any, make: Any, path: Path) -> list[str]:
    """What Pivot says of the node."""
    import every_node
    import parts

    material, tree = parts.material("material")
    make(tree)
    sheet.data.materials[0] = material
    for engine, samples in SAMPLES.items():
        parts.render_steady(path.with_name(f"{path.name}_{engine}.exr"), engine, samples)
    said = every_node.warnings()
    bpy.data.materials.remove(material)
    node = f"node '{every_node.NODE}': "
    return [text.partition(node)[2] for text in said if node in text]


if __name__ == "__main__":
    main()

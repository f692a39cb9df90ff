"""Inside Blender: balls and a floor seen along it, of one material after the other, by Cycles and by Pivot.

lobe_table_worker.py < JOB: JSON of {"folder", "library", "only", "bounces"}. The scenes are those of
tests/addon/inside/cloth_cases.py. Writes NUMBER_CYCLES.exr and NUMBER_MONTE_CARLO.exr of each row, and rows.json with
their names and what Pivot said. library: a .blend file, of which every material is a row; none: the rows are shader
nodes and their inputs, see lobe_rows.py.
"""

from __future__ import annotations

import importlib
import json
import sys
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils

ROOT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(Path(__file__).resolve().parent), str(ROOT / "tests" / "addon" / "inside")]

Row = tuple[str, Any]  # its name, and a function that makes the material


def node_rows() -> list[Row]:
    """Those that this Blender has."""
    import parts
    from lobe_rows import ROWS

    def make(kind: str, settings: dict[str, Any], inputs: dict[str, Any]) -> Any:
        made, node = parts.shaded("row", kind)
        for name, value in settings.items():
            setattr(node, name, value)
        for name, value in inputs.items():
            node.inputs[name].default_value = value
        return made

    rows: list[Row] = []
    tree = bpy.data.node_groups.new("asked", "ShaderNodeTree")
    for name, (kind, settings, inputs) in ROWS.items():
        if not hasattr(bpy.types, kind):
            continue
        node = tree.nodes.new(kind)
        has_values = all(
            hasattr(node, key) and value in node.bl_rna.properties[key].enum_items for key, value in settings.items()
        )
        if has_values and all(key in node.inputs for key in inputs):
            rows.append((name, lambda kind=kind, s=settings, i=inputs: make(kind, s, i)))
    return rows


def library_rows(file: str) -> list[Row]:
    def load(name: str) -> Any:
        with bpy.data.libraries.load(file) as (_, into):
            into.materials = [name]
        return into.materials[0]

    with bpy.data.libraries.load(file) as (there, _):
        names = list(there.materials)
    return [(name, lambda name=name: load(name)) for name in names]


def main() -> None:
    job = json.load(sys.stdin)
    for addon in ("cycles", "pivot"):
        if addon_utils.enable(addon) is None:
            raise RuntimeError(f"the addon {addon} does not enable")
    from cloth_cases import dress
    from cycles_cases import by_both

    folder, rows = Path(job["folder"]), []
    known = library_rows(job["library"]) if job["library"] else node_rows()
    for name, make in known:
        if not any(part in name for part in job["only"]):
            continue
        dress(make)
        warnings = importlib.import_module("pivot.engine").PivotRenderEngine.frame_count.warnings
        warnings.clear()
        by_both(folder, str(len(rows)), job["bounces"])
        rows.append({"name": name, "said": sorted(warnings)})
    (folder / "rows.json").write_text(json.dumps(rows))


if __name__ == "__main__":
    main()

"""Every shader node and every input of Principled beside Cycles in one table, a row each.

    ./run python -m tests.benchmark.lobe_table [--blender BLENDER] [--library FILE] [--only PART_OF_A_NAME ...]

Two balls and a floor that is seen along it, of one material, under a lamp behind them, an area light and a grey world,
48 x 32. Prints of each row the ratio of the means, Pivot over Cycles, by colour, the FLIP of the pictures as a screen
shows them, and what Pivot said of it. With --library the rows are the materials of a .blend file: Debian's
/usr/share/blender/scripts/addons/materials_library_vx/sample_materials.blend has 35. Pictures are side by side,
Cycles' left, in build/lobe_table.
"""

from __future__ import annotations

import argparse
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path

import bpy  # noqa: F401  Pivot's addon finds Blender's modules once this one is there

# isort: split
import numpy as np
from pivot.chart.pixels import to_bytes, write_png

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))
from beside_cycles import FLIP, TOLERANCE, flip, read_both
from blender_host import environment, host_argument

WORKER = Path(__file__).with_name("lobe_table_worker.py")
PICTURES = Path(__file__).resolve().parents[2] / "build" / "lobe_table"


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", type=host_argument, default=sys.executable, help="a Blender, or a Python with bpy")
    parser.add_argument("--library", default="", metavar="FILE", help="a .blend file of materials")
    parser.add_argument("--only", nargs="+", default=[""], metavar="PART", help="rows whose name has one of these")
    parser.add_argument("--bounces", type=int, default=4)
    arguments = parser.parse_args()
    host = arguments.blender
    PICTURES.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(prefix="lobe_table_") as name:
        folder = Path(name)
        job = {"folder": name, "library": arguments.library, "only": arguments.only, "bounces": arguments.bounces}
        done = subprocess.run(
            [*host.command, str(WORKER)],
            input=json.dumps(job),
            env=environment(folder),
            capture_output=True,
            text=True,
        )
        if not (folder / "rows.json").exists():
            sys.exit(f"exit status {done.returncode}\n{done.stdout}\n{done.stderr}")
        rows = json.loads((folder / "rows.json").read_text())
        print(f"Blender {host}\n\n| | Pivot over Cycles | FLIP | said |\n|---|---|---|---|")
        off = [row["name"] for number, row in enumerate(rows) if not _print_row(folder, str(number), row)]
    print(f"\n{len(rows) - len(off)} of {len(rows)} within {TOLERANCE:.0%} and FLIP {FLIP}; not: {', '.join(off)}")


def _print_row(folder: Path, number: str, row: dict[str, str]) -> bool:
    """Whether the pictures are alike."""
    ours, cycles = read_both(folder, number, "MONTE_CARLO")
    write_png(PICTURES / f"{re.sub(r'[^A-Za-z0-9]+', '_', row['name'])}.png", to_bytes(np.hstack([cycles, ours])))
    ratios = ours.mean(axis=(0, 1)) / np.maximum(cycles.mean(axis=(0, 1)), 1e-6)
    error = flip(ours, cycles)
    means = " ".join(f"{ratio:.3f}" for ratio in ratios)
    said = "<br>".join(re.sub(r"^.*?(?=node |: )", "", text) for text in row["said"])
    print(f"| {row['name']} | {means} | {error:.3f} | {said} |", flush=True)
    return bool(np.all(np.abs(ratios - 1) <= TOLERANCE)) and error <= FLIP


if __name__ == "__main__":
    main()

"""Every shader node, output and menu choice of a Blender: what Pivot says of it, and whether it looks as in Cycles.

    ./run python -m tests.benchmark.every_node [--blender BLENDER] [--only PART_OF_A_NAME ...]

A bent sheet of the node's material, 8 x 8 pixels. Prints a row for each that is not as in Cycles or of which Pivot
says something: *silent* is what differs without a word; then how many there are of each. Noise of shaders and fog on
a sheet that encloses nothing count as differences.
"""

from __future__ import annotations

import argparse
import json
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))
from blender_host import environment, host_argument
from exr import read_rgb

WORKER = Path(__file__).with_name("every_node_worker.py")
TOLERANCE = 0.02  # of the mean, over the pixels


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", type=host_argument, default=sys.executable, help="a Blender, or a Python with bpy")
    parser.add_argument("--only", nargs="+", default=[""], metavar="PART", help="cases whose name has one of these")
    arguments = parser.parse_args()
    host = arguments.blender
    with tempfile.TemporaryDirectory(prefix="every_node_") as name:
        folder = Path(name)
        done = subprocess.run(
            [*host.command, str(WORKER)],
            input=json.dumps({"folder": name, "only": arguments.only}),
            env=environment(folder),
            capture_output=True,
            text=True,
        )
        if not (folder / "rows.json").exists():
            sys.exit(f"exit status {done.returncode}\n{done.stdout}\n{done.stderr}")
        print(f"Blender {host}\n\n| | off by | said |\n|---|---|---|")
        counts = Counter(_print_row(folder, row) for row in json.loads((folder / "rows.json").read_text()))
    print("\n" + ", ".join(f"{count} {kind}" for kind, count in counts.most_common()))


def _print_row(folder: Path, row: dict[str, str]) -> str:
    """What kind it is."""
    ours, cycles = (read_rgb(folder / f"{row['number']}_{engine}.exr") for engine in ("PIVOT", "CYCLES"))
    off = float(np.abs(ours - cycles).mean() / max(np.abs(cycles).mean(), 1e-3))
    kind = "said" if row["said"] else "silent" if off > TOLERANCE else "as in Cycles"
    if kind != "as in Cycles":
        print(f"| {row['name']} | {off:.3f} | {'<br>'.join(row['said']) or 'silent'} |", flush=True)
    return kind


if __name__ == "__main__":
    main()

"""Third-party .blend files and textured models in Cycles and in Pivot: how alike, and what Pivot does not know.

    ./run python -m tests.benchmark.third_party [--blender BLENDER] [--only PART_OF_A_NAME ...]

320 x 180, four bounces, Blender's default pixel filter, no clamping, no denoiser; Cycles 256 samples, Pivot 64. What
has no camera gets one around its bounding box, what has no light a sun, a sphere light and a grey world; of a library
of materials each is worn by a ball. Prints a table, that of third_party.md: the FLIP of the pictures as a screen shows
them, exposed so that Cycles' mean is a mid grey, the ratio of their means, Pivot over Cycles, what was added, and each
kind of Pivot's warnings once with its count. Pictures are side by side, Cycles' left, in build/third_party/pictures.
The files are Debian's and PyPI's (third_party_files.py), fetched there.
"""

from __future__ import annotations

import argparse
import collections
import json
import re
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

import bpy  # noqa: F401  Pivot's addon finds Blender's modules once this one is there

# isort: split
import flip_evaluator
import numpy as np
from numpy.typing import NDArray
from pivot.chart.pixels import to_bytes, write_png
from pivot.srgb import srgb_from_linear

from tests.addon.blender_host import Host, environment, host_argument
from tests.benchmark.third_party_files import CACHE, third_party_files

WORKER = Path(__file__).with_name("third_party_worker.py")
PICTURES = CACHE / "pictures"
MID_GREY = 0.18
TIMEOUT_S = 900

Picture = NDArray[np.float32]


def render(host: Host, file: Path) -> tuple[dict[str, Picture], dict[str, Any]]:
    """The pictures that were made, by renderer, and what was said."""
    with tempfile.TemporaryDirectory(prefix="third_party_") as folder:
        result = Path(folder) / "result"
        done = subprocess.run(
            [*host.command, str(WORKER)],
            input=json.dumps({"file": str(file), "result": str(result)}),
            env=environment(Path(folder)),
            capture_output=True,
            text=True,
            timeout=TIMEOUT_S,
        )
        said = result.with_suffix(".json")
        if not said.exists():
            tail = (done.stdout + done.stderr).strip().splitlines()[-1:]
            return {}, {"added": [], "warnings": [], "fault": f"exit status {done.returncode}: {' '.join(tail)}"}
        with np.load(result.with_suffix(".npz")) as pictures:
            return dict(pictures), json.loads(said.read_text())


def compare(name: str, cycles: Picture, pivot: Picture) -> dict[str, float]:
    """FLIP and the ratio of the means; writes both pictures."""
    exposure = MID_GREY / max(float(cycles.mean()), 1e-6)
    shown = [exposure * np.nan_to_num(picture) for picture in (cycles, pivot)]
    write_png(PICTURES / f"{name}.png", to_bytes(np.hstack(shown)))
    srgb = [np.ascontiguousarray(srgb_from_linear(picture)[::-1], np.float32) for picture in shown]
    ratio = float(pivot.mean()) / max(float(cycles.mean()), 1e-6)
    return {"flip": float(flip_evaluator.evaluate(*srgb, "LDR")[1]), "ratio": ratio}


def kinds(warnings: list[str]) -> list[str]:
    """Each warning without whose it is and the names in it, once, and how many there were."""
    said = (re.sub(r"^(\w+ '[^']*'(, )?)+: ", "", warning) for warning in warnings)
    counts = collections.Counter(re.sub(r"'[^']*'", "'...'", warning) for warning in said)
    return [f"{count} x {kind}" for kind, count in counts.most_common()]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", type=host_argument, default=sys.executable, help="a Blender, or a Python with bpy")
    parser.add_argument("--only", nargs="+", default=[""], metavar="PART", help="files whose path has one of these")
    arguments = parser.parse_args()
    host = arguments.blender
    PICTURES.mkdir(parents=True, exist_ok=True)
    print(f"Blender {host}\n\n| file | FLIP | P / C | added | warnings |\n|---|---|---|---|---|")
    figures = []
    for file in third_party_files():
        if not any(part in str(file) for part in arguments.only):
            continue
        pictures, said = render(host, file)
        found = compare(file.name, pictures["cycles"], pictures["pivot"]) if len(pictures) == 2 else None
        cells = f"{found['flip']:.3f} | {found['ratio']:.3f}" if found else "- | -"
        lines = ([said["fault"]] if "fault" in said else []) + kinds(said["warnings"])
        print(f"| {file.name} | {cells} | {', '.join(said['added'])} | {'<br>'.join(lines)} |", flush=True)
        figures += [found] if found else []
    if figures:
        flips, ratios = ([found[name] for found in figures] for name in ("flip", "ratio"))
        within = np.mean(np.abs(np.array(ratios) - 1) < 0.03)
        print(f"\n{len(figures)} files: median FLIP {np.median(flips):.3f}, mean {np.mean(flips):.3f}; ", end="")
        print(f"{within:.0%} of the means within 3 % of Cycles'")


if __name__ == "__main__":
    main()

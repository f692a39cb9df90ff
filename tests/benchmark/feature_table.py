"""What a scene has beside plain surfaces, Pivot beside Cycles in one table: a row each feature.

    ./run python -m tests.benchmark.feature_table [--blender BLENDER] [--only PART_OF_A_FEATURE ...] [--merge]

Runs the scenes of tests/addon/inside/ that tests compare with Cycles. Prints of each picture, and of each pass of a
multilayer one, the ratio of the means, Pivot over Cycles, by colour, and the FLIP of the pictures as a screen shows
them; where that is seen, alpha's as a fourth. --merge: the least and the most of each script instead. Where both are
dark, no ratio is said. Pictures are side by side, Cycles' left, in build/feature_table.
"""

from __future__ import annotations

import argparse
import re
import sys
import tempfile
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import bpy  # noqa: F401  Pivot's addon finds Blender's modules once this one is there

# isort: split
import numpy as np
from pivot.chart.pixels import to_bytes, write_png

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "addon"))
from beside_cycles import FLIP, TOLERANCE, Picture, flip
from blender_host import Host, host_argument
from exr import read_passes
from pass_names import Passes, colored, with_old_names

# The scripts of inside/ that render pairs of pictures, by what they show.
FEATURES = {
    "lights and samplings": "cycles_cases",
    "lamps with nodes": "lamp_cases",
    "light and shadow linking": "link_cases",
    "light groups and AOVs": "named_cases",
    "skies": "sky_cases",
    "cameras": "camera_pictures",
    "visibility and holdouts": "visibility_cases",
    "limits": "limit_cases",
    "shadow catchers": "catcher_cases",
    "passes": "pass_cases",
    "motion blur": "motion_cases",
    "hair": "hair_cases",
    "fog": "fog_pictures",
    "transparency": "transparency_cases",
    "cloth": "cloth_cases",
    "metals": "metal_cases",
    "thin films": "film_cases",
    "subsurface": "subsurface_cases",
}
OURS = ("MONTE_CARLO", "ANALYTIC", "PIVOT", "JOINT", "SPTD", "MIS", "LIGHT", "BSDF")
NOT_COMPARED = {"pass_cases": {"ANALYTIC"}}  # which has other bounces, and no light passes
NO_COLOURS = ("Crypto", "Denoising", "Depth", "Index", "Normal", "Position", "Vector")  # passes that mean other things
DARK = 1e-3
PICTURES = Path(__file__).resolve().parents[2] / "build" / "feature_table"


@dataclass(frozen=True)
class Row:
    name: str
    ratios: np.ndarray  # (3,) or with alpha (4,); not a number where both pictures are dark
    flip: float

    @property
    def is_alike(self) -> bool:
        return bool(np.nanmax(np.abs(self.ratios - 1), initial=0) <= TOLERANCE) and self.flip <= FLIP

    @property
    def means(self) -> str:
        return " ".join("dark" if np.isnan(ratio) else f"{ratio:.3f}" for ratio in self.ratios)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--blender", type=host_argument, default=sys.executable, help="a Blender, or a Python with bpy")
    parser.add_argument("--only", nargs="+", default=[""], metavar="PART", help="features whose name has one of these")
    parser.add_argument("--merge", action="store_true", help="a row for all pictures of a script")
    arguments = parser.parse_args()
    host = arguments.blender
    PICTURES.mkdir(parents=True, exist_ok=True)
    print(f"Blender {host}\n\n| | Pivot over Cycles | FLIP |\n|---|---|---|", flush=True)
    rows: list[Row] = []
    for feature, script in FEATURES.items():
        if any(part in feature for part in arguments.only):
            found = rows_of(host, feature, script)
            print("\n".join([_merged(feature, found)] if arguments.merge else map(_line, found)), flush=True)
            rows += found
    off = [row.name for row in rows if not row.is_alike]
    print(f"\n{len(rows) - len(off)} of {len(rows)} within {TOLERANCE:.0%} and FLIP {FLIP}; not: {', '.join(off)}")


def rows_of(host: Host, feature: str, script: str) -> list[Row]:
    with tempfile.TemporaryDirectory(prefix="feature_table_") as name:
        folder = Path(name)
        done = host.start(script, folder)
        if done.returncode:  # a feature that this Blender does not have
            reason = (done.stderr.strip() or "failed").splitlines()[-1]
            print(f"{feature}: {script} ends with exit status {done.returncode}: {reason}", file=sys.stderr)
            return []
        ours_by = [each for each in OURS if each not in NOT_COMPARED.get(script, ())]
        return [_row(f"{feature}: {named}", ours, cycles) for named, ours, cycles in pairs(folder, ours_by)]


def pairs(folder: Path, ours_by: list[str]) -> Iterator[tuple[str, Picture, Picture]]:
    """The pictures that a script left, and each pass of multilayer ones: what they are, Pivot's and Cycles'."""
    for cycles_file in sorted(folder.glob("*CYCLES.exr")):
        case = cycles_file.stem.removesuffix("CYCLES").rstrip("_")
        for each in ours_by:
            ours_file = cycles_file.with_stem(f"{case}_{each}".lstrip("_"))
            if not ours_file.exists():
                continue
            named = ", ".join(filter(None, [case, each.lower()])).replace("_", " ")
            ours, cycles = _read(ours_file), _read(cycles_file)
            for name in cycles:
                if name in ours and not name.startswith(NO_COLOURS):
                    yield f"{named}, {name}" if name else named, colored(ours, name), colored(cycles, name)


def _read(file: Path) -> Passes:
    """By name; of a picture without layers by none."""
    passes = read_passes(file)
    if set(passes) == {""}:
        return passes
    return with_old_names({name.split(".")[1]: values for name, values in passes.items()})


def _row(name: str, ours: Picture, cycles: Picture) -> Row:
    if ours.shape[-1] == 4 and min(ours[..., 3].min(), cycles[..., 3].min()) == 1:
        ours, cycles = ours[..., :3], cycles[..., :3]
    means = [picture.mean(axis=(0, 1)) for picture in (ours, cycles)]
    shown = [_over_grey(picture) for picture in (ours, cycles)]
    write_png(PICTURES / f"{re.sub(r'[^A-Za-z0-9]+', '_', name)}.png", to_bytes(np.hstack(shown[::-1])))
    are_dark = np.maximum(*np.abs(means)) < DARK
    ratios = means[0] / np.where(np.abs(means[1]) < 1e-6, 1e-6, means[1])  # an AOV may be negative
    return Row(name, np.where(are_dark, np.nan, ratios), flip(*shown))


def _over_grey(picture: Picture) -> Picture:
    """Three colours of one, three or, premultiplied, four, so that alpha is seen."""
    if picture.shape[-1] == 4:
        return picture[..., :3] + np.float32(0.5) * (1 - picture[..., 3:])
    return np.broadcast_to(picture, (*picture.shape[:2], 3))


def _line(row: Row) -> str:
    return f"| {row.name} | {row.means} | {row.flip:.3f} |"


def _merged(feature: str, rows: list[Row]) -> str:
    if not rows:
        return f"| {feature} | | |"
    seen, flips = np.concatenate([row.ratios for row in rows]), [row.flip for row in rows]
    return f"| {feature} | {np.nanmin(seen):.3f} to {np.nanmax(seen):.3f} | {min(flips):.3f} to {max(flips):.3f} |"


if __name__ == "__main__":
    main()

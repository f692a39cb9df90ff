"""What the Monte Carlo benchmarks print and write of their rows, and a picture with a piece of every image."""

from __future__ import annotations

import csv
from collections.abc import Callable
from pathlib import Path
from typing import Any

import bpy  # noqa: F401  Pivot's addon finds Blender's modules once this one is there

# isort: split
import monte_carlo_scenes as scenes
import numpy as np
from numpy.typing import NDArray
from pivot import core
from pivot.chart.canvas import Canvas
from pivot.chart.pixels import write_png

Row = dict[str, Any]
LABEL_PX, LEFT_PX, GAP_PX = 30, 150, 4
INK = (0.13, 0.13, 0.15)


def by_scene(rows: list[Row]) -> dict[str, dict[str, Row]]:
    found: dict[str, dict[str, Row]] = {}
    for row in rows:
        found.setdefault(row["scene"], {})[row["renderer"]] = row
    return found


def best(found: dict[str, Row], name: str, adaptive: bool = True) -> dict[str, Row]:
    """The most efficient of the renderers whose label starts so, with or without those adaptive; empty if there is
    none."""
    rows = [row for label, row in found.items() if label.startswith(name) and (adaptive or "adaptive" not in label)]
    return {name: max(rows, key=lambda row: row["efficiency"])} if rows else {}


def print_row(row: Row) -> None:
    cells = (f"{name} {value:.4g}" if isinstance(value, float) else str(value) for name, value in row.items())
    print("  ".join(cells), flush=True)


def write_csv(file: Path, rows: list[Row]) -> None:
    with file.open("w", newline="") as opened:
        writer = csv.DictWriter(opened, rows[0].keys())
        writer.writeheader()
        writer.writerows(rows)


def print_table(rows: list[Row]) -> None:
    """Each renderer's figures, and by how much Pivot is more efficient."""
    print(
        f"\n{'scene':20} {'renderer':28} {'relMSE':>9} {'worst 1% out':>12}"
        f" {'CPU s':>8} {'Ms/s':>6} {'pivot x':>8} {'mean':>8}"
    )
    for scene, found in by_scene(rows).items():
        for label, row in found.items():
            ratio = found["pivot"]["efficiency"] / row["efficiency"] if "pivot" in found else float("nan")
            errors = f"{row['relMSE']:9.2e} {row['relMSE without the worst']:12.2e}"
            costs = f"{row['CPU s']:8.2f} {row['Msamples per CPU s']:6.2f}"
            print(f"{scene:20} {label:28} {errors} {costs} {ratio:8.2f} {row['mean']:8.5f}")


def print_ratios(rows: list[Row]) -> None:
    """By scene and as geometric means: Pivot's efficiency over the others', and joint sampling's over MIS.

    Adaptive, Pivot's is over the best that the others have, adaptive or not.
    """

    def over(own: str, other: str, figure: str) -> Callable[[dict[str, Row]], float | None]:
        def ratio(found: dict[str, Row]) -> float | None:
            others = best(found, other, adaptive="adaptive" in own)
            if own not in found or not others:
                return None
            ours, theirs = found[own][figure], others[other][figure]
            return theirs / ours if figure == "relMSE" else ours / theirs

        return ratio

    columns = {
        "over Cycles": over("pivot", "cycles", "efficiency"),
        "worst 1% out": over("pivot", "cycles", "efficiency without the worst"),
        "adaptive over Cycles": over("pivot adaptive", "cycles", "efficiency"),
        "adaptive, worst 1% out": over("pivot adaptive", "cycles", "efficiency without the worst"),
        "over Mitsuba": over("pivot", "mitsuba", "efficiency"),
        "adaptive over Mitsuba": over("pivot adaptive", "mitsuba", "efficiency"),
        "joint over MIS, samples": over("pivot", "pivot MIS", "relMSE"),
        "CPU": over("pivot", "pivot MIS", "efficiency"),
    }
    print("\nTimes the efficiency (of joint over MIS at equal samples: times less relMSE)")
    print(f"{'':20}", *(f"{name:>{len(name)}}" for name in columns), sep="  ")
    ratios: dict[str, list[float]] = {name: [] for name in columns}
    for scene, found in by_scene(rows).items():
        cells = []
        for name, column in columns.items():
            ratio = column(found)
            cells.append(f"{'' if ratio is None else f'{ratio:.2f}':>{len(name)}}")
            ratios[name] += [] if ratio is None else [ratio]
        print(f"{scene:20}", *cells, sep="  ")
    for label, of in (("geometric mean", lambda v: float(np.exp(np.mean(np.log(v))))), ("least", min)):
        cells = [f"{f'{of(values):.2f}' if values else '':>{len(name)}}" for name, values in ratios.items()]
        print(f"{label:20}", *cells, sep="  ")


def print_growth(rows: list[Row]) -> None:
    """CPU that one quality costs as lights of the same total power become more: relMSE x CPU, and over the fewest's."""
    print(f"\n{'lights':>8} {'renderer':22} {'relMSE':>9} {'CPU s':>8} {'relMSE x CPU':>13} {'of the fewest':>14}")
    fewest: dict[str, float] = {}
    for row in rows:
        product = row["relMSE"] * row["CPU s"]
        growth = product / fewest.setdefault(row["renderer"], product)
        lights = len(scenes.SCENES[row["scene"]].lights)
        figures = f"{row['relMSE']:9.2e} {row['CPU s']:8.2f} {product:13.2e} {growth:14.2f}"
        print(f"{lights:8} {row['renderer']:22} {figures}")


def write_picture(
    file: Path, lines: list[str], images: dict[str, dict[str, NDArray[np.float64]]], piece_px: tuple[int, int]
) -> None:
    """images: by column, then line. Of each its middle of piece_px, width and height, at the pixels' own size."""
    width, height = piece_px
    size = (LEFT_PX + len(images) * (width + GAP_PX), LABEL_PX + len(lines) * (height + GAP_PX))
    canvas = Canvas(core.load(), *size)
    for column, (label, by_line) in enumerate(images.items()):
        x = LEFT_PX + column * (width + GAP_PX)
        canvas.text(x + width / 2, size[1] - 20, label, 18, INK, "CENTER")
        for number, name in enumerate(lines, 1):
            y = size[1] - LABEL_PX - number * (height + GAP_PX)
            if name in by_line:
                image = by_line[name]
                x0, y0 = (image.shape[1] - width) // 2, (image.shape[0] - height) // 2
                canvas.image(x, y, image[y0 : y0 + height, x0 : x0 + width])
    for number, name in enumerate(lines, 1):
        y = size[1] - LABEL_PX - number * (height + GAP_PX)
        canvas.text(LEFT_PX - 8, y + height / 2, name, 16, INK, "RIGHT")
    write_png(file, canvas.render())

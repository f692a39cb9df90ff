"""`./run stability`: the stability table as CSV and PNG.

python -m tests.stability OUTPUT   writes OUTPUT.csv and OUTPUT.png
"""

from __future__ import annotations

import csv
import importlib
import os
import sys
from pathlib import Path
from typing import Any

import bpy  # noqa: F401  the addon's canvas draws by it

# isort: split
import addon_utils
import numpy as np

from tests.core.stability_table import Row, function_rows, gaussian_rows, light_rows, render_rows

INK, GREY, PALE = (0.13, 0.13, 0.15), (0.45, 0.45, 0.48), (0.92, 0.92, 0.93)
PRINTED, OURS, BOUND = (0.85, 0.3, 0.2), (0.05, 0.35, 0.7), (0.6, 0.6, 0.63)
WIDTH, LINE_PX, LEFT, RIGHT, TOP, BOTTOM = 1000, 15, 330, 190, 92, 26
FIRST, LAST = -8, 8  # decades of error; what is beyond is drawn at the edge


def write_csv(path: Path, rows: list[Row]) -> None:
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(["what", "name", "limit", "printed form: error", "Pivot: error", "bound", "method"])
        for row in rows:
            printed = "" if row.printed_error is None else f"{row.printed_error:.2g}"
            writer.writerow(
                [row.what, row.name, row.limit, printed, f"{row.error:.2g}", f"{row.bound:.2g}", row.method]
            )


def summary(rows: list[Row]) -> list[Row]:
    """One line a function, its worst; the others as they are."""
    lines: dict[str, Row] = {}
    for row in rows:
        name = row.name.split(",")[0].split(" ")[0].removesuffix("'s")
        key = name if row.what == "functions" else f"{row.name}: {row.limit}"
        old = lines.get(key)
        printed = [r.printed_error for r in (row, old) if r is not None and r.printed_error is not None]
        worst = row if old is None or row.error / row.bound > old.error / old.bound else old
        lines[key] = Row(row.what, key, "", max(printed, default=None), worst.error, worst.bound, worst.method)
    return list(lines.values())


def draw(path: Path, rows: list[Row]) -> None:
    canvas_module, pixels, plot = (importlib.import_module(f"pivot.chart.{n}") for n in ("canvas", "pixels", "plot"))
    lines = summary(rows)
    kinds = list(dict.fromkeys(row.what for row in lines))
    height = TOP + BOTTOM + LINE_PX * (len(lines) + 2 * len(kinds))
    canvas: Any = canvas_module.Canvas(importlib.import_module("pivot.core").load(), WIDTH, height)

    def x(error: float) -> float:
        decade = np.clip(np.log10(max(error, 1e-300)), FIRST, LAST) if np.isfinite(error) else LAST
        return LEFT + float(decade - FIRST) / (LAST - FIRST) * (WIDTH - LEFT - RIGHT)

    canvas.text(16, height - 32, "Float32 where formulas fail: worst relative error", 21, INK)
    legend = ((PRINTED, "as printed in the papers"), (OURS, "Pivot"), (BOUND, "bound that the tests hold"))
    for index, (color, text) in enumerate(legend):
        if color == BOUND:
            canvas.line([(24 + 200 * index, height - 59), (24 + 200 * index, height - 49)], 2, BOUND)
        else:
            canvas.dot(24 + 200 * index, height - 54, 4.5, color)
        canvas.text(36 + 200 * index, height - 59, text, 13, INK)
    for decade in range(FIRST, LAST + 1, 2):
        at = x(10.0**decade)
        canvas.line([(at, BOTTOM), (at, height - TOP + 4)], 1, PALE)
        label = plot.decade(decade)
        label = "not finite" if decade == LAST else label
        canvas.text(at, height - TOP + 8, label, 12, GREY, "CENTER")
    y = height - TOP
    for kind in kinds:
        y -= 2 * LINE_PX
        canvas.text(16, y + 4, kind, 14, INK)
        if kind != "functions":
            canvas.text(WIDTH - RIGHT + 14, y + 4, "method chosen" if "GGX" in kind else "settings", 12, INK)
        for row in (row for row in lines if row.what == kind):
            y -= LINE_PX
            canvas.text(LEFT - 12, y, row.name, 11, GREY, "RIGHT")
            if row.printed_error is not None:
                canvas.line([(x(row.error), y + 4), (x(row.printed_error), y + 4)], 1.5, PALE)
            canvas.line([(x(row.bound), y - 1), (x(row.bound), y + 9)], 2, BOUND)
            if row.printed_error is not None:
                canvas.dot(x(row.printed_error), y + 4, 4.5, PRINTED)
            canvas.dot(x(row.error), y + 4, 4.5, OURS)
            canvas.text(WIDTH - RIGHT + 14, y, row.method, 11, GREY)
    pixels.write_png(path, canvas.render())


def main(output: Path) -> None:
    addon_utils.enable("pivot")
    rows = [*function_rows(), *light_rows(), *gaussian_rows(), *render_rows()]
    output.parent.mkdir(parents=True, exist_ok=True)
    csv_path, png_path = output.with_suffix(".csv"), output.with_suffix(".png")
    write_csv(csv_path, rows)
    draw(png_path, rows)
    print(f"{'function':62} {'printed':>9} {'Pivot':>9} {'bound':>9}  method")
    for row in summary(rows):
        printed = "" if row.printed_error is None else f"{row.printed_error:.1e}"
        print(f"{row.name:62} {printed:>9} {row.error:9.1e} {row.bound:9.1e}  {row.method}")
    held = sum(row.error <= row.bound for row in rows)
    print(f"{len(rows)} rows, {held} within their bound. Wrote {csv_path} and {png_path}")
    sys.stdout.flush()
    os._exit(0 if held == len(rows) else 1)  # some Blenders crash at exit while classes are registered


if __name__ == "__main__":
    main(Path(sys.argv[1]))

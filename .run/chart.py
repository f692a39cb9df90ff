"""For `./run chart`: chart a scene's speed against accuracy in Blender as a module, with FLIP and a contact sheet.

chart.py FILE.blend LADDERS FOLDER   writes FOLDER/NAME.png, NAME.csv and NAME-sheet.png of the first ladder, and of
each further one, after a comma, NAME-LADDER.png and so on

Pivot and Cycles are each held against their own converged picture. The charting itself is the addon's (addon/chart).
"""

from __future__ import annotations

import csv
import functools
import importlib
import os
import sys
import traceback
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import bpy

# isort: split
import addon_utils
import flip_evaluator
import numpy as np
from fixes import with_fix
from numpy.typing import NDArray

Floats = NDArray[np.floating]
CROP_PX, CELL_PX, GAP_PX, TEXT_PX = 80, 160, 10, 44
COLUMNS = 6


def quiet_blender(log: Path) -> None:
    """Blender's own lines go to the log; Python still prints where it did."""
    sys.stdout = os.fdopen(os.dup(1), "w", buffering=1)
    os.dup2(os.open(log, os.O_WRONLY | os.O_CREAT | os.O_TRUNC), 1)


def flip(reference: Floats, image: Floats, to_srgb: Any) -> float:
    """Mean FLIP of the pictures as a screen shows them, 0 (the same) to 1."""
    shown = [np.ascontiguousarray(to_srgb(picture)[::-1], np.float32) for picture in (reference, image)]
    return float(flip_evaluator.evaluate(*shown, "LDR")[1])


def write_csv(path: Path, rows: Sequence[Any], flips: Sequence[float], noises: dict[str, float]) -> None:
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(
            ["renderer", "method", "setting", "samples", "CPU s", "relMSE", "FLIP", "relMSE of the reference"]
        )
        for row, value in zip(rows, flips, strict=True):
            rung = row.rung
            figures = [f"{row.cpu_s:.4f}", f"{row.rel_mse:.4g}", f"{value:.4f}", f"{noises[rung.renderer]:.3g}"]
            writer.writerow([rung.renderer, rung.method, rung.label, rung.samples, *figures])


def worst_window(errors: Sequence[Floats]) -> tuple[slice, slice]:
    """The CROP_PX square where the pictures err most, outliers aside."""
    error = np.mean([np.sqrt(e.mean(-1)).clip(0, 1) for e in errors], 0)
    size = min(CROP_PX, *error.shape)
    sums = np.pad(error.cumsum(0).cumsum(1), ((1, 0), (1, 0)))
    windows = sums[size:, size:] - sums[:-size, size:] - sums[size:, :-size] + sums[:-size, :-size]
    y, x = np.unravel_index(windows.argmax(), windows.shape)
    return slice(int(y), int(y) + size), slice(int(x), int(x) + size)


def error_colors(relative: Floats) -> Floats:
    """Relative errors (height, width), black at 0, red, yellow, white at 1."""
    return np.stack([np.clip(3 * relative - k, 0, 1) for k in range(3)], -1)


def draw_sheet(new_canvas: Any, rows: Sequence[Any], references: dict[str, Any]) -> Any:
    """A canvas with a crop of each method at about the same cost, its error map below it. new_canvas: of its size."""
    budget_s = float(np.median([row.cpu_s for row in rows]))
    chosen: dict[str, Any] = {}
    for row in rows:
        best = chosen.get(row.rung.method)
        if best is None or abs(np.log(row.cpu_s / budget_s)) < abs(np.log(best.cpu_s / budget_s)):
            chosen[row.rung.method] = row
    images = {method: np.load(row.file)["image"] for method, row in chosen.items()}
    means = {method: references[row.rung.renderer].mean for method, row in chosen.items()}
    errors = {method: (images[method] - means[method]) ** 2 / (means[method] ** 2 + 0.01) for method in chosen}
    window = worst_window(list(errors.values()))
    blank = np.zeros((*(side.stop - side.start for side in window), 3))
    cells = [("Reference", f"about {budget_s:.2g} CPU s each", references["PIVOT"].mean[window], blank)]
    for method, row in chosen.items():
        note = f"{row.rung.label}   {row.cpu_s:.2g} s   relMSE {row.rel_mse:.2g}"
        map_of_errors = error_colors(np.sqrt(errors[method][window].mean(-1)))
        cells.append((method, note, images[method][window], map_of_errors))

    zoom = CELL_PX // blank.shape[0]
    side = blank.shape[0] * zoom
    width, height = side + GAP_PX, 2 * side + GAP_PX + TEXT_PX
    lines = -(-len(cells) // COLUMNS)
    canvas = new_canvas(COLUMNS * width + GAP_PX, lines * height + GAP_PX)
    for index, (name, note, picture, errors_seen) in enumerate(cells):
        x = GAP_PX + index % COLUMNS * width
        y = GAP_PX + (lines - 1 - index // COLUMNS) * height
        for level, pixels in ((0, errors_seen), (1, picture)):
            canvas.image(x, y + level * side, pixels.repeat(zoom, 0).repeat(zoom, 1))
        canvas.text(x, y + 2 * side + 22, name, 15, (0.1, 0.1, 0.1))
        canvas.text(x, y + 2 * side + 7, note, 10, (0.4, 0.4, 0.4))
    return canvas


def is_told(error: Exception) -> bool:
    """Whether an error says what is wrong with the scene: Blender's of a file or a render, or Pivot's own."""
    return isinstance(error, RuntimeError) or type(error).__name__ == "RenderError"


def draw(blend: Path, ladder_name: str, name: str, folder: Path) -> None:
    """name: of the files that are written."""
    bpy.ops.wm.open_mainfile(filepath=str(blend))
    for addon in ("cycles", "pivot"):
        addon_utils.enable(addon)
    canvas, errors, ladder, measure, pixels, plot = (
        importlib.import_module(f"pivot.chart.{name}")
        for name in ("canvas", "errors", "ladder", "measure", "pixels", "plot")
    )
    core = importlib.import_module("pivot.core").load()
    chosen = ladder.LADDERS[ladder_name]
    rows = measure.measure(blend, chosen, folder, print)
    pictures = measure.Pictures(folder / measure.scene_key(blend, chosen.width_px))
    references = {
        renderer: measure.reference_of(renderer, chosen, pictures)
        for renderer in {rung.renderer for rung in chosen.rungs}
    }
    srgb = pixels.srgb_from_linear
    flips = [flip(references[row.rung.renderer].mean, np.load(row.file)["image"], srgb) for row in rows]
    out = {kind: folder / f"{name}{kind}" for kind in (".png", ".csv", "-sheet.png")}
    plot.draw_chart(core, rows, out[".png"], *plot.titles(blend.stem, chosen))
    noises = {renderer: reference.noise for renderer, reference in references.items()}
    write_csv(out[".csv"], rows, flips, noises)
    sheet = draw_sheet(functools.partial(canvas.Canvas, core), rows, references)
    pixels.write_png(out["-sheet.png"], sheet.render())
    apart = references["PIVOT"].rel_mse(references["CYCLES"].mean)
    print(f"Pivot's and Cycles' converged pictures are relMSE {apart:.2g} apart")
    print(f"{'method':22} {'setting':>8} {'CPU s':>9} {'relMSE':>9} {'FLIP':>7}   Pareto front *")
    front = errors.pareto_front(rows)
    for row, value in zip(rows, flips, strict=True):
        figures = f"{row.cpu_s:9.3f} {row.rel_mse:9.2e} {value:7.4f}"
        print(f"{row.rung.method:22} {row.rung.label:>8} {figures}   {'*' if row in front else ''}")
    for path in out.values():
        print(f"Wrote {path}")


def main(blend: Path, ladders: Sequence[str], folder: Path) -> None:
    print("skipped: Mitsuba, which .blend files are not translated for (tests/benchmark/monte_carlo.py compares it)")
    for k, ladder_name in enumerate(ladders):
        draw(blend, ladder_name, blend.stem if k == 0 else f"{blend.stem}-{ladder_name.lower()}", folder)


if __name__ == "__main__":
    blend, ladders, folder = sys.argv[1:]
    Path(folder).mkdir(parents=True, exist_ok=True)
    quiet_blender(Path(folder) / "blender.log")
    status = 0
    try:
        main(Path(blend), ladders.split(","), Path(folder))
    except Exception as error:
        if not is_told(error):
            traceback.print_exc()
        print(with_fix(str(error)))
        status = 1
    sys.stdout.flush()
    os._exit(status)  # some Blenders crash at exit while classes are registered

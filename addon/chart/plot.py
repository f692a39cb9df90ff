"""The chart: CPU seconds across, relMSE up, a line a method, the Pareto front beneath them."""

from __future__ import annotations

import math
from collections.abc import Sequence
from pathlib import Path
from types import ModuleType

from .canvas import Canvas, Color
from .errors import Row, pareto_front
from .ladder import Ladder
from .pixels import write_png

INK, GREY, PALE, FRONT = (0.13, 0.13, 0.15), (0.45, 0.45, 0.48), (0.9, 0.9, 0.91), (1.0, 0.88, 0.5)
COLORS: dict[str, Color] = {
    "Monte Carlo, joint": (0.05, 0.25, 0.6),
    "Monte Carlo, denoised": (0.1, 0.6, 0.65),
    "Monte Carlo, SPTD": (0.2, 0.5, 0.8),
    "Monte Carlo, MIS": (0.5, 0.75, 0.9),
    "Analytic": (0.75, 0.1, 0.1),
    "Analytic, by budget": (0.95, 0.45, 0.1),
    "Analytic, exact": (0.9, 0.4, 0.5),
    "Virtual lights": (0.75, 0.1, 0.1),
    "Virtual lights, by number": (0.95, 0.45, 0.1),
    "Analytic, SPTD": (0.55, 0.3, 0.65),
    "Analytic, LTC": (0.75, 0.6, 0.85),
    "Cycles": (0.15, 0.5, 0.25),
    "Mitsuba": (0.5, 0.55, 0.1),
}
WIDTH, HEIGHT = 1040, 640
LEFT, RIGHT, BOTTOM, TOP = 84, 250, 70, 84  # margins
_LABEL_PX = 21  # between the lines' names
_POINT_PX = 30  # between the front's labelled points
_POWERS = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


class Axis:
    """Whole decades onto pixels."""

    def __init__(self, values: Sequence[float], first_px: float, last_px: float) -> None:
        self.first, self.last = math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))
        self.last = max(self.last, self.first + 1)
        self._first_px, self._px_per_decade = first_px, (last_px - first_px) / (self.last - self.first)

    def __call__(self, value: float) -> float:
        return self._first_px + (math.log10(value) - self.first) * self._px_per_decade

    def decades(self) -> range:
        return range(self.first, self.last + 1)


def spread(wanted: Sequence[float], gap: float, low: float, high: float) -> list[float]:
    """Places near the wanted ones, at least gap apart, in their order; between low and high if they fit."""
    order = sorted(range(len(wanted)), key=lambda i: wanted[i])
    places = [0.0] * len(wanted)
    floor = low
    for i in order:
        places[i] = max(wanted[i], floor)
        floor = places[i] + gap
    ceiling = high
    for i in reversed(order):
        places[i] = min(places[i], ceiling)
        ceiling = places[i] - gap
    return places


def decade(exponent: int) -> str:
    return f"{10.0**exponent:g}" if -3 < exponent < 4 else "10" + str(exponent).translate(_POWERS)


def titles(scene: str, ladder: Ladder) -> tuple[str, str]:
    """Title and note of a scene's chart."""
    reference = f"against {ladder.reference_samples} samples of each renderer"
    light = "Direct light" if ladder.max_bounces == 0 else f"Bounces: {ladder.max_bounces}"
    note = f"{light}, {ladder.width_px} px wide, {reference}. Numbers: samples, the error budget, or lights."
    return f"{scene}: speed against accuracy", note


def draw_chart(core: ModuleType, rows: Sequence[Row], path: Path, title: str, note: str) -> None:
    """note: below the title: what was measured."""
    canvas = Canvas(core, WIDTH, HEIGHT)
    x = Axis([row.cpu_s for row in rows], LEFT, WIDTH - RIGHT)
    y = Axis([row.rel_mse for row in rows], BOTTOM, HEIGHT - TOP)
    canvas.text(LEFT, HEIGHT - 36, title, 24, INK)
    canvas.text(LEFT, HEIGHT - 60, note, 14, GREY)
    _draw_axes(canvas, x, y)

    def place(row: Row) -> tuple[float, float]:
        return x(row.cpu_s), y(row.rel_mse)

    front = pareto_front(rows)
    canvas.line([place(row) for row in front], 13, FRONT)
    lines: dict[str, list[Row]] = {}
    for row in rows:
        lines.setdefault(row.rung.method, []).append(row)
    ends = [place(line[-1]) for line in lines.values()]
    heights = spread([end[1] for end in ends], _LABEL_PX, BOTTOM, HEIGHT - TOP)
    for method, end, height in zip(lines, ends, heights, strict=True):
        color = COLORS.get(method, GREY)
        canvas.line([end, (WIDTH - RIGHT + 8, height), (WIDTH - RIGHT + 18, height)], 1, PALE)
        canvas.text(WIDTH - RIGHT + 24, height - 5, method, 17, color)
    for method, line in lines.items():
        color = COLORS.get(method, GREY)
        canvas.line([place(row) for row in line], 2.5, color)
        for row in line:
            canvas.dot(*place(row), 4.5, color)
    labelled: list[tuple[float, float]] = []
    for row in front:
        if all(math.dist(place(row), other) > _POINT_PX for other in labelled):
            canvas.text(place(row)[0] - 7, place(row)[1] - 17, row.rung.label, 13, INK, "RIGHT")
            labelled.append(place(row))
    canvas.line([(WIDTH - RIGHT + 24, 30), (WIDTH - RIGHT + 54, 30)], 13, FRONT)
    canvas.text(WIDTH - RIGHT + 68, 25, "Pareto front", 14, INK)
    write_png(path, canvas.render())


def _draw_axes(canvas: Canvas, x: Axis, y: Axis) -> None:
    right, top = WIDTH - RIGHT, HEIGHT - TOP
    for exponent in x.decades():
        at = x(10.0**exponent)
        canvas.line([(at, BOTTOM), (at, top)], 1, PALE)
        canvas.text(at, BOTTOM - 22, decade(exponent), 15, INK, "CENTER")
    for exponent in y.decades():
        at = y(10.0**exponent)
        canvas.line([(LEFT, at), (right, at)], 1, PALE)
        canvas.text(LEFT - 10, at - 5, decade(exponent), 15, INK, "RIGHT")
    canvas.line([(LEFT, top), (LEFT, BOTTOM), (right, BOTTOM)], 1.5, INK)
    canvas.text((LEFT + right) / 2, 18, "CPU seconds", 17, INK, "CENTER")
    canvas.text(14, top + 8, "relMSE", 17, INK)

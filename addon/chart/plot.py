"""The chart: CPU seconds across, relMSE up, a line a method, the Pareto front beneath them. Below it another, across
which is the number of virtual lights, where lines are of that."""

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
    "by the formulas of 2024": (0.55, 0.3, 0.65),
    "by the formulas of 2015": (0.75, 0.6, 0.85),
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
    of_number = [row for row in rows if row.rung.virtual_lights is not None]
    canvas = Canvas(core, WIDTH, HEIGHT * (2 if of_number else 1))
    bottom = canvas.height - HEIGHT
    canvas.text(LEFT, canvas.height - 36, title, 24, INK)
    canvas.text(LEFT, canvas.height - 60, note, 14, GREY)
    y = _error_axis(rows, bottom)
    x = Axis([row.cpu_s for row in rows], LEFT, WIDTH - RIGHT)
    _draw_axes(canvas, x, y, bottom, "CPU seconds")
    front = pareto_front(rows)
    canvas.line([(x(row.cpu_s), y(row.rel_mse)) for row in front], 13, FRONT)
    _draw_lines(canvas, [(row, x(row.cpu_s), y(row.rel_mse)) for row in rows], bottom)
    labelled: list[tuple[float, float]] = []
    for row in front:
        place = x(row.cpu_s), y(row.rel_mse)
        if all(math.dist(place, other) > _POINT_PX for other in labelled):
            canvas.text(place[0] - 7, place[1] - 17, row.rung.label, 13, INK, "RIGHT")
            labelled.append(place)
    canvas.line([(WIDTH - RIGHT + 24, bottom + 30), (WIDTH - RIGHT + 54, bottom + 30)], 13, FRONT)
    canvas.text(WIDTH - RIGHT + 68, bottom + 25, "Pareto front", 14, INK)
    if of_number:
        _draw_numbers(canvas, of_number)
    write_png(path, canvas.render())


def _draw_numbers(canvas: Canvas, rows: Sequence[Row]) -> None:
    """relMSE against the number of virtual lights, at the canvas' bottom."""
    numbers = [row.rung.virtual_lights or 1 for row in rows]
    x, y = Axis(numbers, LEFT, WIDTH - RIGHT), _error_axis(rows, 0)
    _draw_axes(canvas, x, y, 0, "Virtual lights")
    _draw_lines(canvas, [(row, x(n), y(row.rel_mse)) for row, n in zip(rows, numbers, strict=True)], 0)


def _error_axis(rows: Sequence[Row], bottom: int) -> Axis:
    return Axis([row.rel_mse for row in rows], bottom + BOTTOM, bottom + HEIGHT - TOP)


def _draw_lines(canvas: Canvas, points: Sequence[tuple[Row, float, float]], bottom: int) -> None:
    """points: each row's, in pixels."""
    lines: dict[str, list[tuple[float, float]]] = {}
    for row, *place in points:
        lines.setdefault(row.rung.method, []).append((place[0], place[1]))
    ends = [line[-1] for line in lines.values()]
    heights = spread([end[1] for end in ends], _LABEL_PX, bottom + BOTTOM, bottom + HEIGHT - TOP)
    for method, end, height in zip(lines, ends, heights, strict=True):
        color = COLORS.get(method, GREY)
        canvas.line([end, (WIDTH - RIGHT + 8, height), (WIDTH - RIGHT + 18, height)], 1, PALE)
        canvas.text(WIDTH - RIGHT + 24, height - 5, method, 17, color)
    for method, line in lines.items():
        color = COLORS.get(method, GREY)
        canvas.line(line, 2.5, color)
        for place in line:
            canvas.dot(*place, 4.5, color)


def _draw_axes(canvas: Canvas, x: Axis, y: Axis, bottom: int, across: str) -> None:
    right, low, top = WIDTH - RIGHT, bottom + BOTTOM, bottom + HEIGHT - TOP
    for exponent in x.decades():
        at = x(10.0**exponent)
        canvas.line([(at, low), (at, top)], 1, PALE)
        canvas.text(at, low - 22, decade(exponent), 15, INK, "CENTER")
    for exponent in y.decades():
        at = y(10.0**exponent)
        canvas.line([(LEFT, at), (right, at)], 1, PALE)
        canvas.text(LEFT - 10, at - 5, decade(exponent), 15, INK, "RIGHT")
    canvas.line([(LEFT, top), (LEFT, low), (right, low)], 1.5, INK)
    canvas.text((LEFT + right) / 2, bottom + 18, across, 17, INK, "CENTER")
    canvas.text(14, top + 8, "relMSE", 17, INK)

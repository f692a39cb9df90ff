"""First pictures are as coarse as what they and Blender's drawing take asks for, without a Blender."""

from __future__ import annotations

import importlib.util
from typing import Any

import pytest
from blender_host import ROOT

PIXELS = 960 * 540


@pytest.fixture(scope="module")
def module() -> Any:
    spec = importlib.util.spec_from_file_location("viewport_pace", ROOT / "addon" / "viewport_pace.py")
    assert spec
    assert spec.loader
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


class Clock:
    now_s = 100.0

    def monotonic(self) -> float:
        return self.now_s


def moved(module: Any, monkeypatch: pytest.MonkeyPatch, onto_screen_s: float, pixel_s: float) -> Any:
    """A Pace after a second of draws, each of which is on the screen so long after it; nothing else takes time."""
    clock = Clock()
    monkeypatch.setattr(module, "time", clock)
    pace = module.Pace()
    for _ in range(30):
        pace.draw_begins()
        edge_px = pace.pixel_px(PIXELS, 1.0)
        picture_s = pixel_s * PIXELS / edge_px**2
        pace.took(picture_s, round(PIXELS / edge_px**2))
        clock.now_s += min(picture_s, pace.wait_s)
        pace.draw_ends()
        clock.now_s += onto_screen_s
        pace.is_on_screen()
    return pace


@pytest.mark.parametrize("onto_screen_s", [0.002, 0.01, 0.03, 0.05])
def test_fifteen_pictures_are_shown_a_second(
    module: Any, monkeypatch: pytest.MonkeyPatch, onto_screen_s: float
) -> None:
    pixel_s = 1e-6
    pace = moved(module, monkeypatch, onto_screen_s, pixel_s)
    picture_s = pixel_s * PIXELS / pace.pixel_px(PIXELS, 1.0) ** 2
    assert picture_s + onto_screen_s <= 1.2 / 15  # edges are rounded
    assert 1 < pace.pixel_px(PIXELS, 1.0) <= 16


def test_draws_wait_no_longer_than_another_would_take(module: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    waits_s = {s: moved(module, monkeypatch, s, 1e-6).wait_s for s in (0.001, 0.02, 0.5)}
    assert waits_s[0.001] == pytest.approx(0.004)
    assert waits_s[0.02] == pytest.approx(0.02, rel=0.05)
    assert waits_s[0.5] == pytest.approx(0.1)


def test_rendering_has_most_of_the_time(module: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    assert moved(module, monkeypatch, 0.001, 1e-6).redraw_s == pytest.approx(0.1)
    assert moved(module, monkeypatch, 0.1, 1e-6).redraw_s == pytest.approx(0.4, rel=0.05)


def test_no_picture_is_finer_than_it_may_be(module: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    pace = moved(module, monkeypatch, 0.002, 1e-10)
    assert pace.pixel_px(PIXELS, 1.0) == 1
    assert pace.pixel_px(PIXELS, 2.0) == 2

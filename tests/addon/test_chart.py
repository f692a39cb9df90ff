"""The chart of speed against accuracy, started as the panel starts it."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Callable
from typing import Any

import pytest


@pytest.fixture(scope="module")
def case(inside: Callable[[str], Any]) -> Any:
    return inside("chart_case")


def test_every_method_is_charted(case: Any) -> None:
    assert case["finished"] == ["FINISHED"]
    assert not case["is_running"]
    assert {row["renderer"] for row in case["rows"]} == {"PIVOT", "CYCLES"}
    assert len({row["method"] for row in case["rows"]}) == 9
    assert all(row["cpu_s"] > 0 and 0 < row["rel_mse"] < 10 for row in case["rows"])


def test_more_samples_cost_more_and_err_less(case: Any) -> None:
    lines = defaultdict(list)
    for row in case["rows"]:
        lines[row["method"]].append(row)
    for method in ("Monte Carlo, joint", "Monte Carlo, SPTD", "Monte Carlo, MIS", "Cycles"):
        few, many = lines[method]
        assert few["samples"] < many["samples"]
        assert few["rel_mse"] > many["rel_mse"]


def test_light_that_bounced_is_charted(case: Any) -> None:
    methods = {row["method"] for row in case["bounced"]}
    virtual = {"Virtual lights", "Virtual lights, by number", "by the formulas of 2024", "by the formulas of 2015"}
    assert methods - {"Monte Carlo, denoised"} == {"Monte Carlo, joint", "Cycles"} | virtual
    assert ("Monte Carlo, denoised" in methods) == case["has_denoiser"]
    assert all(row["bounces"] == 1 and row["rel_mse"] < 10 for row in case["bounced"])


def test_the_chart_is_a_picture(case: Any) -> None:
    width, height = case["size"]
    assert width > height > 400
    assert case["colors"] > 50  # paper, grid, nine lines and the edges of their letters


def test_the_suggestion_is_the_cheapest_and_is_applied(case: Any) -> None:
    within = [row["cpu_s"] for row in case["rows"] if row["renderer"] == "PIVOT" and row["percent"] <= 100]
    assert case["suggestion_cpu_s"] == min(within)
    assert case["applied"] == ["FINISHED"]
    assert case["after"] == case["suggestion"]
    assert not case["suggestion_out_of_reach"]


def test_pictures_are_kept_until_the_scene_or_the_core_that_renders_changes(case: Any) -> None:
    assert case["keyed"] == ["scene.blend", "_core_v3.so"]


def test_a_failure_names_its_cause(case: Any) -> None:
    assert "the chart failed" in case["failure"]
    assert "no camera" in case["failure"].lower()


def test_cancelling_ends_the_other_blender(case: Any) -> None:
    assert case["cancelled"]

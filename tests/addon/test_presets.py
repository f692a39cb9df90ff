"""The Sampling panel's presets set what they say, all of them the same settings, and an artist's own come back."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest

SHIPPED = ("preview", "still", "animation")


@pytest.fixture(scope="module")
def case(inside: Callable[[str], Any]) -> Any:
    return inside("preset_case")


def test_there_is_one_for_each_kind_of_work(case: Any) -> None:
    assert sorted(case["shipped"]) == sorted(SHIPPED)
    preview, still, animation = (case["shipped"][name] for name in SHIPPED)
    assert preview["samples"] < animation["samples"] < still["samples"]
    assert preview["preview_samples"] < animation["preview_samples"] < still["preview_samples"]
    assert still["adaptive"]
    assert still["clamp_indirect"] == still["filter_glossy"] == 0  # unbiased
    assert animation["clamp_indirect"] > 0
    assert not animation["adaptive"]


@pytest.mark.parametrize("name", SHIPPED)
def test_a_preset_leaves_nothing_of_another(case: Any, name: str) -> None:
    assert case["assigned"][name] == case["assigned"]["still"]
    left = case["defaults"].keys() - set(case["assigned"][name])
    assert {key: case["shipped"][name][key] for key in left} == {key: case["defaults"][key] for key in left}


def test_presets_ask_for_a_denoiser_where_there_is_one(case: Any) -> None:
    for settings in case["shipped"].values():
        assert (settings["denoise"] != "NONE") == case["has denoiser"]
    assert case["without denoiser"]["denoise"] == case["without denoiser"]["denoise_viewport"] == "NONE"
    assert case["without denoiser"]["samples"] == case["shipped"]["still"]["samples"]


def test_an_artists_own_comes_back(case: Any) -> None:
    mine, again = case["mine"]
    assert again == mine
    assert case["is gone"]


def test_the_menu_shows_them_all(case: Any) -> None:
    names = [name.title() for name in SHIPPED]
    assert case["listed"] == [names, [*names, "Mine"]]

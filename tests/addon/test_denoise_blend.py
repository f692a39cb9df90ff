"""Noisy and denoised pictures are mixed where each is better, through one pixel filter, without a Blender."""

from __future__ import annotations

import importlib.util
from typing import Any

import numpy as np
import pytest
from blender_host import ROOT

SIZE = 64, 64


def loaded(name: str) -> Any:
    spec = importlib.util.spec_from_file_location(name, ROOT / "addon" / f"{name}.py")
    assert spec
    assert spec.loader
    made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    return made


def variance_px2(weights: Any) -> float:
    offsets = np.arange(len(weights)) - len(weights) // 2
    return float((weights * offsets**2).sum() / weights.sum())


@pytest.mark.parametrize("width_px", [1.0, 3.0, 8.0])
def test_what_is_denoised_is_as_wide_as_the_pixel_filter(width_px: float) -> None:
    place = np.zeros((41, 41, 3), np.float32)
    place[20, 20] = 1
    seen = loaded("denoise_filter").softened(place, width_px)
    assert seen.dtype == np.float32
    assert seen.sum(axis=(0, 1)) == pytest.approx([1, 1, 1], rel=1e-5)
    x = (np.arange(3000) + 0.5) / 3000  # over the filter's width
    harmonics = ((0.35875, 0), (-0.48829, 2), (0.14128, 4), (-0.01168, 6))
    window = sum(weight * np.cos(count * np.pi * x) for weight, count in harmonics)
    of_filter = float((window * (x - 0.5) ** 2).sum() / window.sum()) * width_px**2
    for axis in (0, 1):
        added = variance_px2(seen[..., 0].sum(axis=axis))
        assert added == pytest.approx(max(of_filter - 1 / 12, 0), abs=1e-3 * width_px**2)


@pytest.mark.parametrize("noise", [0.02, 0.05, 0.1])
@pytest.mark.parametrize("part_kept", [0.0, 0.5])
def test_a_denoiser_that_smears_detail_does_no_harm(noise: float, part_kept: float) -> None:
    """part_kept: of the noise, in the denoised picture."""
    blend, random = loaded("denoise_blend"), np.random.default_rng(3)
    light = random.uniform(0.6, 1.4, (*SIZE, 1)).repeat(3, axis=-1).astype(np.float32)
    light[:, SIZE[1] // 2 :] = 1  # which the denoiser finds
    off = noise * random.normal(size=light.shape).astype(np.float32)
    noisy, clean = light + off, np.ones_like(light) + part_kept * off
    told = blend.relative_noise(np.full((*SIZE, 1), noise**2, np.float32), noisy)
    share = blend.share_kept(noisy, clean, told, 0.01**2, noisy)
    mixed, half = share * noisy + (1 - share) * clean, SIZE[1] // 2
    error, error_noisy = (((seen - light) ** 2).mean(axis=(0, 2)) for seen in (mixed, noisy))
    assert error[: half - 4].mean() < 1.01 * error_noisy[: half - 4].mean()
    assert error[half + 4 :].mean() < 0.6 * error_noisy[half + 4 :].mean()

"""Denoise cleans what it says, leaves all else, and without its library a picture is as it was."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np
import OpenEXR
import pytest
from blender_host import Host
from exr import passes_by_name, read_rgb
from numpy.typing import NDArray


@pytest.fixture(scope="module")
def case(host: Host, tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Any]:
    folder = tmp_path_factory.mktemp("denoise")
    return folder, host.run("denoise_cases", folder)


def squared_error(folder: Path, name: str) -> float:
    return float(np.mean((read_rgb(folder / f"{name}.exr") - read_rgb(folder / "converged.exr")) ** 2))


def alpha(folder: Path, name: str) -> NDArray[np.float32]:
    with OpenEXR.File(str(folder / f"{name}.exr"), separate_channels=True) as file:
        return np.array(file.channels()["A"].pixels)


def test_a_blender_that_brings_the_library_has_it(host: Host, case: tuple[Path, Any]) -> None:
    assert case[1]["found"] or not host.kind.startswith("bpy")


@pytest.mark.parametrize("name", ["indirect", "all"])
def test_denoised_pictures_are_nearer_the_converged_one(case: tuple[Path, Any], name: str) -> None:
    folder, result = case
    if not result["found"]:
        assert "scene 'Scene', Denoise: there is no denoiser, noise stays" in result["said"][name][0]
        np.testing.assert_array_equal(read_rgb(folder / f"{name}.exr"), read_rgb(folder / "noisy.exr"))
        return
    assert result["said"][name] == []
    assert squared_error(folder, name) < 0.7 * squared_error(folder, "noisy")
    ratio = read_rgb(folder / f"{name}.exr").mean() / read_rgb(folder / "converged.exr").mean()
    assert abs(ratio - 1) < 0.02
    np.testing.assert_array_equal(alpha(folder, name), alpha(folder, "noisy"))


LIGHT = {
    f"{name} {kind}": f"{name} Color"
    for name in ("Diffuse", "Glossy", "Transmission")
    for kind in ("Direct", "Indirect")
}
OLD_NAMES = {
    f"{short}{kind[:3]}": f"{name} {kind}"
    for short, name in (("Diff", "Diffuse"), ("Gloss", "Glossy"), ("Trans", "Transmission"))
    for kind in ("Direct", "Indirect", "Color")
} | {"Emit": "Emission", "Env": "Environment"}


def light(folder: Path, name: str) -> dict[str, NDArray[np.float32]]:
    """The passes of a picture by Blender 5.0's names, light times its colour."""
    passes = {OLD_NAMES.get(key, key): values for key, values in passes_by_name(folder / f"passes-{name}.exr").items()}
    return passes | {key: passes[key] * passes[color] for key, color in LIGHT.items()}


@pytest.mark.parametrize("name", ["indirect", "all"])
def test_light_passes_sum_to_the_denoised_picture(case: tuple[Path, Any], name: str) -> None:
    passes = light(case[0], name)
    total = passes["Emission"] + passes["Environment"] + sum(passes[key] for key in LIGHT)
    np.testing.assert_allclose(total, passes["Combined"][..., :3], rtol=1e-4, atol=1e-5)


@pytest.mark.parametrize("name", ["indirect", "all"])
def test_parts_of_light_are_nearer_the_converged_ones(case: tuple[Path, Any], name: str) -> None:
    folder, result = case
    if not result["found"]:
        pytest.skip("no Open Image Denoise here")
    denoised, noisy, converged = (light(folder, each) for each in (name, "noisy", "converged"))
    for key in ("Diffuse Indirect", "Indirect", "Combined_key"):
        errors = [float(np.mean((passes[key] - converged[key]) ** 2)) for passes in (denoised, noisy)]
        assert errors[0] < 0.7 * errors[1], key
        assert denoised[key].mean() == pytest.approx(converged[key].mean(), rel=0.03), key
    assert np.all(denoised["Combined"][..., :3] - denoised["Combined_key"] > -1e-5)  # the other lamp's


@pytest.mark.parametrize("name", ["indirect", "all"])
def test_what_is_no_light_stays_as_it_is(case: tuple[Path, Any], name: str) -> None:
    denoised, noisy = (passes_by_name(case[0] / f"passes-{each}.exr") for each in (name, "noisy"))
    np.testing.assert_array_equal(denoised["Combined"][..., 3], noisy["Combined"][..., 3])
    for key in ("Depth", "CryptoObject00"):
        np.testing.assert_array_equal(denoised[key], noisy[key])


@pytest.mark.parametrize("name", ["coarse", "indirect", "fine"])
def test_one_denoiser_cleans_pictures_of_any_size(case: tuple[Path, Any], name: str) -> None:
    if not case[1]["found"]:
        pytest.skip("no Open Image Denoise here")
    *shape, mean, deviation = case[1]["grey"][name]
    assert shape == [47, 65, 4]
    assert mean == pytest.approx(case[1]["grey"]["noisy"][3], rel=0.03)
    assert deviation < 0.4 * case[1]["grey"]["noisy"][4]


def test_direct_light_is_denoised_where_it_is_noisy(case: tuple[Path, Any]) -> None:
    if not case[1]["found"]:
        pytest.skip("no Open Image Denoise here")
    grey = case[1]["grey"]
    assert grey["direct"][4] < 0.4 * grey["noisy"][4]
    assert grey["direct"][3] == pytest.approx(grey["noisy"][3], rel=0.03)
    assert grey["seen"] == grey["noisy"]


def test_without_the_library_noise_stays_and_is_named(case: tuple[Path, Any]) -> None:
    folder, result = case
    (said,) = result["said"]["absent"]
    assert "scene 'Scene', Denoise: there is no denoiser, noise stays. Fix: install Open Image Denoise" in said
    np.testing.assert_array_equal(read_rgb(folder / "absent.exr"), read_rgb(folder / "noisy.exr"))


def test_nobody_who_did_not_ask_hears_of_it(case: tuple[Path, Any]) -> None:
    assert case[1]["said"]["noisy"] == []
    assert not any("denoise" in said.lower() for said in case[1]["said"]["analytic"])


def test_denoising_data_is_blenders(case: tuple[Path, Any]) -> None:
    folder, result = case
    passes = passes_by_name(folder / "data.exr")
    assert result["passes"] == ["Noisy Image", "Denoising Normal", "Denoising Albedo", "Denoising Depth"]
    for name in result["passes"]:
        assert np.any(passes[name] != 0), name
    assert 2 < passes["Denoising Depth"].min() < 4

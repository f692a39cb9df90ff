"""Settings reach the core; the addon leaves nothing behind when it is disabled."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from blender_host import Host


@pytest.fixture(scope="module")
def cases(inside: Callable[[str], Any]) -> Any:
    return inside("addon_cases")


def test_defaults(cases: Any, host: Host) -> None:
    assert cases["defaults"] | {"threads": 0} == {
        "integrator": "MONTE_CARLO",
        "samples": 64,
        "adaptive": False,
        "seed": 0,
        "max_bounces": 4,
        "max_passages": 8,
        "max_path_passages": 9 - (host.version >= (5, 0)),
        "clamp_indirect": 0.0,
        "filter_glossy": 0.0,
        "light_sampling": "JOINT",
        "error_budget_percent": 2.0,
        "analytic_method": "AUTO",
        "occlusion": "RAY_TRACED",
        "indirect": "NONE",
        "virtual_lights": 4096,
        "time_limit_s": 0.0,
        "threads": 0,
        "filter_width_px": 3.0,
        "transparent_film": False,
        "denoising_passes": False,
    }
    assert cases["defaults"]["threads"] >= 1


def test_each_frame_has_noise_of_its_own(cases: Any) -> None:
    seeds = cases["seeds"]
    assert seeds["animated"][0] == 3
    assert seeds["still"] == [3, 3]
    assert len({*seeds["animated"], *seeds["next"]}) == 4


def test_settings(cases: Any, host: Host) -> None:
    assert cases["settings"] == {
        "integrator": "ANALYTIC",
        "samples": 7,
        "adaptive": True,
        "seed": 3,
        "max_bounces": 0,
        "max_passages": 3,
        "max_path_passages": 4 - (host.version >= (5, 0)),
        "clamp_indirect": 2.5,
        "filter_glossy": 1.5,
        "light_sampling": "SPTD",
        "error_budget_percent": 0.5,
        "analytic_method": "LTC",
        "occlusion": "BENT_CONE",
        "indirect": "VSGL",
        "virtual_lights": 256,
        "time_limit_s": 12.0,
        "threads": 3,
        "filter_width_px": 4.0,
        "transparent_film": True,
        "denoising_passes": False,
    }


def test_a_view_layer_may_have_its_own_samples(cases: Any) -> None:
    assert cases["layers"] == 5


def test_disabling_leaves_nothing(cases: Any) -> None:
    left = cases["toggled"]["left"]
    assert left == {
        "settings": False,
        "pass_switches": False,
        "microfacets": False,
        "engine": False,
        "panels": [],
        "opted_in": [],
        "handlers": [],
    }


def test_enabling_again_works(cases: Any) -> None:
    assert cases["toggled"]["again"]["samples"] == 64


def test_built_in_panels_are_opted_in(cases: Any) -> None:
    opted_in = set(cases["toggled"]["opted_in"])
    wanted = {
        "RENDER_PT_format",
        "RENDER_PT_output",
        "DATA_PT_lens",
        "DATA_PT_camera_dof",
        "EEVEE_MATERIAL_PT_surface",
        "EEVEE_MATERIAL_PT_volume",
        "EEVEE_WORLD_PT_volume",
        "DATA_PT_volume_file",
        "WORLD_PT_context_world",
    }
    assert wanted <= opted_in
    assert not {"RENDER_PT_freestyle", "EEVEE_WORLD_PT_mist"} & opted_in

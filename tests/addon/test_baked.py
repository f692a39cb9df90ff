"""What nodes compute within an object is baked to voxels of its bounds."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from blender_host import Host


@pytest.fixture(scope="module")
def cases(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Any:
    return host.run("baked_cases", tmp_path_factory.mktemp("baked"))


@pytest.mark.parametrize("name", ["object", "position", "generated", "color", "random", "noise", "attribute"])
def test_voxels_have_what_nodes_give_there(cases: Any, name: str) -> None:
    """Between voxels too, where it is linear."""
    found, wanted = (np.array(cases[name][key]) for key in ("found", "wanted"))
    tolerance = 1e-4 * max(1.0, wanted.max())
    if name == "position":  # which is taken as 0 where it is negative: not linear there
        clear = wanted > 0.1
        found, wanted = found[clear], wanted[clear]
    elif name in {"object", "generated"}:
        clear = (wanted == 0) | (wanted > 0.05)
        found, wanted = found[clear], wanted[clear]
        tolerance += 0.01 * (wanted == 0)
    assert found.size > 100
    assert np.all(np.abs(found - wanted) <= tolerance)
    assert name == "attribute" or wanted.max() > 0.3
    assert cases[name]["reports"] == []


@pytest.mark.parametrize(
    ("name", "what"),
    [("incoming", "the ray or the camera"), ("camera", "the ray or the camera"), ("particle", "the instance")],
)
def test_what_a_volume_has_not_is_reported(cases: Any, name: str, what: str) -> None:
    text = f"object 'cloud': what depends on {what} is not supported in a volume, which is baked without"
    assert cases[name]["reports"] == [text]

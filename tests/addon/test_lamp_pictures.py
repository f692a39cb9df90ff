"""Pivot and Cycles, in one Blender, agree on lamps whose nodes vary: IES files, falloffs, textures."""

from __future__ import annotations

import pytest
from beside_cycles import assert_alike
from blender_host import Host


def test_pictures_are_cycles(host: Host, tmp_path_factory: pytest.TempPathFactory) -> None:
    folder = tmp_path_factory.mktemp("lamps")
    host.run("lamp_cases", folder)
    assert_alike(folder, "lamps", "MONTE_CARLO")

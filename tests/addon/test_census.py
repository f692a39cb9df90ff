"""Every property of the Blender types that the exporter reads has its row in the census, and each row its property."""

from __future__ import annotations

from typing import Any

import pytest
from blender_host import Host, hosts


@pytest.fixture(scope="module")
def censuses(tmp_path_factory: pytest.TempPathFactory) -> dict[str, Any]:
    """By Blender version."""
    return {str(host): host.run("census_case", tmp_path_factory.mktemp("census")) for host in hosts()}


def test_every_property_is_named(host: Host, censuses: dict[str, Any]) -> None:
    """The fix: a row in addon/export/census, after a look at what the property does to Cycles' picture."""
    assert censuses[str(host)]["unnamed"] == []


def test_every_name_is_a_property(censuses: dict[str, Any]) -> None:
    """Of a Blender at hand, or of the one it is marked with; unmarked names are those of 3.4 and 4.5."""
    has_both = {"3.4", "4.5"} <= set(censuses)
    stale = []
    for kind, names in next(iter(censuses.values()))["entries"].items():
        for name, version in names.items():
            asked = [version] if version else list(censuses) if has_both else []
            there = [name in censuses[each]["there"].get(kind, ()) for each in asked if each in censuses]
            if there and not any(there):
                stale.append(f"{kind}.{name}")
    assert not stale


def test_nothing_is_said_of_what_nobody_changed(host: Host, censuses: dict[str, Any]) -> None:
    assert censuses[str(host)]["factory"] == []


def test_each_property_that_is_left_out_is_said(host: Host, censuses: dict[str, Any]) -> None:
    silent = []
    if host.version < (5, 0):
        silent.append("Object.modifiers")  # none is adaptive: the object is
    assert censuses[str(host)]["silent"] == silent

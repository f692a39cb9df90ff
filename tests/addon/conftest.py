"""Every test here runs once in each Blender the machine has."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import pytest
from blender_host import Host, hosts


@pytest.fixture(scope="module", params=hosts(), ids=str)
def host(request: pytest.FixtureRequest) -> Host:
    return request.param


@pytest.fixture(scope="module")
def inside(host: Host, tmp_path_factory: pytest.TempPathFactory) -> Callable[[str], Any]:
    """Runs a script of inside/ once per test module and host, and returns its result."""
    results: dict[str, Any] = {}

    def run(script: str) -> Any:
        if script not in results:
            results[script] = host.run(script, tmp_path_factory.mktemp(script))
        return results[script]

    return run

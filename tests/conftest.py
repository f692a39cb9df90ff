"""What all tests share: one type promotion, the Blenders at hand, and in which of them pictures are held to Cycles'."""

import platform

import numpy as np
import pytest

from tests.addon.blender_host import hosts

# bpy 4.5 needs NumPy 1, where a float32 scalar by a Python float is float64.
if np.lib.NumpyVersion(np.__version__) < "2.0.0":
    np._set_promotion_state("weak")


def pytest_report_header() -> str:
    blenders = ", ".join(f"{host} ({host.kind})" for host in hosts())
    return f"blender: {blenders or 'none'}; Python {platform.python_version()}, NumPy {np.__version__}"


def pytest_addoption(parser: pytest.Parser) -> None:
    parser.addoption(
        "--every-blender",
        action="store_true",
        help="compare pictures with Cycles' in every Blender here, not only in the oldest and the newest",
    )


def pytest_collection_modifyitems(config: pytest.Config, items: list[pytest.Item]) -> None:
    """Pictures of Cycles take a third of the tests' time, and Blenders in between rarely differ from both ends."""
    if config.getoption("every_blender"):
        return
    between = {str(host) for host in sorted(hosts(), key=lambda host: host.version)[1:-1]}
    left_out = [item for item in items if _compares_with_cycles(item) and _blender(item) in between]
    config.hook.pytest_deselected(items=left_out)
    items[:] = [item for item in items if item not in left_out]


def _compares_with_cycles(item: pytest.Item) -> bool:
    return "cycles" in getattr(item, "originalname", item.name)


def _blender(item: pytest.Item) -> str:
    return str(item.callspec.params.get("host")) if hasattr(item, "callspec") else ""

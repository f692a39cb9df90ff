"""NumPy 2's type promotion throughout: bpy 4.5 needs NumPy 1, where a float32 scalar by a Python float is float64."""

import platform

import numpy as np

from tests.addon.blender_host import hosts

if np.lib.NumpyVersion(np.__version__) < "2.0.0":
    np._set_promotion_state("weak")


def pytest_report_header() -> str:
    blenders = ", ".join(f"{host} ({host.kind})" for host in hosts())
    return f"blender: {blenders or 'none'}; Python {platform.python_version()}, NumPy {np.__version__}"

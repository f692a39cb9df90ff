"""The pixel filters that the benchmarks render by, as settings of each renderer that has them, by its name."""

from __future__ import annotations

from typing import Any

DIRECT_LIGHT = {"max_bounces": 0}  # of Pivot and Cycles

FILTERS: dict[str, dict[str, dict[str, Any]]] = {
    "BLACKMAN_HARRIS": {  # Blender's default, of Filter Size 1.5: addon/settings.py says why the core's is 3
        "pivot": {"filter_width_px": 3.0},
        "cycles": {"pixel_filter_type": "BLACKMAN_HARRIS", "filter_width": 1.5},
    },
    "BOX": {
        "pivot": {"pixel_filter": "BOX", "filter_width_px": 1.0},
        "cycles": {"pixel_filter_type": "BOX"},
        "mitsuba": {},  # made so: see mitsuba_parts.py
    },
}

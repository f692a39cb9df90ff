"""Frames that take alike long and do not flicker: no fireflies, and every pixel has as many samples."""

import bpy

pivot = bpy.context.scene.pivot

pivot.samples = 64
pivot.preview_samples = 16
pivot.adaptive = False
pivot.error_budget = 2.0
pivot.max_bounces = 4
pivot.clamp_indirect = 10.0
pivot.filter_glossy = 1.0
pivot.animate_seed = True
pivot.denoise = "ALL"
pivot.denoise_viewport = "INDIRECT"
pivot.time_limit = 0.0

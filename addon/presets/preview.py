"""A picture to judge light and composition by, in seconds."""

import bpy

pivot = bpy.context.scene.pivot

pivot.samples = 16
pivot.preview_samples = 8
pivot.adaptive = False
pivot.error_budget = 5.0
pivot.max_bounces = 4
pivot.clamp_indirect = 10.0
pivot.filter_glossy = 1.0
pivot.animate_seed = True
pivot.denoise = "INDIRECT"
pivot.denoise_viewport = "INDIRECT"
pivot.time_limit = 0.0

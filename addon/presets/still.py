"""A picture to keep: samples go where noise is, and nothing is blurred or bounded but by the denoiser."""

import bpy

pivot = bpy.context.scene.pivot

pivot.samples = 512
pivot.preview_samples = 64
pivot.adaptive = True
pivot.error_budget = 1.0
pivot.max_bounces = 8
pivot.clamp_indirect = 0.0
pivot.filter_glossy = 0.0
pivot.animate_seed = True
pivot.denoise = "INDIRECT"
pivot.denoise_viewport = "INDIRECT"
pivot.time_limit = 0.0

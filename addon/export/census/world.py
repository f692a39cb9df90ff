"""Worlds."""

from __future__ import annotations

from .table import LeftOut, Table

WORLD = {
    "World": Table(
        used="color node_tree use_nodes mist_settings animation_data lightgroup light_settings",
        parts="cycles cycles_visibility",
        # EEVEE's sun.
        no_meaning="""
        use_eevee_finite_volume probe_resolution sun_threshold sun_angle
        use_sun_shadow sun_shadow_maximum_resolution sun_shadow_filter_radius use_sun_shadow_jitter
        sun_shadow_jitter_overblur
        """,
    ),
    "CyclesWorldSettings": Table(
        used="max_bounces",
        left_out=(LeftOut("use_shadows@5.2", True, "it casts them", what="a world without shadows is"),),
        # How it and its volume are sampled.
        no_meaning="""
        name is_caustics_light sampling_method sample_map_resolution homogeneous_volume volume_sampling
        volume_interpolation volume_step_size
        """,
    ),
    "CyclesVisibilitySettings": Table(
        used="camera diffuse glossy transmission scatter",
        no_meaning="name shadow",
    ),
}

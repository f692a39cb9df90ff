"""Lights."""

from __future__ import annotations

from .table import LeftOut, Table

LIGHT = {
    "Light": Table(
        used="""
        type color energy node_tree use_nodes exposure normalize use_temperature temperature temperature_color
        shadow_soft_size use_soft_falloff spot_size spot_blend angle shape size size_y animation_data use_shadow spread
        """,
        parts="cycles",
        # EEVEE's, and what older Blenders kept from before it.
        no_meaning="""
        distance specular_factor diffuse_factor volume_factor use_custom_distance cutoff_distance falloff_type
        falloff_curve linear_attenuation quadratic_attenuation constant_coefficient linear_coefficient
        quadratic_coefficient shadow_buffer_size shadow_buffer_clip_start shadow_buffer_bias shadow_buffer_samples
        shadow_color use_contact_shadow contact_shadow_distance contact_shadow_bias contact_shadow_thickness use_square
        show_cone shadow_cascade_max_distance shadow_cascade_count shadow_cascade_exponent shadow_cascade_fade
        transmission_factor shadow_filter_radius shadow_maximum_resolution use_shadow_jitter shadow_jitter_overblur
        use_absolute_resolution
        """,
    ),
    "CyclesLightSettings": Table(
        used="is_portal cast_shadow max_bounces",
        left_out=(LeftOut("use_multiple_importance_sampling", True, "mirrors show it all the same"),),
        no_meaning="name is_caustics_light",
    ),
}

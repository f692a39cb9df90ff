"""Materials but for their nodes."""

from __future__ import annotations

from .table import LeftOut, Table

MATERIAL = {
    "Material": Table(
        used="node_tree use_nodes diffuse_color pass_index animation_data use_transparent_shadow",
        parts="cycles",
        # EEVEE's, the viewport's, and how displacement is done, which is reported by the nodes.
        no_meaning="""
        blend_method shadow_method alpha_threshold show_transparent_back use_backface_culling use_screen_refraction
        use_sss_translucency refraction_depth preview_render_type use_preview_world texture_paint_images
        texture_paint_slots paint_active_slot paint_clone_slot specular_color roughness specular_intensity metallic
        line_color line_priority grease_pencil is_grease_pencil lineart surface_render_method displacement_method
        use_transparency_overlap use_backface_culling_shadow use_backface_culling_lightprobe_volume
        use_raytrace_refraction thickness_mode use_thickness_from_shadow
        volume_intersection_method max_vertex_displacement
        """,
    ),
    "CyclesMaterialSettings": Table(
        used="use_transparent_shadow",
        left_out=(LeftOut("volume_interpolation", "LINEAR", "its grids are interpolated linearly"),),
        # How volumes are sampled and stepped through is Pivot's own.
        no_meaning="""
        name sample_as_light homogeneous_volume volume_sampling volume_step_rate
        displacement_method emission_sampling use_bump_map_correction
        """,
    ),
}

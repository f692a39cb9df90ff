"""Objects, their meshes, and what all data-blocks have."""

from __future__ import annotations

from typing import Any

from .table import LeftOut, Table


def _is_not_adaptive(modifiers: Any) -> bool:
    """Adaptive subdivision is the modifier's from Blender 5.0, before that the object's."""
    return not any(getattr(modifier, "use_adaptive_subdivision", False) for modifier in modifiers)


OBJECT = {
    "ID": Table(
        used="name original",
        no_meaning="""
        name_full is_evaluated users use_fake_user use_extra_user is_embedded_data tag is_library_indirect library
        library_weak_reference asset_data override_library preview id_type session_uid is_missing is_runtime_data
        is_editable is_linked_packed@5.0 deep_hash@5.3
        """,
    ),
    "Object": Table(
        used="""
        data type mode material_slots matrix_world hide_render show_instancer_for_render visible_camera visible_diffuse
        visible_glossy visible_transmission visible_volume_scatter visible_shadow is_holdout
        parent parent_type parent_vertices parent_bone use_parent_final_indices parent_bone_head_tail_factor@5.2
        location rotation_quaternion rotation_axis_angle rotation_euler rotation_mode scale
        delta_location delta_rotation_euler delta_rotation_quaternion delta_scale
        matrix_local matrix_basis matrix_parent_inverse modifiers constraints track_axis up_axis
        instance_type instance_collection instance_faces_scale use_instance_faces_scale use_instance_vertices_rotation
        is_instancer is_from_instancer is_from_set active_shape_key active_shape_key_index show_only_shape_key
        use_shape_key_edit_mode animation_data pose field soft_body rigid_body rigid_body_constraint collision
        use_simulation_cache vertex_groups pass_index particle_systems lightgroup is_shadow_catcher
        """,
        parts="light_linking cycles",
        left_out=(
            LeftOut(
                "modifiers", _is_not_adaptive, "it is as fine as its modifier says", what="adaptive subdivision is"
            ),
            LeftOut("shadow_terminator_normal_offset", 0.0, "shadows begin where they do without"),
            LeftOut("shadow_terminator_shading_offset", 0.0, "shadows begin where they do without"),
        ),
        # Colour and raycasts are for nodes that are reported themselves.
        no_meaning="""
        bound_box use_camera_lock_parent active_material active_material_index dimensions lock_location lock_rotation
        lock_rotation_w lock_rotations_4d lock_scale grease_pencil_modifiers shader_effects face_maps empty_display_type
        empty_display_size empty_image_offset image_user empty_image_depth show_empty_image_perspective
        show_empty_image_orthographic show_empty_image_only_axis_aligned use_empty_image_alpha empty_image_side
        add_rest_position_attribute color hide_viewport hide_select show_instancer_for_viewport
        display_type show_bounds display_bounds_type show_name show_axis
        show_texture_space show_wire show_all_edges use_grease_pencil_lights show_transparent show_in_front pose_library
        use_dynamic_topology_sculpting display lineart use_mesh_mirror_x use_mesh_mirror_y use_mesh_mirror_z
        animation_visualization motion_path hide_probe_volume hide_probe_sphere hide_probe_plane selection_sets
        active_selection_set shadow_terminator_geometry_offset hide_surface_pick@5.0 visible_raycast@5.2
        """,
    ),
    "ObjectLightLinking": Table(used="receiver_collection blocker_collection"),
    "CyclesObjectSettings": Table(
        left_out=(
            LeftOut(
                "use_adaptive_subdivision", False, "it is as fine as its modifier says", what="adaptive subdivision is"
            ),
            LeftOut("shadow_terminator_offset", 0.0, "shadows begin where they do without"),
        ),
        used="use_motion_blur use_deform_motion motion_steps",
        # Culling is reported with the scene that turns it on.
        no_meaning="""
        name use_camera_cull use_distance_cull dicing_rate
        shadow_terminator_geometry_offset ao_distance is_caustics_caster is_caustics_receiver
        """,
    ),
    "MaterialSlot": Table(used="material", no_meaning="link slot_index name"),
    "Mesh": Table(
        used="""
        vertices edges loops polygons loop_triangles loop_triangle_polygons attributes uv_layers corner_normals
        use_auto_smooth auto_smooth_angle has_custom_normals shape_keys materials is_editmode animation_data
        """,
        no_meaning="""
        vertex_normals polygon_normals texture_mesh uv_layer_clone uv_layer_clone_index uv_layer_stencil
        uv_layer_stencil_index vertex_colors sculpt_vertex_colors vertex_layers_float vertex_layers_int
        vertex_layers_string polygon_layers_float polygon_layers_int polygon_layers_string face_maps skin_vertices
        vertex_creases edge_creases vertex_paint_masks color_attributes remesh_voxel_size remesh_voxel_adaptivity
        use_remesh_fix_poles use_remesh_preserve_volume use_remesh_preserve_paint_mask
        use_remesh_preserve_sculpt_face_sets use_remesh_preserve_vertex_colors remesh_mode use_mirror_x use_mirror_y
        use_mirror_z use_mirror_vertex_groups has_bevel_weight_edge has_bevel_weight_vertex has_crease_edge
        has_crease_vertex texco_mesh use_auto_texspace use_mirror_topology use_paint_mask use_paint_mask_vertex
        total_vert_sel total_edge_sel total_face_sel auto_texspace texspace_location texspace_size cycles normals_domain
        use_remesh_preserve_attributes use_paint_bone_selection radial_symmetry@5.0
        """,
    ),
    "PointCloud": Table(used="points materials attributes animation_data", no_meaning="color_attributes"),
    "Curves": Table(
        used="curves points position_data curve_offset_data materials attributes animation_data",
        no_meaning="""
        surface surface_uv_map use_mirror_x use_mirror_y use_mirror_z selection_domain use_sculpt_selection
        use_sculpt_collision surface_collision_distance color_attributes normals
        """,
    ),
}

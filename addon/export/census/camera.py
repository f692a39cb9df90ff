"""Cameras."""

from __future__ import annotations

from .table import Table

CAMERA = {
    "Camera": Table(
        used="""
        type sensor_fit sensor_width sensor_height lens lens_unit angle angle_x angle_y shift_x shift_y clip_start
        clip_end animation_data ortho_scale cycles panorama_type fisheye_fov fisheye_lens latitude_min latitude_max
        longitude_min longitude_max fisheye_polynomial_k0 fisheye_polynomial_k1 fisheye_polynomial_k2
        fisheye_polynomial_k3 fisheye_polynomial_k4 central_cylindrical_range_u_min central_cylindrical_range_u_max
        central_cylindrical_range_v_min central_cylindrical_range_v_max central_cylindrical_radius
        """,
        parts="dof stereo",
        # A custom camera ends the render with an error.
        no_meaning="""
        passepartout_alpha display_size show_limits show_mist show_passepartout show_safe_areas
        show_safe_center show_name show_sensor show_background_images show_composition_center
        show_composition_center_diagonal show_composition_thirds show_composition_golden show_composition_golden_tria_a
        show_composition_golden_tria_b show_composition_harmony_tri_a show_composition_harmony_tri_b background_images
        custom_filepath custom_shader custom_mode
        custom_bytecode custom_bytecode_hash cycles_custom composition_guide_color@5.0
        """,
    ),
    "CameraDOFSettings": Table(
        used="""
        use_dof focus_object focus_subtarget focus_distance aperture_fstop aperture_blades aperture_rotation
        aperture_ratio
        """,
    ),
    "CameraStereoData": Table(
        used="convergence_mode convergence_distance interocular_distance pivot use_spherical_stereo",
        no_meaning="use_pole_merge pole_merge_angle_from pole_merge_angle_to",
    ),
}

"""Scenes, view layers and their collections, and the settings of renders."""

from __future__ import annotations

from typing import Any

from .table import LeftOut, Table


def _is_simplified(cycles: Any) -> bool:
    return cycles.id_data.render.use_simplify


def _is_transparent(cycles: Any) -> bool:
    return cycles.id_data.render.film_transparent


def _is_blurred(cycles: Any) -> bool:
    return cycles.id_data.render.use_motion_blur


def _bounce_limit(name: str, default: int, what: str) -> LeftOut:
    """A limit of Cycles' that counts where it is below Blender's default and below Pivot's Max Bounces."""

    def counts(cycles: Any) -> bool:
        return getattr(cycles, name) < min(default, cycles.id_data.pivot.max_bounces)

    return LeftOut(name, lambda _: False, "Pivot's own Max Bounces counts", what, counts)


def _missing_passes(names: str) -> tuple[LeftOut, ...]:
    return tuple(LeftOut(name, False, "the picture lacks it") for name in names.split())


SCENE = {
    "Scene": Table(
        used="""
        camera world view_layers frame_current frame_subframe frame_float frame_current_final objects collection
        background_set animation_data unit_settings rigidbody_world gravity use_gravity
        """,
        parts="render cycles cycles_curves",
        # What is edited, played, composited or stamped, which is Blender's business, and other engines' settings.
        no_meaning="""
        frame_start frame_end frame_step lock_frame_selection_to_range use_preview_range frame_preview_start
        frame_preview_end show_subframe show_keys_from_selected_only use_stamp_note is_nla_tweakmode sync_mode node_tree
        use_nodes sequence_editor keying_sets keying_sets_all tool_settings safe_areas timeline_markers
        transform_orientation_slots cursor use_audio use_audio_scrub audio_doppler_speed audio_doppler_factor
        audio_distance_model audio_volume grease_pencil active_clip view_settings display_settings
        sequencer_colorspace_settings display eevee grease_pencil_settings use_custom_simulation_range
        simulation_frame_start simulation_frame_end hydra time_jump_unit@5.0 time_jump_delta@5.0
        compositing_node_group@5.0 annotation@5.0 allow_preroll@5.2 playback_loop_mode@5.2 wrap_timeline_navigation@5.3
        compositor_effects@5.3
        """,
    ),
    "RenderSettings": Table(
        used="""
        engine resolution_x resolution_y resolution_percentage pixel_aspect_x pixel_aspect_y filter_size
        film_transparent threads threads_mode use_border border_min_x border_min_y border_max_x border_max_y
        use_crop_to_border use_multiview views views_format stereo_views use_persistent_data use_simplify
        simplify_subdivision_render simplify_child_particles_render frame_map_old frame_map_new fps fps_base
        use_motion_blur motion_blur_shutter motion_blur_shutter_curve motion_blur_position
        """,
        # Files, stamps, bakes, the compositor, the sequencer, Freestyle, the viewport and EEVEE.
        no_meaning="""
        image_settings preview_pixel_size ffmpeg dither_intensity use_freestyle
        hair_type hair_subdiv use_high_quality_normals use_placeholder use_overwrite
        use_compositing use_sequencer use_file_extension file_extension is_movie_format use_lock_interface filepath
        use_render_cache bake_type use_bake_selected_to_active use_bake_clear bake_margin bake_margin_type bake_bias
        use_bake_multires use_bake_lores_mesh bake_samples use_bake_user_scale bake_user_scale use_stamp_time
        use_stamp_date use_stamp_frame use_stamp_frame_range use_stamp_camera use_stamp_lens use_stamp_scene
        use_stamp_note use_stamp_marker use_stamp_filename use_stamp_sequencer_strip use_stamp_render_time
        stamp_note_text use_stamp use_stamp_labels metadata_input use_stamp_memory use_stamp_hostname stamp_font_size
        stamp_foreground stamp_background sequencer_gl_preview use_sequencer_override_scene_strip use_single_layer
        has_multiple_engines use_spherical_stereo simplify_subdivision simplify_child_particles simplify_volumes
        simplify_gpencil simplify_gpencil_onplay simplify_gpencil_antialiasing simplify_gpencil_view_fill
        simplify_gpencil_modifier simplify_gpencil_shader_fx simplify_gpencil_tint line_thickness_mode line_thickness
        bake use_simplify_normals compositor_device compositor_precision ppm_factor ppm_base
        compositor_denoise_device compositor_denoise_preview_quality compositor_denoise_final_quality
        use_new_cpu_compositor@4.3 anisotropic_filter@5.2 save_output@5.2 use_texture_cache@5.2
        use_auto_generate_texture_cache@5.2 use_compositor_frames_cache@5.3
        """,
    ),
    "CyclesRenderSettings": Table(
        left_out=(
            LeftOut("sample_clamp_direct", 0.0, "nothing is clamped"),
            LeftOut(
                "sample_clamp_indirect", lambda limit: limit == 0 or limit >= 10, "Pivot's own Clamp Indirect counts"
            ),
            LeftOut("blur_glossy", lambda radius: radius <= 1, "Pivot's own Filter Glossy counts"),
            LeftOut("caustics_reflective", True, "caustics are shown"),
            LeftOut("caustics_refractive", True, "caustics are shown"),
            LeftOut("use_fast_gi", False, "light bounces as it does"),
            LeftOut("film_transparent_glass", False, "it is opaque", when=_is_transparent),
            LeftOut("pixel_filter_type", "BLACKMAN_HARRIS", "it is Blackman-Harris"),
            LeftOut("filter_width", 1.5, "the output's own Filter Size counts", what="Cycles' Filter Width is"),
            _bounce_limit("max_bounces", 12, what="Cycles' Max Bounces is"),
            _bounce_limit("diffuse_bounces", 4, what="Cycles' limit of Diffuse Bounces is"),
            _bounce_limit("glossy_bounces", 4, what="Cycles' limit of Glossy Bounces is"),
            _bounce_limit("transmission_bounces", 12, what="Cycles' limit of Transmission Bounces is"),
            LeftOut("rolling_shutter_type", "NONE", "all is seen at once", "a rolling shutter is", _is_blurred),
            LeftOut("use_camera_cull", False, "nothing is culled", when=_is_simplified),
            LeftOut("use_distance_cull", False, "nothing is culled", when=_is_simplified),
        ),
        used="film_exposure transparent_max_bounces motion_blur_position",
        # Quality and cost, where Pivot has settings of its own, Max Bounces for volumes too; bakes and
        # debugging.
        no_meaning="""
        name device feature_set shading_system preview_pause use_denoising denoiser denoising_prefilter
        denoising_input_passes use_preview_denoising preview_denoiser preview_denoising_prefilter
        preview_denoising_input_passes preview_denoising_start_sample samples preview_samples sample_offset time_limit
        sampling_pattern scrambling_distance preview_scrambling_distance auto_scrambling_distance use_layer_samples
        light_sampling_threshold use_adaptive_sampling adaptive_threshold adaptive_min_samples
        use_preview_adaptive_sampling preview_adaptive_threshold preview_adaptive_min_samples direct_light_sampling_type
        min_light_bounces min_transparent_bounces use_guiding use_deterministic_guiding
        guiding_distribution_type use_surface_guiding surface_guiding_probability use_volume_guiding
        guiding_training_samples volume_guiding_probability use_guiding_direct_light use_guiding_mis_weights
        volume_bounces volume_step_rate volume_preview_step_rate
        volume_max_steps dicing_rate preview_dicing_rate max_subdivisions dicing_camera offscreen_dicing_scale
        film_transparent_roughness seed use_animated_seed debug_bvh_type debug_use_spatial_splits debug_use_hair_bvh
        debug_use_compact_bvh debug_bvh_time_steps bake_type camera_cull_margin distance_cull_margin
        rolling_shutter_duration texture_limit texture_limit_render
        fast_gi_method ao_bounces ao_bounces_render use_auto_tile tile_size debug_use_cpu_avx2 debug_use_cpu_avx
        debug_use_cpu_sse41 debug_use_cpu_sse3 debug_use_cpu_sse2 debug_bvh_layout debug_use_cuda_adaptive_compile
        debug_use_optix_debug denoising_quality denoising_use_gpu preview_denoising_quality preview_denoising_use_gpu
        use_light_tree guiding_directional_sampling_type guiding_roughness_threshold debug_use_cpu_sse42
        use_sample_subset sample_subset_length debug_use_hip_adaptive_compile debug_use_metal_adaptive_compile
        volume_biased@5.0 use_pixel_jitter@5.2 texture_resolution@5.2 texture_resolution_render@5.2
        debug_use_texture_cache_eviction@5.2 debug_texture_cache_preserve_unused@5.2
        preview_denoising_upscale_quality@5.3
        """,
    ),
    "CyclesCurveRenderSettings": Table(used="shape subdivisions", no_meaning="name"),
    "ViewLayer": Table(
        used="""
        name material_override world_override samples use use_solid use_sky layer_collection objects depsgraph
        use_strand use_volumes use_pass_combined use_pass_z use_pass_normal use_pass_position use_pass_diffuse_color
        use_pass_emit
        use_pass_diffuse_direct use_pass_diffuse_indirect use_pass_glossy_direct use_pass_glossy_indirect
        use_pass_glossy_color use_pass_transmission_direct use_pass_transmission_indirect use_pass_transmission_color
        use_pass_cryptomatte_object use_pass_cryptomatte_material use_pass_cryptomatte_asset pass_cryptomatte_depth
        use_pass_environment use_pass_uv use_pass_mist use_pass_object_index use_pass_material_index use_motion_blur
        aovs lightgroups use_pass_ambient_occlusion use_pass_vector
        """,
        parts="cycles",
        left_out=(
            *_missing_passes("""
                use_pass_shadow use_pass_subsurface_direct
                use_pass_subsurface_indirect use_pass_subsurface_color
                """),
        ),
        no_meaning="""
        pass_alpha_threshold eevee active_aov active_aov_index active_lightgroup active_lightgroup_index
        use_pass_cryptomatte_accurate use_ao
        active_layer_collection use_freestyle freestyle_settings has_export_collections use_grease_pencil
        use_pass_grease_pencil
        """,
    ),
    "CyclesRenderLayerSettings": Table(
        used="use_pass_volume_direct use_pass_volume_indirect denoising_store_passes use_pass_shadow_catcher",
        left_out=(
            *_missing_passes("""
                pass_debug_sample_count
                pass_render_time@5.0 use_pass_volume_scatter@5.0 use_pass_volume_transmit@5.0
                use_pass_volume_majorant@5.0 denoising_store_motion_passes@5.3
                """),
        ),
        no_meaning="""
        name use_denoising denoising_pass_follow_reflections@5.2 denoising_pass_use_albedo_roughness_weighting@5.2
        """,
    ),
    "LayerCollection": Table(
        used="exclude children collection hide_viewport holdout indirect_only",
        no_meaning="name is_visible",
    ),
}

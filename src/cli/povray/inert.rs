//! POV-Ray's options that change nothing here, by their names in INI files.

/// Options that change nothing here, because they are about windows, memory and the search for objects, or because a
/// picture does not need them.
pub const WITHOUT_EFFECT: &[&str] = &[
    "bounding",
    "bounding_method",
    "bounding_threshold",
    "bsp_baseaccesscost",
    "bsp_basecost",
    "bsp_childaccesscost",
    "bsp_isectcost",
    "bsp_maxdepth",
    "bsp_misschance",
    "buffer_output",
    "buffer_size",
    "continue_trace",
    "create_continue_trace_log",
    "create_histogram",
    "display",
    "display_gamma",
    "dither",
    "dither_method",
    "draw_vistas",
    "high_reproducibility",
    "histogram_grid_size",
    "histogram_name",
    "histogram_type",
    "jitter",
    "jitter_amount",
    "light_buffer",
    "max_image_buffer_memory",
    "palette",
    "pause_when_done",
    "preview_end_size",
    "preview_start_size",
    "real_time_raytracing",
    "remove_bounds",
    "render_block_size",
    "render_block_step",
    "render_pattern",
    "split_unions",
    "stochastic_seed",
    "test_abort",
    "test_abort_count",
    "video_mode",
    "vista_buffer",
    "warning_level",
];

/// Options that this program has no equal of.
pub const INEFFECTIVE: &[&str] = &[
    "antialias_confidence",
    "antialias_gamma",
    "compression",
    "create_ini",
    "field_render",
    "odd_field",
    "radiosity_file_name",
    "radiosity_from_file",
    "radiosity_to_file",
    "radiosity_vain_pretrace",
];

/// Whether an option changes nothing in any program but POV-Ray.
pub fn is_without_effect(name: &str) -> bool {
    WITHOUT_EFFECT.contains(&name) || name.ends_with("_return")
}

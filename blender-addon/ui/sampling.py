# SPDX-License-Identifier: GPL-3.0-or-later
"""Sampling."""

from bpy.types import Panel

from . import presets
from .base import RenderPanel


class GONIO_RENDER_PT_sampling(RenderPanel, Panel):
    bl_label = "Sampling"

    def draw_settings(self, layout, scene):
        if hasattr(scene, "cycles"):
            layout.operator("gonio.settings_from_cycles", icon="IMPORT")


class GONIO_RENDER_PT_sampling_viewport(RenderPanel, Panel):
    bl_label = "Viewport"
    bl_parent_id = "GONIO_RENDER_PT_sampling"

    def draw_header_preset(self, context):
        presets.GONIO_PT_viewport_sampling_presets.draw_panel_header(self.layout)

    def draw_settings(self, layout, scene):
        settings = scene.gonio
        _noise_threshold(layout, settings, "preview_")
        row = layout.row(align=True)
        row.prop(settings, "preview_samples", text="Max Samples" if settings.use_preview_adaptive_sampling else "Samples")
        if settings.use_preview_adaptive_sampling:
            layout.prop(settings, "preview_adaptive_min_samples", text="Min Samples")
        row = layout.column(heading="Denoise").row(align=True)
        row.prop(settings, "use_preview_denoising", text="")
        start = row.row()
        start.active = settings.use_preview_denoising
        start.prop(settings, "preview_denoising_start_sample")
        layout.prop(settings, "use_preview_direct_light")


class GONIO_RENDER_PT_sampling_render(RenderPanel, Panel):
    bl_label = "Render"
    bl_parent_id = "GONIO_RENDER_PT_sampling"

    def draw_header_preset(self, context):
        presets.GONIO_PT_sampling_presets.draw_panel_header(self.layout)

    def draw_settings(self, layout, scene):
        settings = scene.gonio
        _noise_threshold(layout, settings, "")
        layout.prop(settings, "samples", text="Max Samples" if settings.use_adaptive_sampling else "Samples")
        if settings.use_adaptive_sampling:
            layout.prop(settings, "adaptive_min_samples", text="Min Samples")
        layout.prop(settings, "time_limit")
        layout.prop(settings, "use_denoising")


class GONIO_RENDER_PT_sampling_path_guiding(RenderPanel, Panel):
    bl_label = "Path Guiding"
    bl_parent_id = "GONIO_RENDER_PT_sampling"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        layout.prop(scene.gonio, "guiding", text="Use Path Guiding")


class GONIO_RENDER_PT_sampling_advanced(RenderPanel, Panel):
    bl_label = "Advanced"
    bl_parent_id = "GONIO_RENDER_PT_sampling"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        layout.prop(scene.gonio, "spectral")
        layout.operator("gonio.render_by_wavelength", icon="COLOR")
        row = layout.row(align=True)
        row.prop(scene.gonio, "seed")
        row.prop(scene.gonio, "use_animated_seed", text="", icon="TIME")
        subset = layout.column(heading="Sample Subset").row(align=True)
        subset.prop(scene.gonio, "use_sample_subset", text="")
        values = subset.row(align=True)
        values.active = scene.gonio.use_sample_subset
        values.prop(scene.gonio, "sample_offset", text="Offset")
        values.prop(scene.gonio, "sample_subset_length", text="Length")


def _noise_threshold(layout, settings, prefix: str) -> None:
    switch = f"use_{prefix}adaptive_sampling"
    row = layout.column(heading="Noise Threshold").row(align=True)
    row.prop(settings, switch, text="")
    value = row.row()
    value.active = getattr(settings, switch)
    value.prop(settings, f"{prefix}adaptive_threshold", text="")


PANELS = (
    GONIO_RENDER_PT_sampling,
    GONIO_RENDER_PT_sampling_viewport,
    GONIO_RENDER_PT_sampling_render,
    GONIO_RENDER_PT_sampling_path_guiding,
    GONIO_RENDER_PT_sampling_advanced,
)

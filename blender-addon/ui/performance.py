# SPDX-License-Identifier: GPL-3.0-or-later
"""Performance."""

from bl_ui.properties_render import CompositorDenoisePerformanceButtonsPanel, CompositorPerformanceButtonsPanel
from bpy.types import Panel

from . import presets
from .base import GonioPanel, RenderPanel


class GONIO_RENDER_PT_performance(RenderPanel, Panel):
    bl_label = "Performance"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header_preset(self, context):
        presets.GONIO_PT_performance_presets.draw_panel_header(self.layout)


class GONIO_RENDER_PT_performance_threads(RenderPanel, Panel):
    bl_label = "Threads"
    bl_parent_id = "GONIO_RENDER_PT_performance"

    def draw_settings(self, layout, scene):
        render = scene.render
        layout.prop(render, "threads_mode")
        number = layout.column()
        number.enabled = render.threads_mode == "FIXED"
        number.prop(render, "threads")


class GONIO_RENDER_PT_performance_textures(RenderPanel, Panel):
    bl_label = "Textures"
    bl_parent_id = "GONIO_RENDER_PT_performance"

    def draw_settings(self, layout, scene):
        layout.prop(scene.gonio, "texture_memory")
        folder = layout.column()
        folder.enabled = scene.gonio.texture_memory > 0
        folder.prop(scene.gonio, "texture_cache")


class GONIO_RENDER_PT_performance_final(RenderPanel, Panel):
    bl_label = "Final Render"
    bl_parent_id = "GONIO_RENDER_PT_performance"

    def draw_settings(self, layout, scene):
        layout.prop(scene.render, "use_persistent_data", text="Persistent Data")


class GONIO_RENDER_PT_performance_viewport(RenderPanel, Panel):
    bl_label = "Viewport"
    bl_parent_id = "GONIO_RENDER_PT_performance"

    def draw_settings(self, layout, scene):
        layout.prop(scene.render, "preview_pixel_size", text="Pixel Size")
        layout.prop(scene.gonio, "preview_navigation_resolution", text="While Navigating")


class GONIO_RENDER_PT_performance_compositor(GonioPanel, CompositorPerformanceButtonsPanel, Panel):
    bl_context = "render"
    bl_parent_id = "GONIO_RENDER_PT_performance"
    bl_options = {"DEFAULT_CLOSED"}


class GONIO_RENDER_PT_performance_compositor_denoise(GonioPanel, CompositorDenoisePerformanceButtonsPanel, Panel):
    bl_context = "render"
    bl_parent_id = "GONIO_RENDER_PT_performance_compositor"
    bl_options = {"DEFAULT_CLOSED"}


PANELS = (
    GONIO_RENDER_PT_performance,
    GONIO_RENDER_PT_performance_threads,
    GONIO_RENDER_PT_performance_textures,
    GONIO_RENDER_PT_performance_final,
    GONIO_RENDER_PT_performance_viewport,
    GONIO_RENDER_PT_performance_compositor,
    GONIO_RENDER_PT_performance_compositor_denoise,
)

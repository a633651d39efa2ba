# SPDX-License-Identifier: GPL-3.0-or-later
"""Light paths."""

from bpy.types import Panel

from . import presets
from .base import RenderPanel


class GONIO_RENDER_PT_light_paths(RenderPanel, Panel):
    bl_label = "Light Paths"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header_preset(self, context):
        presets.GONIO_PT_light_paths_presets.draw_panel_header(self.layout)


class GONIO_RENDER_PT_light_paths_max_bounces(RenderPanel, Panel):
    bl_label = "Max Bounces"
    bl_parent_id = "GONIO_RENDER_PT_light_paths"

    def draw_settings(self, layout, scene):
        settings = scene.gonio
        layout.column().prop(settings, "max_bounces", text="Total")
        lobes = layout.column(align=True)
        lobes.prop(settings, "diffuse_bounces", text="Diffuse")
        lobes.prop(settings, "glossy_bounces", text="Glossy")
        lobes.prop(settings, "transmission_bounces", text="Transmission")
        lobes.prop(settings, "volume_bounces", text="Volume")
        layout.column().prop(settings, "transparent_max_bounces", text="Transparent")


class GONIO_RENDER_PT_light_paths_clamping(RenderPanel, Panel):
    bl_label = "Clamping"
    bl_parent_id = "GONIO_RENDER_PT_light_paths"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        column = layout.column(align=True)
        column.prop(scene.gonio, "clamp_direct", text="Direct Light")
        column.prop(scene.gonio, "clamp_indirect", text="Indirect Light")


class GONIO_RENDER_PT_light_paths_caustics(RenderPanel, Panel):
    bl_label = "Caustics"
    bl_parent_id = "GONIO_RENDER_PT_light_paths"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        layout.prop(scene.gonio, "caustics", text="Light Paths")
        column = layout.column(heading="Caustics")
        column.prop(scene.gonio, "caustics_reflective", text="Reflective")
        column.prop(scene.gonio, "caustics_refractive", text="Refractive")


PANELS = (
    GONIO_RENDER_PT_light_paths,
    GONIO_RENDER_PT_light_paths_max_bounces,
    GONIO_RENDER_PT_light_paths_clamping,
    GONIO_RENDER_PT_light_paths_caustics,
)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Coarser geometry for a quick look; Blender itself applies it."""

from bpy.types import Panel

from .base import RenderPanel


class GONIO_RENDER_PT_simplify(RenderPanel, Panel):
    bl_label = "Simplify"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_simplify", text="")

    def draw_settings(self, layout, scene):
        render = scene.render
        layout.active = render.use_simplify
        viewport = layout.column(heading="Viewport")
        viewport.prop(render, "simplify_subdivision", text="Max Subdivision")
        viewport.prop(render, "simplify_child_particles", text="Child Particles")
        final = layout.column(heading="Render")
        final.prop(render, "simplify_subdivision_render", text="Max Subdivision")
        final.prop(render, "simplify_child_particles_render", text="Child Particles")


PANELS = (GONIO_RENDER_PT_simplify,)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The world."""

from bpy.types import Panel

from .base import GonioPanel, draw_shader


class WorldPanel(GonioPanel):
    """A panel of the world tab."""

    bl_context = "world"

    @classmethod
    def poll(cls, context):
        return context.world is not None and super().poll(context)


class GONIO_WORLD_PT_preview(WorldPanel, Panel):
    bl_label = "Preview"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.template_preview(context.world)


class GONIO_WORLD_PT_surface(WorldPanel, Panel):
    bl_label = "Surface"

    def draw(self, context):
        self.layout.use_property_split = True
        if not draw_shader(self.layout, context.world, "OUTPUT_WORLD", "Surface"):
            self.layout.prop(context.world, "color")


class GONIO_WORLD_PT_mist(WorldPanel, Panel):
    bl_label = "Mist Pass"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        mist = context.world.mist_settings
        column = self.layout.column(align=True)
        column.prop(mist, "start")
        column.prop(mist, "depth")
        self.layout.prop(mist, "falloff")


PANELS = (GONIO_WORLD_PT_preview, GONIO_WORLD_PT_surface, GONIO_WORLD_PT_mist)

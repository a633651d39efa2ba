# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume objects."""

from bpy.types import Panel

from .base import GonioPanel


class GONIO_DATA_PT_volume_render(GonioPanel, Panel):
    bl_label = "Render"
    bl_context = "data"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.volume is not None and super().poll(context)

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(context.volume.render, "space")


PANELS = (GONIO_DATA_PT_volume_render,)

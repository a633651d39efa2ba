# SPDX-License-Identifier: GPL-3.0-or-later
"""What hair looks like: Cycles' own setting, which files bring along."""

from bpy.types import Panel

from .base import RenderPanel


class GONIO_RENDER_PT_curves(RenderPanel, Panel):
    bl_label = "Curves"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        # Without Cycles curves are ribbons.
        return hasattr(context.scene, "cycles_curves") and super().poll(context)

    def draw_settings(self, layout, scene):
        layout.prop(scene.cycles_curves, "shape", text="Shape")


PANELS = (GONIO_RENDER_PT_curves,)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Adaptive subdivision: Cycles keeps its settings; Blender shows the modifier's to Cycles alone."""

import bpy
from bpy.types import Panel

from .base import GonioPanel, RenderPanel


class GONIO_RENDER_PT_subdivision(RenderPanel, Panel):
    bl_label = "Subdivision"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and hasattr(context.scene, "cycles")

    def draw_settings(self, layout, scene):
        cycles = scene.cycles
        if bpy.app.version < (5, 0, 0):
            # Adaptive subdivision was one of Cycles' experiments.
            layout.prop(cycles, "feature_set")
        rates = layout.column(align=True)
        rates.prop(cycles, "dicing_rate", text="Dicing Rate Render")
        rates.prop(cycles, "preview_dicing_rate", text="Viewport")
        layout.prop(cycles, "max_subdivisions")


class GONIO_OBJECT_PT_adaptive_subdivision(GonioPanel, Panel):
    bl_label = "Adaptive Subdivision"
    bl_context = "modifier"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and _modifier(context.object) is not None and hasattr(context.scene, "cycles")

    def draw_header(self, context):
        owner = _owner(context.object)
        self.layout.prop(owner, "use_adaptive_subdivision", text="")

    def draw(self, context):
        layout, owner = self.layout, _owner(context.object)
        layout.use_property_split = True
        layout.active = owner.use_adaptive_subdivision
        if bpy.app.version < (5, 0, 0):
            layout.prop(owner, "dicing_rate")
            if context.scene.cycles.feature_set != "EXPERIMENTAL":
                layout.label(text="Wants the experimental feature set of the Subdivision panel", icon="INFO")
            return
        layout.prop(owner, "adaptive_space")
        layout.prop(owner, "adaptive_object_edge_length" if owner.adaptive_space == "OBJECT" else "adaptive_pixel_size")


def _modifier(thing):
    """The modifier that can subdivide adaptively: the last one."""
    last = thing.modifiers[-1] if thing is not None and thing.type == "MESH" and thing.modifiers else None
    return last if last is not None and last.type == "SUBSURF" else None


def _owner(thing):
    """What has the object's settings: since 5.0 the modifier."""
    return _modifier(thing) if bpy.app.version >= (5, 0, 0) else thing.cycles


PANELS = (GONIO_RENDER_PT_subdivision, GONIO_OBJECT_PT_adaptive_subdivision)

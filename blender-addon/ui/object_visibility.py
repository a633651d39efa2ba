# SPDX-License-Identifier: GPL-3.0-or-later
"""Which rays see an object; hangs below Blender's own panel."""

from bpy.types import Panel

from .base import GonioPanel

GEOMETRY = {"MESH", "CURVE", "SURFACE", "FONT", "META", "LIGHT", "CURVES", "POINTCLOUD", "EMPTY"}


class GONIO_OBJECT_PT_ray_visibility(GonioPanel, Panel):
    bl_label = "Ray Visibility"
    bl_context = "object"
    bl_parent_id = "OBJECT_PT_visibility"

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type in GEOMETRY and super().poll(context)

    def draw(self, context):
        layout, seen = self.layout, context.object
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(heading="Seen by")
        column.prop(seen, "visible_camera", text="Camera")
        column.prop(seen, "visible_diffuse", text="Diffuse")
        column.prop(seen, "visible_glossy", text="Glossy")
        column.prop(seen, "visible_transmission", text="Transmission")
        column.prop(seen, "visible_volume_scatter", text="Volume Scatter")
        if seen.type != "LIGHT":
            column.prop(seen, "visible_shadow", text="Shadow")
            column = layout.column(heading="Mask")
            column.prop(seen, "is_shadow_catcher")
            column.prop(seen, "is_holdout")


PANELS = (GONIO_OBJECT_PT_ray_visibility,)

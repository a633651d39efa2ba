# SPDX-License-Identifier: GPL-3.0-or-later
"""When the shutter is open, and what is blurred: Blender's and Cycles' own settings, which files bring along."""

from bpy.types import Panel

from .base import GonioPanel, RenderPanel

# Kinds of objects that may have places of their own while the shutter is open, and those whose form may change too.
MOVING = {"MESH", "CURVE", "SURFACE", "FONT", "META", "CURVES", "POINTCLOUD", "LIGHT", "CAMERA", "EMPTY"}
CHANGING = {"MESH", "CURVE", "SURFACE", "FONT", "META"}
PRESETS = (
    ("SMOOTH", "SMOOTHCURVE"),
    ("ROUND", "SPHERECURVE"),
    ("ROOT", "ROOTCURVE"),
    ("SHARP", "SHARPCURVE"),
    ("LINE", "LINCURVE"),
    ("MAX", "NOCURVE"),
)


class GONIO_RENDER_PT_motion_blur(RenderPanel, Panel):
    bl_label = "Motion Blur"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "use_motion_blur", text="")

    def draw_settings(self, layout, scene):
        layout.active = scene.render.use_motion_blur
        layout.prop(scene.render, "motion_blur_position", text="Position")
        layout.prop(scene.render, "motion_blur_shutter")
        cycles = getattr(scene, "cycles", None)
        if cycles is not None:
            layout.prop(cycles, "rolling_shutter_type", text="Rolling Shutter")
            row = layout.row()
            row.active = cycles.rolling_shutter_type != "NONE"
            row.prop(cycles, "rolling_shutter_duration")


class GONIO_RENDER_PT_motion_blur_curve(RenderPanel, Panel):
    bl_label = "Shutter Curve"
    bl_parent_id = "GONIO_RENDER_PT_motion_blur"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        layout.active = scene.render.use_motion_blur
        layout.template_curve_mapping(scene.render, "motion_blur_shutter_curve")
        row = layout.row(align=True)
        for shape, icon in PRESETS:
            row.operator("render.shutter_curve_preset", icon=icon, text="").shape = shape


class GONIO_OBJECT_PT_motion_blur(GonioPanel, Panel):
    bl_label = "Motion Blur"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        # The settings of objects are Cycles', where it is switched on; without it everything that moves is blurred.
        seen = context.object
        return seen is not None and seen.type in MOVING and hasattr(seen, "cycles") and super().poll(context)

    def draw_header(self, context):
        self.layout.active = context.scene.render.use_motion_blur
        self.layout.prop(context.object.cycles, "use_motion_blur", text="")

    def draw(self, context):
        layout, seen = self.layout, context.object
        layout.use_property_split = True
        layout.active = context.scene.render.use_motion_blur and seen.cycles.use_motion_blur
        layout.prop(seen.cycles, "motion_steps", text="Steps")
        if seen.type in CHANGING:
            layout.prop(seen.cycles, "use_deform_motion", text="Deformation")


PANELS = (GONIO_RENDER_PT_motion_blur, GONIO_RENDER_PT_motion_blur_curve, GONIO_OBJECT_PT_motion_blur)

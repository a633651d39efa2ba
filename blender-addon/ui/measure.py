# SPDX-License-Identifier: GPL-3.0-or-later
"""Meters, calculation grids and false colour."""

from bpy.types import Panel

from .. import measuring
from .base import ENGINE, GonioPanel, RenderPanel


class GONIO_VIEW3D_PT_measure(Panel):
    bl_label = "Measure"
    bl_space_type = "VIEW_3D"
    bl_region_type = "UI"
    bl_category = "Gonio"

    @classmethod
    def poll(cls, context):
        return context.engine == ENGINE

    def draw(self, context):
        layout, settings = self.layout, context.scene.gonio
        layout.operator("gonio.point_meter", icon="EYEDROPPER")
        _lines(layout, measuring.latest.point)
        layout.operator("gonio.measure_grids", icon="MESH_GRID")
        for name, reading in measuring.latest.grids.items():
            layout.label(text=name, icon="OBJECT_DATA")
            _lines(layout, measuring.grid_lines(reading))
        layout.operator("gonio.annual_daylight", icon="LIGHT_SUN")
        for name, lines in measuring.latest.years.items():
            layout.label(text=name, icon="OBJECT_DATA")
            _lines(layout, lines)
        layout.operator("gonio.dim_lights", icon="LIGHT_DATA")
        _lines(layout, measuring.latest.levels)
        layout.operator("gonio.measure_luminaire", icon="OUTLINER_OB_LIGHT")
        _lines(layout, measuring.latest.luminaire)
        layout.operator("gonio.illumination_map", icon="TEXTURE")
        _lines(layout, measuring.latest.maps)
        column = layout.column(heading="False Color")
        column.prop(settings, "display", text="")
        scale = column.column()
        scale.active = settings.display != "COLOR"
        scale.prop(settings, "false_color_max")
        scale.prop(settings, "false_color_steps")
        scale.prop(settings, "use_false_color_contours")


class GONIO_RENDER_PT_false_color(RenderPanel, Panel):
    bl_label = "False Color"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        layout.prop(scene.gonio, "display")
        layout.prop(scene.gonio, "false_color_max")
        layout.prop(scene.gonio, "false_color_steps")
        layout.prop(scene.gonio, "use_false_color_contours")


class GONIO_OBJECT_PT_grid(GonioPanel, Panel):
    bl_label = "Calculation Grid"
    bl_context = "object"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.object is not None and context.object.type == "MESH" and super().poll(context)

    def draw_header(self, context):
        self.layout.prop(context.object.gonio, "is_grid", text="")

    def draw(self, context):
        layout, settings = self.layout, context.object.gonio
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.active = settings.is_grid
        of_eyes = ("grid_eyes",) if settings.grid_quantity in measuring.OF_EYES else ()
        for name in ("grid_quantity", *of_eyes, "grid_spacing", "grid_margin", "grid_height", "is_grid_only"):
            layout.prop(settings, name)
        layout.operator("gonio.measure_grids", icon="MESH_GRID")
        reading = measuring.latest.grids.get(context.object.name)
        if reading is not None:
            _lines(layout, measuring.grid_lines(reading))


def _lines(layout, lines) -> None:
    box = layout.box().column(align=True) if lines else None
    for line in lines:
        box.label(text=line)


PANELS = (GONIO_VIEW3D_PT_measure, GONIO_RENDER_PT_false_color, GONIO_OBJECT_PT_grid)

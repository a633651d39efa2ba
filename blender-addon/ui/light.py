# SPDX-License-Identifier: GPL-3.0-or-later
"""Lights."""

from bpy.types import Panel

from .base import GonioPanel, draw_shader


class LightPanel(GonioPanel):
    """A panel of a light's data tab."""

    bl_context = "data"

    @classmethod
    def poll(cls, context):
        return context.light is not None and super().poll(context)

    def draw(self, context):
        self.layout.use_property_split = True
        self.draw_light(self.layout, context.light)


class GONIO_LIGHT_PT_light(LightPanel, Panel):
    bl_label = "Light"

    def draw_light(self, layout, light):
        row = layout.row()
        row.use_property_split = False
        row.prop(light, "type", expand=True)
        if light.type == "AREA" and light.gonio.is_portal:
            layout.label(text="A portal gives no light of its own", icon="INFO")
        else:
            _draw_colour(layout, light)
            column = layout.column()
            column.active = not light.gonio.use_photometry
            column.prop(light, "energy")
            column.prop(light, "exposure")
            column.prop(light, "normalize")
        layout.separator()
        _draw_shape(layout.column(), light)


def _draw_colour(layout, light) -> None:
    row = layout.column(heading="Temperature").row(align=True)
    row.use_property_decorate = False
    row.prop(light, "use_temperature", text="")
    kelvin = row.row()
    kelvin.active = light.use_temperature
    kelvin.prop(light, "temperature", text="")
    row.prop_decorator(light, "temperature")
    layout.prop(light, "color", text="Tint" if light.use_temperature else "Color")


def _draw_shape(column, light) -> None:
    if light.type in ("POINT", "SPOT"):
        column.prop(light, "use_soft_falloff")
        column.prop(light, "shadow_soft_size", text="Radius")
    elif light.type == "SUN":
        column.prop(light, "angle")
    elif light.shape in ("SQUARE", "DISK"):
        column.prop(light, "shape")
        column.prop(light, "size")
    else:
        column.prop(light, "shape")
        sides = column.column(align=True)
        sides.prop(light, "size", text="Size X")
        sides.prop(light, "size_y", text="Y")


class GONIO_LIGHT_PT_beam_shape(LightPanel, Panel):
    bl_label = "Beam Shape"
    bl_parent_id = "GONIO_LIGHT_PT_light"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.light.type in ("SPOT", "AREA")

    def draw_light(self, layout, light):
        column = layout.column()
        if light.type == "SPOT":
            column.prop(light, "spot_size", text="Angle")
            column.prop(light, "spot_blend", text="Blend", slider=True)
            column.prop(light, "show_cone")
        else:
            column.prop(light, "spread")


class GONIO_LIGHT_PT_settings(LightPanel, Panel):
    bl_label = "Settings"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_light(self, layout, light):
        column = layout.column()
        shadow = column.column()
        shadow.active = not light.gonio.is_portal
        shadow.prop(light, "use_shadow", text="Cast Shadow")
        if light.type == "AREA":
            column.prop(light.gonio, "is_portal")


class GONIO_LIGHT_PT_nodes(LightPanel, Panel):
    bl_label = "Nodes"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and not (context.light.type == "AREA" and context.light.gonio.is_portal)

    def draw_light(self, layout, light):
        if not light.use_nodes:
            layout.prop(light, "use_nodes", icon="NODETREE")
        else:
            draw_shader(layout, light, "OUTPUT_LIGHT", "Surface")


PANELS = (GONIO_LIGHT_PT_light, GONIO_LIGHT_PT_beam_shape, GONIO_LIGHT_PT_settings, GONIO_LIGHT_PT_nodes)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Lights."""

import gonio
from bpy.types import Panel

from .. import luminaire
from . import polar_picture
from .base import GonioPanel, draw_shader

# Height of the polar diagram in rows of the panel.
DIAGRAM_ROWS = 9.0


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


class GONIO_LIGHT_PT_photometry(LightPanel, Panel):
    bl_label = "Photometry"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and not (context.light.type == "AREA" and context.light.gonio.is_portal)

    def draw_header(self, context):
        self.layout.prop(context.light.gonio, "use_photometry", text="")

    def draw_light(self, layout, light):
        settings = light.gonio
        layout.active = settings.use_photometry
        _draw_strength(layout.column(align=True), light)
        if light.type != "SUN":
            _draw_luminaire(layout, light)
        factors = layout.column(align=True)
        factors.prop(settings, "dimming")
        factors.prop(settings, "maintenance")


def _draw_strength(column, light) -> None:
    settings = light.gonio
    column.prop(settings, "unit")
    if settings.unit != "FILE":
        column.prop(settings, "quantity", text="Strength")
    if settings.unit == "LUX" and light.type != "SUN":
        column.prop(settings, "distance")
    if settings.use_photometry:
        problem = _problem(light)
        if problem:
            column.label(text=problem, icon="ERROR")


def _problem(light) -> str:
    """What keeps a light's unit from meaning anything."""
    settings = light.gonio
    if light.type == "SUN":
        return "" if settings.unit in ("LUX", "NIT") else "A sun takes lx or cd/m²"
    if settings.unit in ("FILE", "LAMP_LUMEN") and not settings.file:
        return "This takes a luminaire's file"
    is_point = settings.opening == "POINT" if settings.file else light.type != "AREA" and light.shadow_soft_size <= 0.0
    return "A point has no luminance" if settings.unit == "NIT" and is_point else ""


def _draw_luminaire(layout, light) -> None:
    settings = light.gonio
    column = layout.column()
    column.prop(settings, "file")
    if not settings.file:
        return
    column.prop(settings, "opening")
    column.prop(settings, "rotation")
    if not settings.use_photometry:
        return
    try:
        found = luminaire.figures(light)
        icon = polar_picture.icon_of(light)
    except (OSError, gonio.Error) as problem:
        column.label(text=str(problem), icon="ERROR")
        return
    box = layout.box()
    row = box.row()
    row.alignment = "CENTER"
    row.template_icon(icon_value=icon, scale=DIAGRAM_ROWS)
    words = box.column(align=True)
    for line in _figures(found):
        words.label(text=line)


def _figures(found) -> list[str]:
    """A luminaire's figures in words."""
    lines = [found["luminaire"]] if found["luminaire"] else []
    power = f", {found['watts']:g} W, {found['efficacy_lm_per_w']:.0f} lm/W" if found["watts"] else ""
    lines.append(f"{found['flux_lm']:,.0f} lm, {100.0 * found['downward_fraction']:.0f} % down{power}")
    lines.append(f"Peak {found['peak_cd']:,.0f} cd, beam {found['beam_angle_deg'][0]:.0f}° × {found['beam_angle_deg'][1]:.0f}°")
    lamps = " ".join(text for text in (found["lamps"], found["colour"]) if text)
    if lamps or found["lamp_flux_lm"]:
        flux = f"{found['lamp_flux_lm']:,.0f} lm" if found["lamp_flux_lm"] else ""
        lines.append("Lamps " + " ".join(text for text in (lamps, flux) if text))
    return lines


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


PANELS = (GONIO_LIGHT_PT_light, GONIO_LIGHT_PT_photometry, GONIO_LIGHT_PT_beam_shape, GONIO_LIGHT_PT_settings, GONIO_LIGHT_PT_nodes)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Photometry of a light: its quantity, its luminaire's file with the polar diagram, dimming and maintenance."""

import gonio
from bpy.types import Panel

from .. import luminaire
from . import polar_picture
from .light import LightPanel

# Height of the polar diagram in rows of the panel.
DIAGRAM_ROWS = 9.0


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
        if light.type == "AREA":
            layout.prop(settings, "is_tube")
        elif light.type != "SUN":
            layout.prop(settings, "cosine_power")
        if light.type != "SUN":
            _draw_luminaire(layout, light)
        layout.prop(settings, "spectrum")
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
        # Either may be what the file has not.
        column.prop(settings, "lamp_set")
        column.prop(settings, "tilt")
        column.label(text=str(problem), icon="ERROR")
        return
    if found["lamp_sets"] > 1:
        column.prop(settings, "lamp_set")
    if found["has_tilt"]:
        column.prop(settings, "tilt")
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
    lines.append(f"{found['flux_lm']:,.0f} lm, {100.0 * found['downward_fraction']:.0f} % of it down")
    if found["watts"]:
        lines.append(f"{found['watts']:g} W, {found['efficacy_lm_per_w']:.0f} lm/W")
    lines.append(f"Peak {found['peak_cd']:,.0f} cd, beam {found['beam_angle_deg'][0]:.0f}° × {found['beam_angle_deg'][1]:.0f}°")
    lamps = " ".join(text for text in (found["lamps"], found["colour"]) if text)
    if lamps or found["lamp_flux_lm"]:
        flux = f"{found['lamp_flux_lm']:,.0f} lm" if found["lamp_flux_lm"] else ""
        lines.append("Lamps " + " ".join(text for text in (lamps, flux) if text))
    return lines


PANELS = (GONIO_LIGHT_PT_photometry,)

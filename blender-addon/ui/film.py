# SPDX-License-Identifier: GPL-3.0-or-later
"""The film."""

from bpy.types import Panel

from ..operators.standard_view import is_standard
from .base import RenderPanel


class GONIO_RENDER_PT_film(RenderPanel, Panel):
    bl_label = "Film"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        layout.prop(scene.gonio, "film_exposure")


class GONIO_RENDER_PT_film_transparency(RenderPanel, Panel):
    bl_label = "Transparent"
    bl_parent_id = "GONIO_RENDER_PT_film"

    def draw_header(self, context):
        self.layout.prop(context.scene.render, "film_transparent", text="")

    def draw_settings(self, layout, scene):
        layout.active = scene.render.film_transparent
        layout.prop(scene.gonio, "shown_transparent_glass")
        row = layout.row()
        row.active = scene.gonio.shown_transparent_glass
        row.prop(scene.gonio, "shown_transparent_roughness")


class GONIO_RENDER_PT_film_pixel_filter(RenderPanel, Panel):
    bl_label = "Pixel Filter"
    bl_parent_id = "GONIO_RENDER_PT_film"

    def draw_settings(self, layout, scene):
        layout.prop(scene.gonio, "pixel_filter_type", text="Type")
        if scene.gonio.pixel_filter_type != "BOX":
            layout.prop(scene.gonio, "filter_width", text="Width")


class GONIO_RENDER_PT_film_tone_mapping(RenderPanel, Panel):
    bl_label = "Tone Mapping"
    bl_parent_id = "GONIO_RENDER_PT_film"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        settings = scene.gonio
        layout.prop(settings, "tone_map", text="Operator")
        if settings.tone_map == "EV100":
            layout.prop(settings, "tone_map_ev100")
        elif settings.tone_map != "NONE":
            layout.prop(settings, "tone_map_white")
        if settings.tone_map != "NONE" and not is_standard(scene.view_settings):
            layout.label(text="The view transform maps the picture again", icon="ERROR")
            layout.operator("gonio.use_standard_view")


PANELS = (GONIO_RENDER_PT_film, GONIO_RENDER_PT_film_transparency, GONIO_RENDER_PT_film_pixel_filter, GONIO_RENDER_PT_film_tone_mapping)

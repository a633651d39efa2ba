# SPDX-License-Identifier: GPL-3.0-or-later
"""The film."""

from bpy.types import Panel

from .base import RenderPanel


class GONIO_RENDER_PT_film(RenderPanel, Panel):
    bl_label = "Film"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        layout.prop(scene.gonio, "film_exposure")
        layout.prop(scene.render, "film_transparent", text="Transparent")


class GONIO_RENDER_PT_film_pixel_filter(RenderPanel, Panel):
    bl_label = "Pixel Filter"
    bl_parent_id = "GONIO_RENDER_PT_film"

    def draw_settings(self, layout, scene):
        layout.prop(scene.gonio, "pixel_filter_type", text="Type")
        layout.prop(scene.gonio, "filter_width", text="Width")


PANELS = (GONIO_RENDER_PT_film, GONIO_RENDER_PT_film_pixel_filter)

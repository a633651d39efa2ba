# SPDX-License-Identifier: GPL-3.0-or-later
"""The world."""

import gonio
from bpy.types import Panel

from ..daylight import of_world
from .base import GonioPanel, draw_shader


class WorldPanel(GonioPanel):
    """A panel of the world tab."""

    bl_context = "world"

    @classmethod
    def poll(cls, context):
        return context.world is not None and super().poll(context)


class GONIO_WORLD_PT_preview(WorldPanel, Panel):
    bl_label = "Preview"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.template_preview(context.world)


class GONIO_WORLD_PT_surface(WorldPanel, Panel):
    bl_label = "Surface"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.active = not context.world.gonio.use_daylight
        if not draw_shader(self.layout, context.world, "OUTPUT_WORLD", "Surface"):
            self.layout.prop(context.world, "color")


class GONIO_WORLD_PT_volume(WorldPanel, Panel):
    bl_label = "Volume"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.world.node_tree is not None

    def draw(self, context):
        self.layout.use_property_split = True
        draw_shader(self.layout, context.world, "OUTPUT_WORLD", "Volume")


class GONIO_WORLD_PT_luminance(WorldPanel, Panel):
    bl_label = "Luminance"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header(self, context):
        self.layout.prop(context.world.gonio, "use_luminance", text="")

    def draw(self, context):
        settings = context.world.gonio
        self.layout.use_property_split = True
        self.layout.active = settings.use_luminance and not settings.use_daylight
        self.layout.prop(settings, "luminance", text="cd/m²")


class GONIO_WORLD_PT_daylight(WorldPanel, Panel):
    bl_label = "Daylight"

    def draw_header(self, context):
        self.layout.prop(context.world.gonio, "use_daylight", text="")

    def draw(self, context):
        layout, settings = self.layout, context.world.gonio
        layout.use_property_split = True
        layout.active = settings.use_daylight
        place = layout.column(align=True)
        place.prop(settings, "city", text="Place")
        place.prop(settings, "latitude")
        place.prop(settings, "longitude")
        place.prop(settings, "elevation")
        date = layout.column(align=True)
        for name in ("day", "month", "year"):
            date.prop(settings, name)
        time = layout.column(align=True)
        time.prop(settings, "hour")
        time.prop(settings, "utc_offset")
        layout.prop(settings, "north")
        if settings.use_daylight:
            _draw_sun(layout.box().column(align=True), context.world)
            layout.operator("gonio.expose_for_daylight")


def _draw_sun(column, world) -> None:
    """Where the sun stands, and how much light it and the sky bring: to a surface that faces it, and to a level one."""
    try:
        found = of_world(world)
    except gonio.Error as problem:
        column.label(text=str(problem), icon="ERROR")
        return
    column.label(text=f"Height {found.elevation:.1f}°, azimuth {found.azimuth:.1f}°")
    if found.sunrise is not None and found.sunset is not None:
        column.label(text=f"Sunrise {_clock(found.sunrise)}, sunset {_clock(found.sunset)}")
    column.label(text=f"Sun {found.direct_illuminance:,.0f} lx, sky {found.diffuse_illuminance:,.0f} lx")


def _clock(hours: float) -> str:
    minutes = round(hours * 60.0) % 1440
    return f"{minutes // 60:02d}:{minutes % 60:02d}"


class GONIO_WORLD_PT_daylight_sky(WorldPanel, Panel):
    bl_label = "Sky"
    bl_parent_id = "GONIO_WORLD_PT_daylight"

    def draw(self, context):
        layout, settings = self.layout, context.world.gonio
        layout.use_property_split = True
        layout.active = settings.use_daylight
        layout.prop(settings, "sky")
        layout.prop(settings, "turbidity")
        layout.prop(settings, "ground", slider=True)
        layout.prop(settings, "use_colour")
        column = layout.column(heading="Measured")
        column.prop(settings, "use_irradiance", text="Irradiance")
        values = column.column(align=True)
        values.active = settings.use_irradiance
        values.prop(settings, "direct_normal")
        values.prop(settings, "diffuse_horizontal")


class GONIO_WORLD_PT_mist(WorldPanel, Panel):
    bl_label = "Mist Pass"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        mist = context.world.mist_settings
        column = self.layout.column(align=True)
        column.prop(mist, "start")
        column.prop(mist, "depth")
        self.layout.prop(mist, "falloff")


class GONIO_WORLD_PT_ray_visibility(WorldPanel, Panel):
    bl_label = "Ray Visibility"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        # Cycles keeps these switches.
        return super().poll(context) and hasattr(context.world, "cycles_visibility")

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        seen = context.world.cycles_visibility
        column = self.layout.column(heading="Seen by")
        for ray in ("camera", "diffuse", "glossy", "transmission"):
            column.prop(seen, ray)


class GONIO_WORLD_PT_settings(WorldPanel, Panel):
    bl_label = "Settings"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        # How far ambient occlusion looks, in its pass, in bakes, and in nodes of the distance 0.
        self.layout.prop(context.world.light_settings, "distance", text="Occlusion Distance")


PANELS = (
    GONIO_WORLD_PT_preview,
    GONIO_WORLD_PT_surface,
    GONIO_WORLD_PT_volume,
    GONIO_WORLD_PT_luminance,
    GONIO_WORLD_PT_daylight,
    GONIO_WORLD_PT_daylight_sky,
    GONIO_WORLD_PT_mist,
    GONIO_WORLD_PT_ray_visibility,
    GONIO_WORLD_PT_settings,
)

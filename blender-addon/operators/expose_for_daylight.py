# SPDX-License-Identifier: GPL-3.0-or-later
"""The exposure that a day outside needs, for its light is absolute."""

from math import log2, pi, radians, sin

import bpy
import gonio

from ..daylight import of_world
from ..export.settings import LEAST_EXPOSURE
from ..units import LUMENS_PER_WATT
from .polling import can_run

# Illuminance [lx] of a moonless night: below it there is nothing to expose for.
DARKEST = 1e-3


def exposure_of(found) -> float | None:
    """Stops with which a Lambertian card on level ground shows as its own reflectance under a `gonio.Daylight`; None at night."""
    level = found.direct_illuminance * max(sin(radians(found.elevation)), 0.0) + found.diffuse_illuminance
    return log2(pi * LUMENS_PER_WATT / level) if level > DARKEST else None


class GONIO_OT_expose_for_daylight(bpy.types.Operator):
    """Set the exposure in Color Management so that level ground under this sun and sky is as bright as its colour says. Renders keep their values"""

    bl_idname = "gonio.expose_for_daylight"
    bl_label = "Expose for This Hour"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        world = None if context.scene is None else context.scene.world
        has_daylight = world is not None and world.gonio.use_daylight
        is_free = context.scene is None or context.scene.gonio.tone_map == "NONE"
        return can_run(cls, (has_daylight, "The world's Daylight is off"), (is_free, "Tone mapping sees to the exposure"))

    def execute(self, context):
        try:
            stops = exposure_of(of_world(context.scene.world))
        except gonio.Error as problem:
            self.report({"ERROR"}, str(problem))
            return {"CANCELLED"}
        if stops is None:
            self.report({"ERROR"}, "Neither sun nor sky shines at this hour")
            return {"CANCELLED"}
        context.scene.view_settings.exposure = stops - log2(max(context.scene.gonio.film_exposure, LEAST_EXPOSURE))
        return {"FINISHED"}

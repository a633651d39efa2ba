# SPDX-License-Identifier: GPL-3.0-or-later
"""A year of daylight on the calculation grids of a scene."""

from math import degrees
from pathlib import Path

import bpy
import gonio
import numpy as np
from bpy.props import FloatProperty, IntProperty, StringProperty, IntVectorProperty

from .. import measuring, report
from .measure_grids import FAILURES, OnGrids, has_grids, meter_of, write_image
from .polling import can_run, is_engine

# Pixels of a plan's longer side, about.
SIDE = 900


class GONIO_OT_annual_daylight(OnGrids, bpy.types.Operator):
    """Calculate a year of daylight on all calculation grids that measure illuminance, from a weather file. Lamps are dark; the weather's sky and sun shine from the world's north"""

    bl_idname = "gonio.annual_daylight"
    bl_label = "Annual Daylight"
    bl_options = {"REGISTER", "UNDO"}

    filepath: StringProperty(name="Weather", description="An EPW or WEA file of a whole year", subtype="FILE_PATH")
    filter_glob: StringProperty(default="*.epw;*.wea", options={"HIDDEN"})
    samples: IntProperty(name="Samples", description="Paths of each point, for light that something scatters", min=16, max=1 << 20, default=4096)
    hours: IntVectorProperty(name="Hours of Use", description="From and to which hour of every day", size=2, min=0, max=24, default=(8, 18))
    blinds: FloatProperty(
        name="Blinds",
        description="Share of light that closed blinds let through; they close while more than 2 % of the points have 1000 lx of direct sun. "
        "At 1 there are none",
        subtype="FACTOR",
        min=0.0,
        max=1.0,
        default=1.0,
    )

    _is_asked = False

    @classmethod
    def poll(cls, context):
        return can_run(cls, is_engine(context), has_grids(context))

    def invoke(self, context, event):
        """Asks for the file, then works beside Blender until ESC."""
        self._is_asked = True
        context.window_manager.fileselect_add(self)
        return {"RUNNING_MODAL"}

    def execute(self, context):
        try:
            meter, weather = meter_of(context), Path(bpy.path.abspath(self.filepath)).read_bytes()
            if not self._is_asked:
                return self._publish(context, meter, self._year(meter, weather, _north(context)))
            self._meter = meter
        except (*FAILURES, OSError) as error:
            return self._fail(error)
        context.workspace.status_text_set("Gonio calculates a year of daylight    ESC: Cancel")
        return self._go(context, self._year, meter, weather, _north(context))

    def _year(self, meter, weather, north, cancelled=None):
        """Readings of the grids; it asks nothing of Blender, so that any thread may wait for it."""
        blinds = None if self.blinds >= 1.0 else self.blinds
        return gonio.annual(
            meter.scene, weather, samples=self.samples, schedule=tuple(self.hours), blinds=blinds, up="Z", north=north, cancelled=cancelled
        )

    def _publish(self, context, meter, found):
        meter.report.add_render(found[0].diagnostics if found else [])
        report.publish(meter.report)
        measuring.latest.years = {reading.name: measuring.year_lines(reading) for reading in found}
        for reading in found:
            for figure, unit, factor, most in (("da_300", "%", 100.0, 100.0), ("udi_100_3000", "%", 100.0, 100.0), ("hours_direct_1000", "h", 1.0, None)):
                values = factor * np.asarray(reading.plan(figure))
                cell = max(SIDE // max(values.shape), 1)
                pixels = np.kron(values[::-1], np.ones((cell, cell))).astype(np.float32)
                write_image(f"{reading.name} ({figure})", gonio.false_colour(pixels, max=most, unit=unit, smoothing=0))
        self.report({"INFO"}, f"{len(found)} grid{'s' * (len(found) > 1)} calculated; plans are images of the file")
        return {"FINISHED"}


def _north(context) -> float:
    """Degrees by which the world's north is turned."""
    world = context.scene.world
    return degrees(world.gonio.north) if world is not None else 0.0

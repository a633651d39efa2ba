# SPDX-License-Identifier: GPL-3.0-or-later
"""The dimming of light groups that meets targets on the calculation grids at least power."""

import bpy
import gonio
from bpy.props import BoolProperty, FloatProperty, IntProperty, StringProperty

from .. import dimming, measuring, report
from .measure_grids import FAILURES, OnGrids, grids_of, has_grids, meter_of
from .polling import can_run, is_engine


class GONIO_OT_dim_lights(OnGrids, bpy.types.Operator):
    """Dim the light groups so that the calculation grids meet targets at least power. An object's group is in its Light Group panel; light of no group stays"""

    bl_idname = "gonio.dim_lights"
    bl_label = "Dim Light Groups"
    bl_options = {"REGISTER", "UNDO"}

    mean: FloatProperty(
        name="Mean (lx)", description="Least mean of every grid of illuminance; at 0 it is no target", min=0.0, soft_max=2000.0, step=5000, default=500.0
    )
    uniformity: FloatProperty(
        name="Uniformity",
        description="Least share of the lowest point in the mean of every grid of illuminance, U0; at 0 it is no target",
        subtype="FACTOR",
        min=0.0,
        max=1.0,
        default=0.0,
    )
    targets: StringProperty(
        name="More Targets", description="By the grids' names, with commas between: Desk.min>=300, Wall.max<=800, Board.mean=500+-25, Seats.max<=19 of UGR"
    )
    least: FloatProperty(name="Least Level", description="No group is dimmed below it", subtype="FACTOR", min=0.0, max=1.0, default=0.0)
    is_even: BoolProperty(name="Even", description="Levels that differ as little as they may, before the least power", default=False)
    is_applied: BoolProperty(name="Dim the Lights", description="Dim the lights to the levels; otherwise the levels are told alone", default=True)
    samples: IntProperty(name="Samples", description="Samples of each point, for each group", min=16, max=1 << 20, default=4096)

    _is_asked = False

    @classmethod
    def poll(cls, context):
        has_groups = context.scene is not None and any(thing.lightgroup for thing in context.scene.objects if thing.type == "LIGHT")
        return can_run(
            cls,
            is_engine(context),
            has_grids(context),
            (has_groups, "No light of the scene is in a light group: Object Properties, Light Group"),
        )

    def invoke(self, context, event):
        """Asks for the targets, then works beside Blender until ESC."""
        self._is_asked = True
        return context.window_manager.invoke_props_dialog(self, width=400)

    def execute(self, context):
        try:
            meter, asked = meter_of(context), self._targets(context)
            if not self._is_asked:
                return self._publish(context, meter, self._levels(meter, asked))
            self._meter = meter
        except FAILURES as error:
            return self._fail(error)
        context.workspace.status_text_set("Gonio measures the light groups    ESC: Cancel")
        return self._go(context, self._levels, meter, asked)

    def _targets(self, context):
        """What is asked of the grids, as `gonio.dim` has it."""
        grids = [thing.name for thing in grids_of(context) if thing.gonio.grid_quantity == "illuminance"]
        asked = [f"{name}.mean>={self.mean}" for name in grids if self.mean > 0.0]
        asked += [f"{name}.uo>={self.uniformity}" for name in grids if self.uniformity > 0.0]
        return asked + [target.strip() for target in self.targets.split(",") if target.strip()]

    def _levels(self, meter, asked, cancelled=None):
        """What `gonio.dim` finds; it asks nothing of Blender, so that any thread may wait for it."""
        near = "equal" if self.is_even else None
        return gonio.dim(meter.scene, asked, min_level=self.least, near=near, samples=self.samples, cancelled=cancelled)

    def _publish(self, context, meter, found):
        levels = {group["name"]: group["level"] for group in found["groups"]}
        for note in found["notes"]:
            meter.report.add("Scene", context.scene.name, note, severity="INFO" if "100 lm/W" in note else "WARNING")
        if self.is_applied:
            dimming.apply(context.scene, levels, meter.report)
        report.publish(meter.report)
        measuring.latest.levels = dimming.lines(found)
        told = ", ".join(f"{name} {100 * level:.0f} %" for name, level in levels.items())
        self.report({"INFO"} if found["met"] else {"WARNING"}, told if found["met"] else f"{told}; not all targets are met")
        return {"FINISHED"}

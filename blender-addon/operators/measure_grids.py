# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures light on the calculation grids of a scene."""

import bpy
import gonio
import numpy as np
from bpy.props import IntProperty

from .. import measuring, report
from .beside import Beside
from .polling import can_run, is_engine

# What the engine, the arrays of a mesh and Blender's own meshes and images raise.
FAILURES = (gonio.Error, ValueError, TypeError, RuntimeError)


class OnGrids(Beside):
    """What operators on calculation grids share: their meter waits in `_meter` while they work beside Blender."""

    def _arrived(self, context, found):
        try:
            return self._publish(context, self._meter, found.result())
        except FAILURES as error:
            return self._fail(error)


class GONIO_OT_measure_grids(OnGrids, bpy.types.Operator):
    """Measure light on all calculation grids of the view layer; values and pictures become a text and images of the file"""

    bl_idname = "gonio.measure_grids"
    bl_label = "Measure Grids"
    bl_options = {"REGISTER", "UNDO"}

    samples: IntProperty(name="Samples", description="Samples of each point", min=16, max=1 << 20, default=4096)

    @classmethod
    def poll(cls, context):
        return can_run(cls, is_engine(context), has_grids(context))

    def execute(self, context):
        try:
            meter = meter_of(context)
            return self._publish(context, meter, meter.grids(self.samples))
        except FAILURES as error:
            return self._fail(error)

    def invoke(self, context, event):
        """Measures beside Blender, until ESC; scripts that call `execute` wait."""
        try:
            self._meter = meter_of(context)
        except FAILURES as error:
            return self._fail(error)
        context.workspace.status_text_set("Gonio measures the grids    ESC: Cancel")
        return self._go(context, self._meter.grids, self.samples)

    def _publish(self, context, meter, found):
        meter.report.add_render(found.diagnostics)
        report.publish(meter.report)
        measuring.latest.grids = {reading.name: reading for reading in found.grids}
        _write_text("Gonio grids.csv", found.csv())
        for name, reading in measuring.latest.grids.items():
            # The scene's scale is one of light.
            most = context.scene.gonio.false_color_max if reading.quantity in measuring.AMOUNTS else 0.0
            write_image(f"{name} ({reading.unit or reading.quantity})", reading.picture(max=most or None))
        count = len(found.grids)
        self.report({"INFO"}, f"{count} grid{'s' * (count > 1)} measured; values are in the text 'Gonio grids.csv'")
        return {"FINISHED"}


def meter_of(context):
    """A meter of the scene with its grids."""
    depsgraph = context.evaluated_depsgraph_get()
    meter = measuring.Meter(depsgraph)
    meter.put_grids(depsgraph, list(grids_of(context)))
    return meter


def has_grids(context) -> tuple[bool, str]:
    """The condition that there is something to measure on."""
    words = "No object of the scene is a grid: Object Properties, Calculation Grid"
    return context.scene is not None and any(True for _ in grids_of(context)), words


def grids_of(context):
    """Objects of the view layer that are grids."""
    for thing in context.view_layer.objects:
        if thing.gonio.is_grid and thing.type == "MESH":
            yield thing


def _write_text(name, content) -> None:
    text = bpy.data.texts.get(name) or bpy.data.texts.new(name)
    text.clear()
    text.write(content.replace("\r\n", "\n"))


def write_image(name, picture) -> None:
    """Makes a picture an image of the file, or its pixels those of the image of that name."""
    width, height = picture.size
    image = bpy.data.images.get(name)
    if image is None:
        image = bpy.data.images.new(name, width, height, alpha=True)
    elif tuple(image.size) != (width, height):
        image.scale(width, height)
    pixels = np.frombuffer(picture.tobytes(), np.uint8).reshape(height, width, 4)[::-1]
    image.pixels.foreach_set(np.ascontiguousarray(pixels, np.float32).ravel() / 255.0)
    image.update()
    image.pack()

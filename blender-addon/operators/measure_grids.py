# SPDX-License-Identifier: GPL-3.0-or-later
"""Measures light on the calculation grids of a scene."""

import bpy
import gonio
import numpy as np
from bpy.props import IntProperty

from .. import measuring, report


class GONIO_OT_measure_grids(bpy.types.Operator):
    """Measure light on all calculation grids of the view layer; values and pictures become a text and images of the file"""

    bl_idname = "gonio.measure_grids"
    bl_label = "Measure Grids"
    bl_options = {"REGISTER", "UNDO"}

    samples: IntProperty(name="Samples", description="Samples of each point", min=16, max=1 << 20, default=4096)

    @classmethod
    def poll(cls, context):
        return any(True for _ in _grids(context))

    def execute(self, context):
        objects = list(_grids(context))
        depsgraph = context.evaluated_depsgraph_get()
        try:
            meter = measuring.Meter(depsgraph)
            found = meter.grids(depsgraph, objects, self.samples)
        except gonio.Error as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        report.publish(meter.report)
        measuring.latest.grids = {thing.name: reading for thing, reading in zip(objects, found.grids, strict=True)}
        _write_text("Gonio grids.csv", found.csv())
        for name, reading in measuring.latest.grids.items():
            _write_image(f"{name} ({reading.unit})", reading.picture(max=context.scene.gonio.false_color_max or None))
        self.report({"INFO"}, f"{len(objects)} grid{'s' * (len(objects) > 1)} measured; values are in the text 'Gonio grids.csv'")
        return {"FINISHED"}


def _grids(context):
    for thing in context.view_layer.objects:
        if thing.gonio.is_grid and thing.type == "MESH":
            yield thing


def _write_text(name, content) -> None:
    text = bpy.data.texts.get(name) or bpy.data.texts.new(name)
    text.clear()
    text.write(content.replace("\r\n", "\n"))


def _write_image(name, picture) -> None:
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

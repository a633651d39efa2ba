# SPDX-License-Identifier: GPL-3.0-or-later
"""Lux and cd/m² under the cursor."""

import bpy
import gonio
from bpy.props import IntProperty
from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d

from .. import measuring


class GONIO_OT_point_meter(bpy.types.Operator):
    """Show illuminance and luminance under the cursor; click to keep the reading, ESC or the right button ends"""

    bl_idname = "gonio.point_meter"
    bl_label = "Measure under Cursor"

    samples: IntProperty(name="Samples", description="Samples of a kept reading", min=16, max=1 << 20, default=16384)
    # While the cursor moves, readings are to keep up with it.
    MOVING_SAMPLES = 1024

    @classmethod
    def poll(cls, context):
        return context.area is not None and context.area.type == "VIEW_3D"

    def invoke(self, context, event):
        try:
            self._meter = measuring.Meter(context.evaluated_depsgraph_get())
        except gonio.Error as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self._region = next(region for region in context.area.regions if region.type == "WINDOW")
        self._label = None
        self._handler = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_PIXEL")
        context.window_manager.modal_handler_add(self)
        context.window.cursor_modal_set("EYEDROPPER")
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        if event.type in {"ESC", "RIGHTMOUSE"}:
            return self._end(context, {"CANCELLED"})
        at = (event.mouse_x - self._region.x, event.mouse_y - self._region.y)
        # The sidebar and the tools lie over the view.
        over = [each.type for each in context.area.regions if _holds(each, event)]
        inside = over == ["WINDOW"]
        if event.type == "MOUSEMOVE" and inside:
            self._read(context, at, self.MOVING_SAMPLES)
            context.area.tag_redraw()
            return {"RUNNING_MODAL"}
        if event.type == "LEFTMOUSE" and event.value == "PRESS" and inside:
            self._read(context, at, self.samples)
            return self._end(context, {"FINISHED"})
        return {"PASS_THROUGH"}

    def _read(self, context, at, samples) -> None:
        region_3d = context.area.spaces.active.region_3d
        origin, direction = (place(self._region, region_3d, at) for place in (region_2d_to_origin_3d, region_2d_to_vector_3d))
        lines = reading_along(self._meter, context.evaluated_depsgraph_get(), context.scene, origin, direction, samples)
        measuring.latest.point = lines
        self._label = (at, lines)

    def _draw(self) -> None:
        if self._label is not None:
            from ..draw.label import draw_label

            draw_label(*self._label)

    def _end(self, context, result):
        bpy.types.SpaceView3D.draw_handler_remove(self._handler, "WINDOW")
        context.window.cursor_modal_restore()
        context.area.tag_redraw()
        return result


def _holds(region, event) -> bool:
    """Whether the cursor is over a region that is shown."""
    x, y = event.mouse_x - region.x, event.mouse_y - region.y
    return region.width > 1 and region.height > 1 and 0 <= x < region.width and 0 <= y < region.height


def reading_along(meter, depsgraph, scene, origin, direction, samples) -> tuple[str, ...]:
    """Figures of the first surface along a ray, on the side that the ray comes from."""
    hit, position, normal, _, thing, _ = scene.ray_cast(depsgraph, origin, direction)
    if not hit:
        return ("nothing there",)
    if normal.dot(direction) > 0.0:
        normal = -normal
    # Off the surface by less than a meter's own thickness, more than single precision.
    above = position + normal * max(1e-4, 1e-5 * max(map(abs, position)))
    try:
        illuminance, _ = meter.at(above, normal, direction, samples)
        _, luminance = meter.at(position - direction * max(1e-3, 1e-4 * (position - origin).length), normal, direction, samples)
    except gonio.Error as error:
        return (str(error),)
    figures = (("E", illuminance, "lx"), ("L", luminance, "cd/m²"))
    lines = [f"{symbol}: {reading.value:.4g} {unit} ± {reading.standard_error:.2g}" for symbol, reading, unit in figures]
    return (*lines, thing.name)

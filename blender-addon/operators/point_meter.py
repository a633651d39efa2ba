# SPDX-License-Identifier: GPL-3.0-or-later
"""Lux and cd/m² under the cursor."""

import bpy
import gonio
from bpy.props import IntProperty
from bpy_extras.view3d_utils import region_2d_to_origin_3d, region_2d_to_vector_3d

from .. import measuring
from .polling import can_run


class GONIO_OT_point_meter(bpy.types.Operator):
    """Show illuminance and luminance under the cursor; click to keep the reading, ESC or the right button ends"""

    bl_idname = "gonio.point_meter"
    bl_label = "Measure under Cursor"

    samples: IntProperty(name="Samples", description="Samples of a kept reading", min=16, max=1 << 20, default=16384)
    # While the cursor moves, readings are to keep up with it.
    MOVING_SAMPLES = 1024

    @classmethod
    def poll(cls, context):
        return can_run(cls, (context.area is not None and context.area.type == "VIEW_3D", "The mouse is not over a 3D viewport"))

    def invoke(self, context, event):
        try:
            self._meter = measuring.Meter(context.evaluated_depsgraph_get())
        except gonio.Error as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self._region = self._label = None
        self._handler = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_PIXEL")
        context.window_manager.modal_handler_add(self)
        context.window.cursor_modal_set("EYEDROPPER")
        return {"RUNNING_MODAL"}

    def modal(self, context, event):
        # Events that pass through may have taken the viewport away: another workspace, another editor.
        if event.type in {"ESC", "RIGHTMOUSE"} or not self.poll(context):
            self.cancel(context)
            return {"CANCELLED"}
        region = view_under(context.area, event)
        if event.type == "MOUSEMOVE" and region is not None:
            self._read(context, region, event, self.MOVING_SAMPLES)
            context.area.tag_redraw()
            return {"RUNNING_MODAL"}
        if event.type == "LEFTMOUSE" and event.value == "PRESS" and region is not None:
            self._read(context, region, event, self.samples)
            self.cancel(context)
            return {"FINISHED"}
        return {"PASS_THROUGH"}

    def cancel(self, context):
        """Takes label and cursor away; Blender calls it when it ends the tool itself, as before another file."""
        handler, self._handler = self._handler, None
        if handler is not None:
            bpy.types.SpaceView3D.draw_handler_remove(handler, "WINDOW")
        if context.window is not None:
            context.window.cursor_modal_restore()
        if context.area is not None:
            context.area.tag_redraw()

    def _read(self, context, region, event, samples) -> None:
        at = (event.mouse_x - region.x, event.mouse_y - region.y)
        # The four of a quad view have views of their own.
        origin, direction = (place(region, region.data, at) for place in (region_2d_to_origin_3d, region_2d_to_vector_3d))
        lines = reading_along(self._meter, context.evaluated_depsgraph_get(), context.scene, origin, direction, samples)
        measuring.latest.point = lines
        self._region, self._label = region.as_pointer(), (at, lines)

    def _draw(self) -> None:
        # It is called for all 3D viewports.
        if self._label is not None and bpy.context.region.as_pointer() == self._region:
            from ..draw.label import draw_label

            draw_label(*self._label)


def view_under(area, event):
    """The region of a 3D viewport under the cursor; None where another one, as the sidebar, lies over it."""
    over = [each for each in area.regions if _holds(each, event)]
    return over[0] if [each.type for each in over] == ["WINDOW"] else None


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
    eye = position - direction * max(1e-3, 1e-4 * (position - origin).length)
    try:
        illuminance, luminance = meter.at(above, normal, eye, direction, samples)
    except gonio.Error as error:
        return (str(error),)
    figures = (("E", illuminance, "lx"), ("L", luminance, "cd/m²"))
    lines = [f"{symbol}: {reading.value:.4g} {unit} ± {reading.standard_error:.2g}" for symbol, reading, unit in figures]
    return (*lines, thing.name)

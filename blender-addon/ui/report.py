# SPDX-License-Identifier: GPL-3.0-or-later
"""What could not be shown as it is in the file: a panel of the render tab, and a count in the header of rendered viewports."""

import blf
import bpy
from bpy.types import Panel

from .. import report
from .base import ENGINE, RenderPanel

ICONS = {"ERROR": "CANCEL", "WARNING": "ERROR", "INFO": "INFO"}
MOST_LINES = 40
# Sizes of Blender's interface at a scale of 1: of text in points, of a unit and of what stands beside a line in pixels.
POINTS, UNIT, BESIDE = 11.0, 20, 90
# Width of the list that the viewport's header opens, in units.
POPOVER = 26


def wrapped(text: str, width: float, measure) -> list[str]:
    """A text in lines of at most a width, broken between words, or within one that is wider; `measure` gives the width of a text."""
    lines, line = [], ""
    for word in text.split():
        if line and measure(f"{line} {word}") > width:
            lines.append(line)
            line = ""
        line = f"{line} {word}" if line else word
        while measure(line) > width and len(line) > 1:
            fits = next(count for count in range(len(line) - 1, 0, -1) if count == 1 or measure(line[:count]) <= width)
            lines.append(line[:fits])
            line = line[fits:]
    return [*lines, line]


def draw_lines(layout, width: float) -> None:
    """The report's lines, whole, in a column of so many pixels."""
    lines = report.latest().counted
    exact, nodes = report.latest().nodes
    if nodes:
        layout.label(text=f"{exact} of {nodes} shader nodes are exact", icon="NODE_MATERIAL")
    if not lines:
        layout.label(text="Everything was understood", icon="CHECKMARK")
        return
    scale = bpy.context.preferences.system.ui_scale
    blf.size(0, POINTS * scale)
    column = layout.column(align=True)
    for index, line in enumerate(lines[:MOST_LINES]):
        first, *rest = wrapped(line.text, width - BESIDE * scale, lambda text: blf.dimensions(0, text)[0])
        row = column.row(align=True)
        row.label(text=first, icon=ICONS[line.first.severity])
        if line.first.kind != "Render":
            row.operator("gonio.report_jump", text="", icon="VIEWZOOM").index = index
        for text in rest:
            column.label(text=text, icon="BLANK1")
    if len(lines) > MOST_LINES:
        column.label(text=f"and {len(lines) - MOST_LINES} more")
    layout.operator("gonio.report_copy", icon="COPYDOWN")


class GONIO_RENDER_PT_report(RenderPanel, Panel):
    bl_label = "Gonio Report"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header_preset(self, context):
        count = len(report.latest().counted)
        if count:
            self.layout.label(text=str(count), icon="ERROR")

    def draw_settings(self, layout, scene):
        draw_lines(layout, bpy.context.region.width)


class GONIO_VIEW3D_PT_report(Panel):
    """What Gonio could not show as it is in the file"""

    bl_label = "Gonio Report"
    bl_space_type = "VIEW_3D"
    bl_region_type = "HEADER"
    bl_ui_units_x = POPOVER

    def draw(self, context):
        self.layout.label(text=self.bl_label)
        draw_lines(self.layout, POPOVER * UNIT * context.preferences.system.ui_scale)


def _draw_count(self, context) -> None:
    """How many lines there are, in the header of a viewport that Gonio renders."""
    if context.engine != ENGINE or context.space_data.shading.type != "RENDERED":
        return
    count = len(report.latest().counted)
    if count:
        self.layout.popover(GONIO_VIEW3D_PT_report.__name__, text=str(count), icon="ERROR")


def register() -> None:
    bpy.types.VIEW3D_HT_header.append(_draw_count)


def unregister() -> None:
    bpy.types.VIEW3D_HT_header.remove(_draw_count)


PANELS = (GONIO_RENDER_PT_report, GONIO_VIEW3D_PT_report)

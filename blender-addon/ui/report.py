# SPDX-License-Identifier: GPL-3.0-or-later
"""What could not be shown as it is in the file."""

from bpy.types import Panel

from .. import report
from .base import RenderPanel

ICONS = {"ERROR": "CANCEL", "WARNING": "ERROR", "INFO": "INFO"}
MOST_LINES = 40


class GONIO_RENDER_PT_report(RenderPanel, Panel):
    bl_label = "Gonio Report"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_header_preset(self, context):
        count = len(report.latest().diagnostics)
        if count:
            self.layout.label(text=str(count), icon="ERROR")

    def draw_settings(self, layout, scene):
        lines = report.latest().diagnostics
        if not lines:
            layout.label(text="Everything was understood", icon="CHECKMARK")
            return
        column = layout.column(align=True)
        for index, line in enumerate(lines[:MOST_LINES]):
            row = column.row(align=True)
            row.label(text=line.text, icon=ICONS[line.severity])
            if line.kind != "Render":
                row.operator("gonio.report_jump", text="", icon="VIEWZOOM").index = index
        if len(lines) > MOST_LINES:
            column.label(text=f"and {len(lines) - MOST_LINES} more")
        layout.operator("gonio.report_copy", icon="COPYDOWN")


PANELS = (GONIO_RENDER_PT_report,)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's callbacks; each hands on to a session and turns what goes wrong into a message."""

import logging
from collections.abc import Iterator
from contextlib import contextmanager

import bpy

from .. import report
from ..session import FinalSession, ViewportSession, handover
from ..session.passes import register_passes

log = logging.getLogger("gonio")


class GonioRenderEngine(bpy.types.RenderEngine):
    """One object a final render, a preview, or a 3D viewport."""

    bl_idname = "GONIO"
    bl_label = "Gonio"
    bl_use_preview = True
    bl_use_postprocess = True
    bl_use_eevee_viewport = True
    bl_use_shading_nodes_custom = False

    # Blender may skip __init__, so that defaults stand here.
    final: FinalSession | None = None
    viewport: ViewportSession | None = None
    drawing = None
    has_failed = False
    # Lines of the report when the viewport was drawn last.
    told = 0

    def __init__(self, *arguments, **keywords) -> None:
        super().__init__(*arguments, **keywords)

    def __del__(self) -> None:
        viewport, self.viewport = self.viewport, None
        if viewport is not None:
            viewport.close()
            self.drawing.close()
        if hasattr(super(), "__del__"):
            super().__del__()

    @contextmanager
    def _reporting(self) -> Iterator[None]:
        """An exception that leaves a callback may bring Blender down."""
        try:
            yield
        except Exception as error:
            log.exception("Gonio could not go on")
            message = str(error) or type(error).__name__
            self.has_failed = True
            self.report({"ERROR"}, message)
            self.error_set(message)

    def update_render_passes(self, scene=None, renderlayer=None) -> None:
        if scene is not None and renderlayer is not None:
            register_passes(self, scene, renderlayer)

    def update(self, data=None, depsgraph=None) -> None:
        self.has_failed = False
        with self._reporting():
            self.update_stats("", "Exporting the scene")
            if (handed := self._awaited()) is not None:
                handed.session.sync(depsgraph, engine=self)
                return
            self.final = self.final or FinalSession()
            self.final.sync(depsgraph, preview=self.is_preview, engine=self)

    def render(self, depsgraph) -> None:
        if self.has_failed:
            return
        with self._reporting():
            if (handed := self._awaited()) is not None:
                handed.take(self, depsgraph)
                return
            self.final = self.final or FinalSession()
            told = self.final.render(self, depsgraph, preview=self.is_preview)
            if self.is_preview:
                return
            report.publish(told)
            if summary := told.summary():
                self.report({"WARNING"}, summary)

    def bake(self, depsgraph, object, pass_type, pass_filter, width, height) -> None:
        if self.has_failed:
            return
        with self._reporting():
            self.final = self.final or FinalSession()
            report.publish(self.final.bake(self, depsgraph, object, pass_type, pass_filter, (width, height)))

    def view_update(self, context, depsgraph) -> None:
        with self._reporting():
            self._viewport().sync(depsgraph)
            self.tag_redraw()

    def view_draw(self, context, depsgraph) -> None:
        with self._reporting():
            session, region = self._viewport(), context.region
            pixel_size = int(self.get_preview_pixel_size(depsgraph.scene))
            session.look(depsgraph, context.space_data, context.region_data, region.width, region.height, pixel_size)
            session.advance(depsgraph)
            if session.picture is not None:
                self.drawing.draw(self, context, depsgraph.scene, session.picture)
            self.update_stats("", session.status)
            self._show_report(context, len(session.report.counted))

    def _awaited(self) -> handover.Handover | None:
        """Who waits for the scene of this render in place of its picture."""
        return None if self.is_preview else handover.awaited()

    def _show_report(self, context, count: int) -> None:
        if count != self.told:
            from ..draw import redraw

            self.told = count
            redraw.show_report(context)

    def _viewport(self) -> ViewportSession:
        if self.viewport is None:
            # What needs a window is imported when there is one.
            from ..draw import redraw
            from ..draw.viewport import ViewportDrawing

            self.viewport, self.drawing = ViewportSession(), ViewportDrawing()
            redraw.start(self)
        return self.viewport

# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that trace light in a thread while Blender goes on, until ESC."""

from concurrent.futures import ThreadPoolExecutor
from threading import Event

# Seconds between two looks whether the work is done.
PAUSE = 0.1


class Beside:
    """What such an operator has beside its own `_arrived(context, found)`, which publishes what the thread found."""

    _worker = None

    def _go(self, context, work, *arguments, **options):
        """Has `work` done, which is told last of its arguments how to ask whether it is to end."""
        self._stop, self._worker = Event(), ThreadPoolExecutor(max_workers=1)
        self._found = self._worker.submit(work, *arguments, self._stop.is_set, **options)
        self._timer = context.window_manager.event_timer_add(PAUSE, window=context.window)
        context.window_manager.modal_handler_add(self)
        return {"RUNNING_MODAL"}

    def _fail(self, problem, name=""):
        """Says what went wrong, with what."""
        words = str(problem) or type(problem).__name__
        self.report({"ERROR"}, f"{name}: {words}" if name else words)
        return {"CANCELLED"}

    def _tell(self, context):
        """Says how far the work is, from time to time."""

    def modal(self, context, event):
        if event.type == "ESC":
            self.cancel(context)
            return {"CANCELLED"}
        # Nothing passes through: what is traced is still there when the figures come.
        if not self._found.done():
            self._tell(context)
            return {"RUNNING_MODAL"}
        self.cancel(context)
        end = self._arrived(context, self._found)
        # What a modal operator changes is drawn where the mouse is alone.
        for area in context.screen.areas if context.screen is not None else ():
            area.tag_redraw()
        return end

    def cancel(self, context):
        """Ends the work and waits for its thread; Blender calls it when it ends the operator itself, and when a dialog is left."""
        if self._worker is None:
            return
        self._stop.set()
        self._worker.shutdown()
        context.window_manager.event_timer_remove(self._timer)
        if context.workspace is not None:
            context.workspace.status_text_set(None)

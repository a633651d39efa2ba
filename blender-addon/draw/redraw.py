# SPDX-License-Identifier: GPL-3.0-or-later
"""Redraws a viewport when its session has something new."""

import weakref

import bpy

PAUSE = 0.03


def show_report(context) -> None:
    """Has the places that show the report drawn again: the viewport's header, and the properties."""
    for area in context.screen.areas:
        if area.type == "PROPERTIES":
            area.tag_redraw()
    for region in context.area.regions:
        if region.type == "HEADER":
            region.tag_redraw()


def start(engine) -> None:
    """Watches an engine's viewport session until the engine is gone or its session is closed."""
    reference = weakref.ref(engine)

    def watch() -> float | None:
        engine = reference()
        try:
            session = engine.viewport if engine is not None else None
            if session is None:
                return None
            if session.is_waiting():
                engine.tag_redraw()
        except ReferenceError:
            # Blender has freed the engine under its Python object.
            return None
        return PAUSE

    bpy.app.timers.register(watch, first_interval=PAUSE)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes as final renders export them, for what is rendered beside Blender: Blender makes them for a render alone."""

from collections.abc import Iterator
from contextlib import contextmanager

import bpy
import gonio

from .. import report
from .final import FinalSession

# The slot of Blender's render result that stays empty, so that the last picture is still there.
SLOT = "Gonio Export"


class Handover:
    """A view layer's scene with its settings, and what is to be told about it, once a render has exported them."""

    def __init__(self) -> None:
        self.session = FinalSession(is_rendered=False)
        self.scene: gonio.Scene | None = None
        self.report = report.Report()

    def take(self, engine, depsgraph) -> None:
        """Takes what the session has exported."""
        self.scene, self.report = self.session.hand_over(engine, depsgraph)


_awaited: Handover | None = None


def awaited() -> Handover | None:
    """What the render under way is to export for, in place of a picture."""
    return _awaited


def exported(scene, view_layer) -> Handover:
    """Exports a view layer at the current frame; raises RuntimeError with what Blender or the export says is wrong."""
    global _awaited
    _awaited = handed = Handover()
    try:
        with _as_it_is(scene.render), _last_picture_kept():
            bpy.ops.render.render(scene=scene.name, layer=view_layer.name)
    except RuntimeError as problem:
        raise RuntimeError(str(problem).strip().removeprefix("Error: ")) from None
    finally:
        _awaited = None
    if handed.scene is None:
        raise RuntimeError("Blender did not render the scene")
    return handed


@contextmanager
def _as_it_is(render) -> Iterator[None]:
    """A render of the scene itself, which no strip replaces and after which the compositor writes no files."""
    switches = {name: getattr(render, name) for name in ("use_compositing", "use_sequencer")}
    for name in switches:
        setattr(render, name, False)
    try:
        yield
    finally:
        for name, value in switches.items():
            setattr(render, name, value)


@contextmanager
def _last_picture_kept() -> Iterator[None]:
    """A render whose result goes into a slot of its own."""
    image = next((image for image in bpy.data.images if image.type == "RENDER_RESULT"), None)
    if image is None:
        yield
        return
    slots, shown = image.render_slots, image.render_slots.active_index
    # These slots cannot be looked up by name.
    slots.active = next((slot for slot in slots if slot.name == SLOT), None) or slots.new(name=SLOT)
    try:
        yield
    finally:
        slots.active_index = shown

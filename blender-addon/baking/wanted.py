# SPDX-License-Identifier: GPL-3.0-or-later
"""What the bake under way is to be beside what Blender's operator can say."""

import bpy
from bpy.app.handlers import persistent

# A kind in place of the one that Blender's operator names; empty for that.
kind = ""
_number = 0


def number() -> int:
    """Another number each time."""
    global _number
    _number += 1
    return _number


def set_kind(name: str) -> None:
    """Says what the next bake is."""
    global kind
    kind = name


@persistent
def _over(*_arguments) -> None:
    set_kind("")


def register() -> None:
    for handlers in (bpy.app.handlers.object_bake_complete, bpy.app.handlers.object_bake_cancel):
        handlers.append(_over)


def unregister() -> None:
    for handlers in (bpy.app.handlers.object_bake_complete, bpy.app.handlers.object_bake_cancel):
        handlers.remove(_over)

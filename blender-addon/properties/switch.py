# SPDX-License-Identifier: GPL-3.0-or-later
"""The form of properties that scenes, view layers and lights share."""

from bpy.props import BoolProperty


def switch(name, description, update, *, default=False):
    """A property that is off until someone switches it on, unless said otherwise; `update` tells Blender of it."""
    return BoolProperty(name=name, description=description, default=default, update=update)

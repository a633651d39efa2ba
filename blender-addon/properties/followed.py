# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings that are Cycles' until they are set here: files made for Cycles are rendered with them as they are."""

from bpy.props import BoolProperty, FloatProperty


def followed(settings, name):
    """The value of a setting of `scene.gonio`; that of `scene.cycles` where it was never set and Cycles is there."""
    if not settings.is_property_set(name):
        return getattr(getattr(settings.id_data, "cycles", None), name, getattr(settings, name))
    return getattr(settings, name)


def shown_switch(label, description, name):
    """What a panel shows of a switch that is followed; to set it sets the switch."""
    return BoolProperty(name=label, description=description, get=_get(name), set=_set(name), options={"SKIP_SAVE"})


def shown_share(label, description, name):
    """The same of a number from 0 to 1."""
    return FloatProperty(name=label, description=description, min=0.0, max=1.0, get=_get(name), set=_set(name), options={"SKIP_SAVE"})


def _get(name):
    return lambda settings: followed(settings, name)


def _set(name):
    return lambda settings, value: setattr(settings, name, value)

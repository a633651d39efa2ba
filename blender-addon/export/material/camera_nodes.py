# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates of the camera: the Camera Data node, and what other nodes take from it."""

from ..surroundings import CAMERA, Eye
from .inputs import applied, hit
from .translator import value_node

# Looks along +z from the world's origin: before there is a camera.
NO_CAMERA = Eye(((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0)), None)


def eye(t):
    """The camera that a material is seen by; None for worlds and lamps, which are the same for all."""
    if t.kind != "Material":
        return None
    return t.ask(CAMERA) or NO_CAMERA


def in_camera(t):
    """The hit in the camera's space; None where there is none."""
    seen_by = eye(t)
    return None if seen_by is None else applied(t, seen_by.space, hit(t, "Position"))


def in_picture(t):
    """The hit in the picture, 0 to 1 from its lower left corner; None where that is not to be had."""
    seen_by = eye(t)
    if seen_by is None or (seen_by.picture is None and seen_by is not NO_CAMERA):
        return None
    place = applied(t, seen_by.picture or seen_by.space, hit(t, "Position"))
    across = place / place.component(2)
    return t.graph.combine(across.component(0), across.component(1), t.graph.scalar(0.0))


@value_node("ShaderNodeCameraData")
def camera_data(t, node, context, output):
    place = in_camera(t)
    if place is None:
        return None
    if output.identifier == "View Vector":
        return place.normalized()
    return place.component(2) if output.identifier == "View Z Depth" else place.length()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Coordinates of the camera: the Camera Data node, and what other nodes take from it."""

from ..surroundings import CAMERA, Eye
from .inputs import applied, direction, hit
from .registry import value_node

# Looks along +z from the world's origin: before there is a camera.
NO_CAMERA = Eye(((1.0, 0.0, 0.0, 0.0), (0.0, 1.0, 0.0, 0.0), (0.0, 0.0, 1.0, 0.0)), None)


def eye(t):
    """The camera that a material or a world is seen by; None for lamps, which are the same for all."""
    if t.kind not in ("Material", "World"):
        return None
    return t.ask(CAMERA) or NO_CAMERA


def seen_in(t, rows):
    """The hit, or a world's direction, in a space of the camera's."""
    return applied(t, rows, direction(t), is_point=False) if t.is_world else applied(t, rows, hit(t, "Position"))


def in_camera(t):
    """What is seen in the camera's space; None where there is no camera."""
    seen_by = eye(t)
    return None if seen_by is None else seen_in(t, seen_by.space)


def in_picture(t):
    """What is seen in the picture, 0 to 1 from its lower left corner; None where that is not to be had."""
    seen_by = eye(t)
    if seen_by is None or (seen_by.picture is None and seen_by is not NO_CAMERA):
        return None
    rows = seen_by.picture or seen_by.space
    if t.is_world and not any(rows[2][:3]):
        # All that a camera without perspective sees of a world lies in one direction.
        return None
    place = seen_in(t, rows)
    across = place / place.component(2)
    return t.graph.combine(across.component(0), across.component(1), t.graph.scalar(0.0))


@value_node("ShaderNodeCameraData")
def camera_data(t, node, context, output):
    place = None if t.is_world else in_camera(t)
    if place is None:
        return None
    if output.identifier == "View Vector":
        return place.normalized()
    return place.component(2) if output.identifier == "View Z Depth" else place.length()

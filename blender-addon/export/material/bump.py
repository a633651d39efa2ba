# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals bent by heights: the Bump node, and displacement as bump."""

from .inputs import normal_of
from .sockets import input_socket
from .registry import value_node

# The share of a pixel between two heights where nothing else is said.
USUAL_WIDTH = 0.1


def bent_by(t, smooth, height, width=USUAL_WIDTH, distance=1.0, strength=1.0, steps=None):
    """Mikkelsen's surface gradient (2010), from heights a part of a pixel beside the hit; `height` computes one where it is asked. `steps`
    are the ways to the next pixels in the space of the normal, the world unless given."""
    if width <= 0.0:
        return smooth
    here = height()
    rise = [t.stepped(axis, width, height) - here for axis in (0, 1)]
    if all(each.is_zero() for each in rise):
        return smooth
    steps = steps or [t.step(0), t.step(1)]
    across = [steps[1].cross(smooth), smooth.cross(steps[0])]
    area = steps[0].dot(across[0])
    gradient = (across[0] * rise[0] + across[1] * rise[1]) * (1.0 / width)
    bent = (smooth * abs(area) - gradient * (area.sign() * distance)).normalized()
    strength = t.graph.value(strength)
    return bent if strength.equals(1.0) else smooth.mix(bent, strength).normalized()


@value_node("ShaderNodeBump")
def bump(t, node, context, output):
    distance = t.input(node, "Distance", context, 1.0) * (-1.0 if node.invert else 1.0)
    strength = t.input(node, "Strength", context, 1.0).maximum(0.0)
    smooth = normal_of(t, node, context)
    return bent_by(t, smooth, lambda: t.input(node, "Height", context), _width(t, node, context), distance, strength)


def _width(t, node, context):
    """As in Cycles a width that varies has no effect, and the one that the socket keeps beside its link counts."""
    width = t.input(node, "Filter Width", context, USUAL_WIDTH)
    if width.is_constant:
        return width.constant[0]
    return input_socket(node, "Filter Width").default_value

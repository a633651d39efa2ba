# SPDX-License-Identifier: GPL-3.0-or-later
"""The Radial Tiling node (Blender 5.0 on): a polygon's segments about the origin, each with coordinates of its own."""

from math import pi

from .translator import value_node

TURN = 2.0 * pi


@value_node("ShaderNodeRadialTiling")
def radial_tiling(t, node, context, output):
    """Polygons with sharp corners; where the number of sides is not whole the last segment is narrower."""
    place, sides = t.input(node, "Vector", context), t.input(node, "Sides", context, 5.0).maximum(2.0)
    if not t.input(node, "Roundness", context).is_zero():
        t.tell("round tiling", node, context)
    x, y = place.component(0), place.component(1)
    turned = y.apply("ArcTangent2", x) * (1.0 / TURN) + y.less(0.0)
    number = (turned * sides).floor()
    if output.name == "Segment ID":
        return number
    half = t.graph.value(pi) / sides
    angle = turned * TURN - number * half * 2.0
    last = pi - sides.floor() * half
    is_last = 1.0 - (turned * TURN).less(TURN - last * 2.0)
    if sides.is_constant and not sides.constant[0] % 1.0:
        is_last = t.graph.scalar(0.0)
    middle = half.mix(last, is_last)
    if output.name == "Segment Rotation":
        return number * half * 2.0 + middle
    width = _tangent(middle)
    if output.name == "Segment Width":
        return width
    squeezed = half.apply("Cosine") / middle.apply("Cosine")
    away = (x * x + y * y).sqrt() * (middle - angle).apply("Cosine") * squeezed
    along = away * _tangent(angle - middle)
    if node.normalize:
        return t.graph.combine(along / (away * width) * 0.5 + 0.5, away, t.graph.scalar(0.0))
    return t.graph.combine(along, away - 1.0, t.graph.scalar(0.0))


def _tangent(angle):
    return angle.apply("Sine") / angle.apply("Cosine")

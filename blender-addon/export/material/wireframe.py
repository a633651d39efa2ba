# SPDX-License-Identifier: GPL-3.0-or-later
"""The Wireframe node: how near the hit is to the edges of its triangle."""

from .inputs import TRIANGLE, carried, hit
from .tangent_nodes import of_mesh
from .registry import value_node


@value_node("ShaderNodeWireframe")
def wireframe(t, node, context, output):
    if t.kind != "Material":
        return t.graph.scalar(0.0)
    half = t.input(node, "Size", context, 0.01) * 0.5
    if node.use_pixel_size:
        half = half * ((_across(t, 0) + _across(t, 1)) * 0.5)
    place, near = hit(t, "Position"), half * half
    corners = [carried(t, of_mesh(t, name), "Object", "World", "Point") for name in TRIANGLE]
    away = t.graph.scalar(1.0)
    for number, corner in enumerate(corners):
        edge = corner - corners[number - 1]
        across = edge.cross(place - corner)
        away = away * (1.0 - across.dot(across).less(edge.dot(edge) * near))
    return 1.0 - away


def _across(t, axis):
    """How wide a pixel is as seen from where the ray came from."""
    step, incoming = t.step(axis), hit(t, "Incoming")
    return (step - incoming * step.dot(incoming)).length()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Displacement of the material's output as a bent normal, and the nodes that compute it."""

from .bump import bent_by
from .inputs import UV, carried, hit, normal_of
from .sockets import input_socket
from .tangent_nodes import tangent_of
from .translator import value_node


def bend(t, end, material):
    """Bends the normals of everything that is translated from now on as Cycles does for displacement by bump alone."""
    if not t.linked(end, "Displacement", t.root):
        return
    if getattr(material, "displacement_method", "BUMP") != "BUMP":
        t.tell("displacement", end, t.root)
    smooth, moved = hit(t, "Normal"), input_socket(end, "Displacement")
    bent = bent_by(t, smooth, lambda: t.socket(moved, t.root).as_kind("VECTOR").dot(smooth))
    if bent.node != smooth.node:
        t.bend(bent)


@value_node("ShaderNodeDisplacement")
def displacement(t, node, context, output):
    height = (t.input(node, "Height", context) - t.input(node, "Midlevel", context, 0.5)) * t.input(node, "Scale", context, 1.0)
    normal = normal_of(t, node, context)
    if node.space == "WORLD":
        return normal * height
    return carried(t, carried(t, normal, "World", "Object", "Normal") * height, "Object", "World", "Vector")


@value_node("ShaderNodeVectorDisplacement")
def vector_displacement(t, node, context, output):
    vector = t.input(node, "Vector", context).as_kind("VECTOR")
    moved = (vector - t.input(node, "Midlevel", context)) * t.input(node, "Scale", context, 1.0)
    if node.space == "WORLD":
        return moved
    if node.space == "TANGENT":
        along, normal = tangent_of(t, UV), carried(t, hit(t, "Normal"), "World", "Object", "Normal")
        across = normal.cross(along).normalized() * along.component(3)
        moved = along * moved.component(0) + normal * moved.component(1) + across * moved.component(2)
    return carried(t, moved, "Object", "World", "Vector")

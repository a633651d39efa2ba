# SPDX-License-Identifier: GPL-3.0-or-later
"""Displacement of the material's output: points that move, normals that bend, and the nodes that compute it."""

from .bump import bent_by
from .inputs import UV, carried, hit, normal_of
from .sockets import input_socket
from .tangent_nodes import tangent_of
from .registry import value_node


def displace(t, end, material):
    """What the surface is moved by, for methods that move it; bends the normals of everything that is translated from now on as Cycles does
    for displacement by bump. Gives the description of the displacement, or None."""
    if not t.linked(end, "Displacement", t.root):
        return None
    method = getattr(material, "displacement_method", "BUMP")
    socket = input_socket(end, "Displacement")
    moved, found = method in ("DISPLACEMENT", "BOTH"), None
    if moved:
        with t.at_rest():
            value = t.socket(socket, t.root).as_kind("VECTOR")
        if not value.is_zero():
            found = {"value": value.input(), "kind": "World", "keep_normals": method == "BOTH"}
    if method != "DISPLACEMENT":
        _bend(t, socket, moved)
    t.has_moved = found is not None
    return found


def _bend(t, socket, moved):
    """Normals bent by the heights of the surface as the mesh has it, before it moved."""
    smooth = hit(t, "Normal")

    def height():
        return t.socket(socket, t.root).as_kind("VECTOR").dot(smooth)

    if not moved:
        normal = bent_by(t, smooth, height)
        if normal.node != smooth.node:
            t.bend(normal)
        return
    # As in Cycles, in the object's space, though heights are the world's: under a scale normals bend otherwise than by bump alone.
    with t.at_rest():
        own = carried(t, smooth, "World", "Object", "Normal")
        normal = bent_by(t, own, height, steps=[carried(t, t.step(axis), "World", "Object", "Vector") for axis in (0, 1)])
        bent = carried(t, normal, "Object", "World", "Normal")
    if normal.node != own.node:
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

# SPDX-License-Identifier: GPL-3.0-or-later
"""Directions in the surface, and normals given by them: Normal Map and Tangent."""

from .inputs import GENERATED, SMOOTH_NORMAL, TANGENT, UV, carried, hit
from .registry import value_node


@value_node("ShaderNodeNormalMap")
def normal_map(t, node, context, output):
    colour = t.input(node, "Color", context).as_kind("VECTOR")
    strength = t.input(node, "Strength", context, 1.0).maximum(0.0)
    vector = colour * 2.0 - 1.0
    if getattr(node, "convention", "OPENGL") == "DIRECTX":
        vector = vector * (1.0, -1.0, 1.0)
    if node.space == "TANGENT":
        scale = t.graph.combine(strength, strength, strength.clamp())
        vector = vector * scale + t.graph.combine(t.graph.scalar(0.0), t.graph.scalar(0.0), 1.0 - strength.clamp())
        return _in_tangents(t, vector, node.uv_map or UV)
    if node.space.startswith("BLENDER_"):
        vector = vector * (1.0, -1.0, -1.0)
    if node.space.endswith("OBJECT"):
        vector = carried(t, vector, "Object", "World", "Normal")
    mapped = vector.normalized() * (hit(t, "FrontFacing") * 2.0 - 1.0)
    return mapped if strength.equals(1.0) else hit(t, "Normal").mix(mapped, strength).normalized()


def _in_tangents(t, vector, uv):
    """The shading normal that a vector in the space of a UV map's tangents stands for, on the side that is seen."""
    along, normal = tangent_of(t, uv), of_mesh(t, SMOOTH_NORMAL)
    if t.has_moved and t.bent is None:
        normal = carried(t, hit(t, "Normal") * (hit(t, "FrontFacing") * 2.0 - 1.0), "World", "Object", "Normal")
    across = normal.cross(along) * along.component(3)
    bent = along * vector.component(0) + across * vector.component(1) + normal * vector.component(2)
    return carried(t, bent, "Object", "World", "Normal") * (hit(t, "FrontFacing") * 2.0 - 1.0)


def tangent_of(t, uv):
    """The mesh's own tangent along a UV map, the side of v its fourth component."""
    return of_mesh(t, TANGENT + uv)


def of_mesh(t, name):
    """A value of the mesh as it is at the hit, also for heights beside it."""
    t.primvars.add(name)
    return t.graph.add({"Primvar": {"name": name, "fallback": [0.0] * 4}}, kind="VECTOR")


@value_node("ShaderNodeTangent")
def tangent(t, node, context, output):
    if t.kind != "Material":
        t.tell("lamp's tangent", node, context)
    if node.direction_type == "UV_MAP":
        return upright(t, tangent_of(t, node.uv_map or UV))
    return radial_tangent(t, node.axis)


def radial_tangent(t, axis="Z"):
    """The direction around one of the object's axes through the middle of its bounding box."""
    x, y, z = ((t.primvar(GENERATED) - 0.5).component(i) for i in range(3))
    zero = t.graph.scalar(0.0)
    around = {"X": (zero, -z, y), "Y": (-z, zero, x), "Z": (-y, x, zero)}[axis]
    return upright(t, t.graph.combine(*around))


def upright(t, tangent):
    """A direction in the mesh's own space as one in the world at right angles to the shading normal."""
    world = carried(t, tangent, "Object", "World", "Normal")
    shading = hit(t, "Normal")
    return shading.cross(world.cross(shading).normalized())

# SPDX-License-Identifier: GPL-3.0-or-later
"""What the Object, Particle, Point and Volume Info nodes know of a placement; Point Info knows nothing of meshes."""

from ..random_number import of_words
from .inputs import COLOUR, FACTOR, INDEX, LOCATION, PARTICLE, RANDOM
from .registry import value_node


@value_node("ShaderNodeObjectInfo")
def object_info(t, node, context, output):
    name = output.identifier
    if name == "Material Index":
        return t.graph.scalar(getattr(t.owner, "pass_index", 0))
    if t.kind != "Material":
        return None
    names = {"Random": (RANDOM, "VALUE"), "Location": (LOCATION, "VECTOR"), "Object Index": (INDEX, "VALUE"), "Color": (COLOUR, "RGBA")}
    if name == "Alpha":
        return t.instance_primvar(COLOUR, "RGBA").component(3)
    return t.instance_primvar(*names[name]) if name in names else None


@value_node("ShaderNodeParticleInfo")
def particle_info(t, node, context, output):
    kind = "VECTOR" if output.type == "VECTOR" else "VALUE"
    if t.kind == "Material":
        return t.instance_primvar(PARTICLE + output.identifier, kind)
    # Lamps and worlds are of the particle that is none, which has a random number all the same.
    return t.graph.scalar(of_words(0, 0) / 0xFFFFFFFF if output.identifier == "Random" else 0.0)


@value_node("ShaderNodePointInfo")
def point_info(t, node, context, output):
    """As in Cycles zero on whatever is no point."""
    return t.graph.scalar(0.0)


@value_node("ShaderNodeVolumeInfo")
def volume_info(t, node, context, output):
    """The grids of Blender's own names; as in Cycles zero on whatever is no volume."""
    if not t.has_grids:
        return t.graph.scalar(0.0)
    name = output.identifier.lower()
    return t.primvar(name, kind="RGBA") if name == "color" else t.primvar(FACTOR + name, kind="VALUE")

# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes that look around the hit with rays of their own."""

from ..surroundings import OCCLUSION
from .inputs import hit, normal_of
from .registry import value_node

# How far Cycles looks for occlusion in a scene without a world.
FARTHEST = 10.0


@value_node("ShaderNodeAmbientOcclusion")
def ambient_occlusion(t, node, context, output):
    fields = {"samples": node.samples, "inside": node.inside, "only_local": node.only_local}
    normal, distance = normal_of(t, node, context), _distance(t, node, context)
    if t.kind != "Material":
        share = t.graph.scalar(1.0)
    else:
        share = t.graph.add({"Occlusion": fields}, normal, distance, kind="VALUE")
    return t.input(node, "Color", context) * share if output.identifier == "Color" else share


def _distance(t, node, context):
    """How far occlusion is looked for; a constant 0 stands for the world's distance."""
    own = t.input(node, "Distance", context, 1.0)
    if not own.is_constant or own.constant[0] != 0.0:
        return own
    of_world = t.ask(OCCLUSION)
    return t.graph.scalar(FARTHEST if of_world is None else of_world)


@value_node("ShaderNodeBevel")
def bevel(t, node, context, output):
    smooth = hit(t, "Normal")
    if t.kind != "Material":
        return normal_of(t, node, context)
    rounded = t.graph.add({"RoundedNormal": {"samples": node.samples}}, t.input(node, "Radius", context, 0.05), kind="VECTOR")
    if not t.linked(node, "Normal", context):
        return rounded
    return (t.input(node, "Normal", context) + (rounded - smooth)).normalized()

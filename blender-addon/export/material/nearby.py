# SPDX-License-Identifier: GPL-3.0-or-later
"""Nodes for which Cycles looks around the hit with rays of their own; here nothing is near."""

from .inputs import normal_of
from .translator import value_node


@value_node("ShaderNodeAmbientOcclusion")
def ambient_occlusion(t, node, context, output):
    """Unoccluded: the colour as it is."""
    t.tell("occlusion", node, context)
    return t.input(node, "Color", context) if output.identifier == "Color" else t.graph.scalar(1.0)


@value_node("ShaderNodeBevel")
def bevel(t, node, context, output):
    t.tell("bevel", node, context)
    return normal_of(t, node, context)

# SPDX-License-Identifier: GPL-3.0-or-later
"""The Measured BSDF node."""

import gonio

from ...nodes.measured import GonioShaderNodeMeasured, file_of
from .closures import closure, normal_node
from .registry import closure_node


@closure_node(GonioShaderNodeMeasured.bl_idname)
def measured(t, node, context):
    """The file's closure; None, with a report line, where the shader inside the node has to stand in."""
    if not node.filepath:
        t.say(node, context, "no file is chosen; its fallback is used")
        return None
    try:
        number = t.measurements.number(file_of(node))
    except (OSError, gonio.Error) as problem:
        t.say(node, context, f"{problem}; its fallback is used")
        return None
    tangent = t.graph.node_of(t.input(node, "Tangent", context)) if t.linked(node, "Tangent", context) else None
    return [
        closure(
            t.graph,
            "Measured",
            base_color=t.input(node, "Tint", context),
            specular_scale=t.input(node, "Scale", context, 1.0),
            specular_rotation=t.input(node, "Rotation", context),
            normal=normal_node(t, node, context),
            tangent=tangent,
            measured=number,
        )
    ]

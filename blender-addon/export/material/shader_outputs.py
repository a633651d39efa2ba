# SPDX-License-Identifier: GPL-3.0-or-later
"""AOV Output nodes: values of a material for passes of their own, wherever in the tree or its groups they stand."""

from .sockets import Context


def shader_outputs(t, names):
    """Descriptions of the outputs of these names."""
    return [
        {"name": node.aov_name, "color": t.input(node, "Color", context).input(), "value": t.input(node, "Value", context).input()}
        for node, context in outputs_of(t.root)
        if node.aov_name in names
    ]


def outputs_of(context: Context, without=None):
    """AOV Output nodes of a tree and of the groups in it, with their contexts; `without` has the names of groups that were seen to hold none."""
    without, found = set() if without is None else without, False
    for node in context.tree.nodes:
        if node.mute:
            continue
        if node.bl_idname == "ShaderNodeOutputAOV":
            found = True
            yield node, context
        elif node.type == "GROUP" and node.node_tree is not None and node.node_tree.name_full not in without:
            for inner in outputs_of(context.child(node), without):
                found = True
                yield inner
    if not found:
        without.add(context.tree.name_full)

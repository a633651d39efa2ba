# SPDX-License-Identifier: GPL-3.0-or-later
"""Walking Blender's node trees: links through reroutes, muted nodes and groups."""

KINDS = {"VALUE": "VALUE", "INT": "VALUE", "BOOLEAN": "VALUE", "VECTOR": "VECTOR", "ROTATION": "VECTOR", "RGBA": "RGBA"}

# Nodes that Cycles does not have: what they are linked to counts as unlinked.
ABSENT = {"ShaderNodeShaderToRGB", "ShaderNodeSqueeze", "ShaderNodeUVAlongStroke", "ShaderNodeEeveeSpecular"}


class Context:
    """A node tree as it is used at one place: the group node that holds it, and the context of that node."""

    def __init__(self, tree, group=None, parent=None):
        self.tree, self.group, self.parent = tree, group, parent
        self._children = {}

    def child(self, group):
        """The context inside a group node; the same object for the same node."""
        if group.name not in self._children:
            self._children[group.name] = Context(group.node_tree, group, self)
        return self._children[group.name]

    def groups(self):
        """The group nodes around, the outermost first."""
        return [] if self.parent is None else [*self.parent.groups(), self.group]


def input_socket(node, name):
    """The input with this identifier, else the first enabled one with this name, else None."""
    named = None
    for socket in node.inputs:
        if socket.identifier == name:
            return socket
        if socket.name == name and (named is None or not named.enabled):
            named = socket
    return named


def link_into(socket):
    """The link that feeds an input, if one does."""
    if not socket.is_linked:
        return None
    return next((link for link in socket.links if link.is_valid and not link.is_muted), None)


def follow(socket, context):
    """Where an input's value comes from: (node, output socket, context), or (None, unlinked input, context), or None for nothing at all."""
    for _ in range(10_000):
        link = link_into(socket)
        if link is None:
            return None, socket, context
        node, output = link.from_node, link.from_socket
        if node.bl_idname == "NodeReroute":
            socket = node.inputs[0]
        elif node.mute:
            socket = next((l.from_socket for l in node.internal_links if l.to_socket == output), None)
            if socket is None:
                return None
        elif node.bl_idname == "NodeGroupInput":
            if context.parent is None:
                return None
            socket, context = input_socket(context.group, output.identifier), context.parent
            if socket is None:
                return None
        elif node.type == "GROUP":
            inner = group_output(node, output, context)
            if inner is None:
                return None
            socket, context = inner
        else:
            return node, output, context
    return None


def group_output(node, output, context):
    """The input of a group's output node that stands behind one of the group's outputs, with its context."""
    if node.node_tree is None or len(context.groups()) > 64:
        return None
    outputs = [n for n in node.node_tree.nodes if n.bl_idname == "NodeGroupOutput"]
    end = next((n for n in outputs if n.is_active_output), outputs[0] if outputs else None)
    socket = input_socket(end, output.identifier) if end else None
    return None if socket is None else (socket, context.child(node))


def active_output(tree, kind):
    """The output node that a render engine like Cycles uses: kind is Material, World or Light."""
    nodes = [n for n in tree.nodes if n.bl_idname == f"ShaderNodeOutput{kind}" and not n.mute]
    for target in ("CYCLES", "ALL"):
        fitting = [n for n in nodes if n.target == target]
        if fitting:
            return next((n for n in fitting if n.is_active_output), fitting[0])
    return nodes[0] if nodes else None

# SPDX-License-Identifier: GPL-3.0-or-later
"""Walking Blender's node trees: links through reroutes, muted nodes and groups."""

from typing import NamedTuple

KINDS = {"VALUE": "VALUE", "INT": "VALUE", "BOOLEAN": "VALUE", "VECTOR": "VECTOR", "ROTATION": "VECTOR", "RGBA": "RGBA"}

# Nodes that Cycles does not have: what they are linked to counts as unlinked.
ABSENT = {"ShaderNodeShaderToRGB", "ShaderNodeSqueeze", "ShaderNodeUVAlongStroke", "ShaderNodeEeveeSpecular"}


# Nodes that compute nothing and that lead on: bl_idname -> function(node, output, context) -> (socket, context), or None.
THROUGH = {}
# The output of Repeat Input that numbers the turns.
ITERATION = "Iteration"


class Found(NamedTuple):
    """Where a value comes from: a node's output, or an unlinked input with no node; and the kinds of sockets it passes, from its end."""

    node: object
    output: object
    context: object
    kinds: list


class Context:
    """A node tree as it is used at one place: the group node that holds it, the context of that node, and what zones it is within."""

    def __init__(self, tree, group=None, parent=None):
        self.tree, self.group, self.parent, self.depth = tree, group, parent, 0
        # The translator, for numbers that decide about the structure; the outermost context has it.
        self.translator = None
        self._children, self._bound = {}, {}

    def child(self, group):
        """The context inside a group node; the same object for the same node."""
        if group.name not in self._children:
            self._children[group.name] = Context(group.node_tree, group, self)
        return self._children[group.name]

    def inside(self, key, start, bound):
        """The same tree within a zone, where the zone's first node stands for `bound`; the same object for the same key."""
        if key not in self._children:
            made = self._children[key] = Context(self.tree, self.group, self.parent)
            made.depth, made.translator = self.depth + 1, self.translator
            made._bound = self._bound if start is None else {**self._bound, start.name: bound}
        return self._children[key]

    def bound(self, start):
        """What a zone's first node stands for; None outside of the zone."""
        return self._bound.get(start.name)

    def outermost(self):
        """The context of the material's own tree."""
        return self if self.parent is None else self.parent.outermost()

    def number(self, socket):
        """The constant that reaches a socket; None if it varies."""
        translator = self.outermost().translator
        value = None if translator is None or socket is None else translator.socket(socket, self)
        return value.constant[0] if value is not None and value.is_constant else None

    def tell(self, limit, node):
        """The report line of an entry of the table of limits."""
        if (translator := self.outermost().translator) is not None:
            translator.tell(limit, node, self)

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
    """Where an input's value comes from; None for nothing at all."""
    kinds = []
    for _ in range(10_000):
        link = link_into(socket)
        if link is None:
            return Found(None, socket, context, kinds)
        node, output = link.from_node, link.from_socket
        if node.bl_idname == "NodeReroute":
            socket = node.inputs[0]
            continue
        kind = KINDS.get(output.type)
        if node.mute:
            socket = next((l.from_socket for l in node.internal_links if l.to_socket == output), None)
        elif node.bl_idname == "NodeGroupInput":
            socket = None if context.parent is None else input_socket(context.group, output.identifier)
            context = context.parent
        elif node.type == "GROUP":
            socket, context = group_output(node, output, context) or (None, None)
        else:
            onwards = THROUGH[node.bl_idname](node, output, context) if node.bl_idname in THROUGH else None
            if onwards is None:
                return Found(node, output, context, kinds)
            socket, context = onwards
        if socket is None:
            return None
        if kind is not None:
            kinds.append(kind)
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

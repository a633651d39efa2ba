# SPDX-License-Identifier: GPL-3.0-or-later
"""Zones, bundles and switches of shader trees (Blender 5.0 on): followed like links, as none of them computes anything itself."""

from .sockets import ITERATION, THROUGH, follow, input_socket
from .registry import value_node

# More turns of a repeat zone than this are left out.
MOST_TURNS = 512
# Zones within zones, or closures that evaluate one another.
DEEPEST_ZONE = 64


def named(sockets, name):
    """The socket with a name; None if there is none."""
    return next((socket for socket in sockets if socket.name == name and socket.type != "CUSTOM"), None)


def end_of(start):
    """The node that ends the zone that a node begins."""
    return start.paired_output


def start_of(end, tree):
    """The node that begins the zone that a node ends."""
    return next((node for node in tree.nodes if getattr(node, "paired_output", None) == end), None)


def evaluated(node, output, context):
    """An output of Evaluate Closure: an input of the node that ends the closure's zone, seen from the evaluation."""
    found = follow(input_socket(node, "Closure"), context)
    if found is None or found.node is None or found.node.bl_idname != "NodeClosureOutput":
        return None
    end, around = found.node, found.context
    start, socket = start_of(end, around.tree), named(end.inputs, output.name)
    if socket is None or around.depth >= DEEPEST_ZONE:
        return None
    return socket, around.inside(("closure", end.name, node.name, id(context)), start, (node, context))


def argument(node, output, context):
    """An output of Closure Input: the input of the node that evaluates the closure."""
    bound = context.bound(node)
    if bound is None:
        return None
    socket = named(bound[0].inputs, output.name)
    return None if socket is None else (socket, bound[1])


def repeated(node, output, context):
    """An output of Repeat Output: what the last turn gives, or what the first would get."""
    start = start_of(node, context.tree)
    if start is None or context.depth >= DEEPEST_ZONE:
        return None
    return after(start, node, output.identifier, turns(start, context), context)


def turns(start, context):
    """How often a zone is gone through."""
    count = context.number(input_socket(start, "Iterations"))
    if count is None or count > MOST_TURNS:
        context.tell("repeat", start)
    return min(max(int(count or 0), 0), MOST_TURNS)


def after(start, end, item, count, around):
    """The item of a zone after so many turns: an input of its end within the last of them, or of its start."""
    if count == 0:
        socket = input_socket(start, item)
        return None if socket is None else (socket, around)
    socket = input_socket(end, item)
    return None if socket is None else (socket, around.inside(("repeat", end.name, count), start, (count, around)))


def before(node, output, context):
    """An output of Repeat Input within a turn: what the turn before gave; None for the number of the turn."""
    bound = context.bound(node)
    if bound is None or output.identifier == ITERATION:
        return None
    return after(node, end_of(node), output.identifier, bound[0] - 1, bound[1])


def unpacked(node, output, context):
    """An output of Separate Bundle: the item of that name of the bundle."""
    return item(input_socket(node, "Bundle"), output.name, context)


def item(bundle, name, context):
    """The input behind an item of what is linked to a bundle's socket."""
    found = None if bundle is None else follow(bundle, context)
    if found is None or found.node is None:
        return None
    if found.node.bl_idname == "NodeCombineBundle":
        socket = named(found.node.inputs, name)
        return None if socket is None else (socket, found.context)
    return None


def switched(node, output, context):
    """The chosen input of Menu Switch or Index Switch; None for outputs that tell whether an item is chosen."""
    if output.identifier != "Output":
        return None
    socket = named(node.inputs, choice(node, context)) if node.bl_idname == "GeometryNodeMenuSwitch" else _by_index(node, context)
    return None if socket is None else (socket, context)


def choice(node, context):
    """The name that a menu is set to."""
    found = follow(input_socket(node, "Menu"), context)
    return getattr(found.output, "default_value", "") if found is not None and found.node is None else ""


def _by_index(node, context):
    index = context.number(input_socket(node, "Index"))
    items = [socket for socket in node.inputs if socket.name.isdigit()]
    return items[int(index)] if index is not None and 0 <= int(index) < len(items) else None


THROUGH.update(
    {
        "NodeEvaluateClosure": evaluated,
        "NodeClosureInput": argument,
        "GeometryNodeRepeatOutput": repeated,
        "GeometryNodeRepeatInput": before,
        "NodeSeparateBundle": unpacked,
        "GeometryNodeMenuSwitch": switched,
        "GeometryNodeIndexSwitch": switched,
    }
)


@value_node("GeometryNodeRepeatInput")
def iteration(t, node, context, output):
    bound = context.bound(node)
    return t.graph.scalar(bound[0] - 1.0) if bound is not None and output.identifier == ITERATION else t.default_of(output, "VALUE")


@value_node("GeometryNodeMenuSwitch")
def is_chosen(t, node, context, output):
    return t.graph.scalar(1.0 if output.identifier != "Output" and output.name == choice(node, context) else 0.0)


@value_node("NodeEvaluateClosure", "NodeClosureInput", "NodeSeparateBundle", "GeometryNodeRepeatOutput", "GeometryNodeIndexSwitch")
def nothing(t, node, context, output):
    """Where nothing is behind an output: its own value."""
    return t.graph.scalar(0.0)

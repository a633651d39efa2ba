"""Trees of the catalogue's nodes of structure: each function returns the socket that is seen. For Blender."""

import bpy


def _doubled(made, tree, source, end) -> None:
    """A source times two and a half into an end."""
    twice = tree.nodes.new("ShaderNodeVectorMath")
    twice.operation = "MULTIPLY"
    twice.inputs[1].default_value = (2.5, 2.5, 2.5)
    tree.links.new(source, twice.inputs[0])
    tree.links.new(twice.outputs[0], end)


def group(made, node):
    """A group in a group that changes its input."""
    made.tree.nodes.remove(node)
    inner, outer = (bpy.data.node_groups.new(name, "ShaderNodeTree") for name in ("Inner", "Outer"))
    for tree in (inner, outer):
        for way in ("INPUT", "OUTPUT"):
            tree.interface.new_socket("Value", in_out=way, socket_type="NodeSocketVector")
    first, last = inner.nodes.new("NodeGroupInput"), inner.nodes.new("NodeGroupOutput")
    _doubled(made, inner, first.outputs[0], last.inputs[0])
    begin, held, end = (outer.nodes.new(kind) for kind in ("NodeGroupInput", "ShaderNodeGroup", "NodeGroupOutput"))
    held.node_tree = inner
    outer.links.new(begin.outputs[0], held.inputs[0])
    outer.links.new(held.outputs[0], end.inputs[0])
    used = made.new("ShaderNodeGroup", node_tree=outer)
    made.link(made.source("wide 0"), used.inputs[0])
    return used.outputs[0]


def reroute(made, node):
    """Two reroutes in a row."""
    made.tree.nodes.remove(node)
    first, second = made.new("NodeReroute"), made.new("NodeReroute")
    made.link(made.source("wide 0"), first.inputs[0])
    made.link(first.outputs[0], second.inputs[0])
    return second.outputs[0]


def frame(made, node):
    """A node in a frame."""
    held = made.new("ShaderNodeVectorMath", operation="ABSOLUTE", parent=node)
    made.link(made.source("wide 0"), held.inputs[0])
    return held.outputs[0]


def repeat(made, node):
    """A value that is changed three times."""
    made.tree.nodes.remove(node)
    begin, end = made.new("GeometryNodeRepeatInput"), made.new("GeometryNodeRepeatOutput")
    begin.pair_with_output(end)
    end.repeat_items.clear()
    end.repeat_items.new("VECTOR", "Value")
    begin.inputs["Iterations"].default_value = 3
    made.link(made.source("wide 0"), begin.inputs["Value"])
    _doubled(made, made.tree, begin.outputs["Value"], end.inputs["Value"])
    return end.outputs["Value"]


def closure(made, node):
    """A closure that is evaluated."""
    made.tree.nodes.remove(node)
    begin, end, used = made.new("NodeClosureInput"), made.new("NodeClosureOutput"), made.new("NodeEvaluateClosure")
    begin.pair_with_output(end)
    for items in (end.input_items, end.output_items, used.input_items, used.output_items):
        items.new("VECTOR", "Value")
    _doubled(made, made.tree, begin.outputs["Value"], end.inputs["Value"])
    made.link(end.outputs["Closure"], used.inputs["Closure"])
    made.link(made.source("wide 0"), used.inputs["Value"])
    return used.outputs["Value"]


def bundle(made, node):
    """A value that goes through a bundle."""
    made.tree.nodes.remove(node)
    together, apart = made.new("NodeCombineBundle"), made.new("NodeSeparateBundle")
    for items in (together.bundle_items, apart.bundle_items):
        items.new("VECTOR", "Value")
    made.link(made.source("wide 0"), together.inputs["Value"])
    made.link(together.outputs[0], apart.inputs[0])
    return apart.outputs["Value"]


def menu(made, node):
    """The second of two values."""
    node.data_type = "VECTOR"
    while len(node.enum_items) < 2:
        node.enum_items.new("More")
    made.link(made.source("wide 0"), node.inputs[1])
    made.link(made.source("wide 1"), node.inputs[2])
    node.inputs[0].default_value = node.enum_items[1].name
    return node.outputs[0]

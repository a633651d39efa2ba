"""Closures, bundles, repeat zones and menus in shader trees against Cycles (Blender 5.0 on), and kinds that groups change."""

import unittest

import pytest


def since_five():
    import bpy

    if bpy.app.version < (5, 0, 0):
        raise unittest.SkipTest("shader trees have no zones before 5.0")


class Tree:
    """A material under construction."""

    def __init__(self, name):
        from beside_cycles import shining

        self.made, self.tree, self.colour = shining(name)

    def new(self, kind, **fields):
        node = self.tree.nodes.new(kind)
        for name, value in fields.items():
            setattr(node, name, value)
        return node

    def link(self, output, socket):
        self.tree.links.new(output, socket)

    def math(self, operation, one, other):
        node = self.new("ShaderNodeMath", operation=operation)
        for socket, value in zip(node.inputs, (one, other), strict=False):
            self.link(value, socket) if hasattr(value, "links") else setattr(socket, "default_value", value)
        return node.outputs[0]

    def source(self, component=0):
        node, parts = self.new("ShaderNodeVertexColor", layer_name="a"), self.new("ShaderNodeSeparateXYZ")
        self.link(node.outputs[0], parts.inputs[0])
        return parts.outputs[component]


def closure():
    """A function of a number and of a value from outside, used twice, once with its argument left out."""
    t = Tree("closure")
    start, end = t.new("NodeClosureInput"), t.new("NodeClosureOutput")
    start.pair_with_output(end)
    end.input_items.new("FLOAT", "X")
    end.output_items.new("FLOAT", "Y")
    t.link(t.math("MULTIPLY", t.math("ADD", start.outputs[0], t.source(1)), 2.0), end.inputs[0])
    results = []
    for argument in (t.source(0), 0.25):
        call = t.new("NodeEvaluateClosure")
        call.input_items.new("FLOAT", "X")
        call.output_items.new("FLOAT", "Y")
        t.link(end.outputs[0], call.inputs[0])
        t.link(argument, call.inputs[1]) if hasattr(argument, "links") else setattr(call.inputs[1], "default_value", argument)
        results.append(call.outputs[0])
    t.link(t.math("SUBTRACT", results[0], results[1]), t.colour)
    return t.made


def repeat(count):
    """x → x · 0.5 + number of the turn."""

    def make():
        t = Tree("repeat")
        start, end = t.new("GeometryNodeRepeatInput"), t.new("GeometryNodeRepeatOutput")
        start.pair_with_output(end)
        if "X" not in [item.name for item in end.repeat_items]:
            end.repeat_items.new("FLOAT", "X")
        start.inputs["Iterations"].default_value = count
        t.link(t.source(), start.inputs["X"])
        t.link(t.math("ADD", t.math("MULTIPLY", start.outputs["X"], 0.5), start.outputs["Iteration"]), end.inputs["X"])
        t.link(end.outputs["X"], t.colour)
        return t.made

    return make


def bundle():
    t = Tree("bundle")
    packed, opened = t.new("NodeCombineBundle"), t.new("NodeSeparateBundle")
    for node in (packed, opened):
        for name in ("P", "Q") if node is packed else ("Q", "P"):
            node.bundle_items.new("FLOAT", name)
    t.link(t.source(0), packed.inputs["P"])
    packed.inputs["Q"].default_value = 0.75
    t.link(packed.outputs[0], opened.inputs[0])
    t.link(t.math("MULTIPLY", opened.outputs["P"], opened.outputs["Q"]), t.colour)
    return t.made


def menu(chosen):
    def make():
        t = Tree("menu")
        switch = t.new("GeometryNodeMenuSwitch")
        switch.enum_items.new("C")
        for socket, component in zip(switch.inputs[1:4], range(3), strict=True):
            t.link(t.source(component), socket)
        switch.inputs[0].default_value = chosen
        t.link(switch.outputs[0], t.colour)
        return t.made

    return make


def narrowed():
    """A group whose socket is a number, with a colour linked to it: before 5.0 it becomes one."""
    import bpy

    t = Tree("narrowed")
    group = bpy.data.node_groups.new("Number", "ShaderNodeTree")
    group.interface.new_socket("In", in_out="INPUT", socket_type="NodeSocketFloat")
    group.interface.new_socket("Out", in_out="OUTPUT", socket_type="NodeSocketColor")
    start, end = group.nodes.new("NodeGroupInput"), group.nodes.new("NodeGroupOutput")
    group.links.new(start.outputs[0], end.inputs[0])
    node, source = t.new("ShaderNodeGroup", node_tree=group), t.new("ShaderNodeVertexColor", layer_name="a")
    t.link(source.outputs[0], node.inputs[0])
    t.link(node.outputs[0], t.colour)
    return t.made


def values():
    import numpy as np

    return np.random.default_rng(6).uniform(0.3, 1.2, (20, 3))


@pytest.mark.blender
def test_zones_and_bundles_compute_what_cycles_computes(tmp_path):
    from beside_cycles import alike, board, both

    since_five()
    cases = {"closure": closure, "bundle": bundle, "repeat": repeat(4), "never": repeat(0), **{name: menu(name) for name in "ABC"}}
    board(cases, values())
    alike(both(tmp_path), cases, 20, 1e-6)


@pytest.mark.blender
def test_groups_change_kinds_as_in_cycles(tmp_path):
    from beside_cycles import alike, board, both

    board({"narrowed": narrowed}, values())
    alike(both(tmp_path), {"narrowed": narrowed}, 20, 1e-6)


@pytest.mark.blender
def test_shaders_pass_zones_and_what_has_no_end_ends():
    import bpy
    from recorder import translated

    since_five()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    t = Tree("shaders")
    start, end, call = t.new("NodeClosureInput"), t.new("NodeClosureOutput"), t.new("NodeEvaluateClosure")
    start.pair_with_output(end)
    end.output_items.new("SHADER", "S")
    call.output_items.new("SHADER", "S")
    t.link(t.new("ShaderNodeBsdfGlossy").outputs[0], end.inputs[0])
    t.link(end.outputs[0], call.inputs[0])
    surface = next(node for node in t.tree.nodes if node.bl_idname == "ShaderNodeOutputMaterial").inputs["Surface"]
    t.link(call.outputs[0], surface)
    description, lines = translated(t.made)
    assert [closure["model"] for closure in description["closures"]] == ["Glossy"] and not lines
    # A closure that evaluates itself.
    t.link(call.outputs[0], end.inputs[0])
    assert not translated(t.made)[0]["closures"]
    made = repeat(100_000)()
    description, lines = translated(made)
    assert "Repeat zones" in lines[0] and description["closures"], lines

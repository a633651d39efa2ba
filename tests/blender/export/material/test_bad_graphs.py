"""Shader graphs that make no sense, or far too much of it: a message and a picture within seconds, never a crash."""

import time

import pytest

# Of the processor, so that a busy machine does not count; one that waits for ever is ended by the limit of the child.
MOST_SECONDS = 20.0


def floor():
    """A new scene with a lit floor: the tree of its material, the Diffuse BSDF and the output."""
    import bpy
    import scenes

    scenes.lit_floor()
    tree = bpy.data.objects["Floor"].data.materials[0].node_tree
    return tree, find(tree, "ShaderNodeBsdfDiffuse"), find(tree, "ShaderNodeOutputMaterial")


def find(tree, kind):
    """The first node of a kind."""
    return next(node for node in tree.nodes if node.bl_idname == kind)


def shown(tmp_path):
    """The picture, which must be there in time; and the lines of the report."""
    from test_bad_input import picture, told

    start = time.process_time()
    found = picture(tmp_path)
    assert time.process_time() - start < MOST_SECONDS
    return found, told()


def group(name, *, inputs=("NodeSocketFloat",), outputs=("NodeSocketFloat",)):
    """A node group with sockets of these types; its two ends."""
    import bpy

    made = bpy.data.node_groups.new(name, "ShaderNodeTree")
    for way, kinds in (("INPUT", inputs), ("OUTPUT", outputs)):
        for number, kind in enumerate(kinds):
            made.interface.new_socket(f"{way} {number}", in_out=way, socket_type=kind)
    return made, made.nodes.new("NodeGroupInput"), made.nodes.new("NodeGroupOutput")


def used(tree, inner):
    """A group node."""
    made = tree.nodes.new("ShaderNodeGroup")
    made.node_tree = inner
    return made


def wide(levels, is_fan):
    """Ten nodes in each of ten groups, and so on: in a row, or side by side and added."""
    inner = None
    for level in range(levels):
        made, start, end = group(f"Level {level}")
        before = start.outputs[0]
        for number in range(10):
            node = used(made, inner) if inner else made.nodes.new("ShaderNodeMath")
            if not is_fan:
                made.links.new(before, node.inputs[0])
                before = node.outputs[0]
                continue
            # Each has another input, so that none is like the other.
            moved, total = made.nodes.new("ShaderNodeMath"), made.nodes.new("ShaderNodeMath")
            moved.inputs[1].default_value = 0.1 * number + level
            for source, target in ((start.outputs[0], moved), (moved.outputs[0], node), (node.outputs[0], total)):
                made.links.new(source, target.inputs[0])
            if number:
                made.links.new(before, total.inputs[1])
            before = total.outputs[0]
        made.links.new(before, end.inputs[0])
        inner = made
    return inner


@pytest.mark.blender
# What stands in for the row's beginning makes a roughness above 1, which is told too.
@pytest.mark.parametrize(("levels", "is_fan", "lines"), [(4, False, 2), (6, False, 2), (3, True, 0), (4, True, 0), (6, True, 1)])
def test_nodes_by_the_ten_thousand(tmp_path, levels, is_fan, lines):
    tree, shader, _ = floor()
    holder, place = used(tree, wide(levels, is_fan)), tree.nodes.new("ShaderNodeNewGeometry")
    tree.links.new(place.outputs["Position"], holder.inputs[0])
    tree.links.new(holder.outputs[0], shader.inputs["Roughness"])
    _, told = shown(tmp_path)
    assert len(told) == lines, told


@pytest.mark.blender
@pytest.mark.parametrize("kind", ["MixShader", "AddShader"])
def test_ways_that_double(tmp_path, kind):
    tree, shader, end = floor()
    for is_empty in (True, False):
        before = None if is_empty else shader.outputs[0]
        for _ in range(60):
            node = tree.nodes.new(f"ShaderNode{kind}")
            for socket in list(node.inputs)[-2:] if before else ():
                tree.links.new(before, socket)
            before = node.outputs[0]
        tree.links.new(before, end.inputs["Surface"])
        _, told = shown(tmp_path)
        assert told


@pytest.mark.blender
def test_shaders_in_groups_a_thousand_deep(tmp_path):
    tree, shader, end = floor()
    inner = None
    for level in range(4):
        made, start, stop = group(f"Level {level}", inputs=("NodeSocketShader",), outputs=("NodeSocketShader",))
        before = start.outputs[0]
        for _ in range(10):
            node = used(made, inner) if inner else made.nodes.new("ShaderNodeMixShader")
            made.links.new(before, node.inputs[0] if inner else node.inputs[1])
            if not inner:
                # All of the first shader, whose weight else would be nothing soon.
                node.inputs[0].default_value = 0.0
            before = node.outputs[0]
        made.links.new(before, stop.inputs[0])
        inner = made
    holder = used(tree, inner)
    tree.links.new(shader.outputs[0], holder.inputs[0])
    tree.links.new(holder.outputs[0], end.inputs["Surface"])
    _, told = shown(tmp_path)
    assert told


@pytest.mark.blender
def test_rings_of_links_and_of_groups(tmp_path):
    tree, shader, end = floor()
    # Of values, of reroutes, of muted nodes, and through a group that passes its input on.
    passing, start, stop = group("Passing")
    passing.links.new(start.outputs[0], stop.inputs[0])
    for kind, is_muted in (("ShaderNodeMath", False), ("NodeReroute", False), ("ShaderNodeMath", True), ("ShaderNodeGroup", False)):
        ring = [used(tree, passing) if kind == "ShaderNodeGroup" else tree.nodes.new(kind) for _ in range(3)]
        for number, node in enumerate(ring):
            node.mute = is_muted
            tree.links.new(ring[number - 1].outputs[0], node.inputs[0])
        tree.links.new(ring[0].outputs[0], ring[0].inputs[0])
        tree.links.new(ring[0].outputs[0], shader.inputs["Roughness"])
        shown(tmp_path)
    # A group in itself, and two in one another; Blender may refuse to make them.
    first, _, _ = group("First")
    second, _, _ = group("Second")
    for outer, inner in ((first, first), (first, second), (second, first)):
        try:
            used(outer, inner)
        except (RuntimeError, TypeError):
            continue
    holder = used(tree, first)
    tree.links.new(holder.outputs[0], shader.inputs["Roughness"])
    shown(tmp_path)
    # A surface that is its own input.
    mix = tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(mix.outputs[0], mix.inputs[1])
    tree.links.new(shader.outputs[0], mix.inputs[2])
    tree.links.new(mix.outputs[0], end.inputs["Surface"])
    shown(tmp_path)


@pytest.mark.blender
def test_groups_without_ends(tmp_path):
    import bpy

    tree, shader, end = floor()
    empty = bpy.data.node_groups.new("Empty", "ShaderNodeTree")
    no_output, _, stop = group("No output")
    no_output.nodes.remove(stop)
    no_input, start, _ = group("No input")
    no_input.nodes.remove(start)
    unlinked, _, _ = group("Unlinked")
    for inner in (no_output, no_input, unlinked):
        holder = used(tree, inner)
        tree.links.new(holder.outputs[0], shader.inputs["Roughness"])
        tree.links.new(holder.outputs[0], shader.inputs["Color"])
        shown(tmp_path)
    for inner in (empty, None):
        used(tree, inner)
        shown(tmp_path)
    surfaces, start, _ = group("Surfaces", outputs=("NodeSocketShader", "NodeSocketColor"))
    holder = used(tree, surfaces)
    tree.links.new(holder.outputs[0], end.inputs["Surface"])
    assert shown(tmp_path)[0].max() == 0.0
    # The sockets that the links went to are gone.
    surfaces.interface.clear()
    shown(tmp_path)
    bpy.data.node_groups.remove(surfaces)
    shown(tmp_path)
    tree.nodes.remove(end)
    found, told = shown(tmp_path)
    assert found.max() == 0.0 and told


@pytest.mark.blender
def test_chains_that_are_muted(tmp_path):
    tree, shader, end = floor()
    source = tree.nodes.new("ShaderNodeValue")
    source.outputs[0].default_value = 0.25
    before = source.outputs[0]
    for number in range(150):
        node = tree.nodes.new(("ShaderNodeMath", "ShaderNodeClamp", "NodeReroute")[number % 3])
        node.mute = True
        tree.links.new(before, node.inputs[0])
        before = node.outputs[0]
    tree.links.new(before, shader.inputs["Color"])
    found, told = shown(tmp_path)
    assert found.max() > 0.0 and not told
    # A muted group without a way through, a muted texture, a muted surface, and a muted output.
    inner, _, _ = group("Inner", inputs=())
    holder, noise = used(tree, inner), tree.nodes.new("ShaderNodeTexNoise")
    for node in (holder, noise):
        node.mute = True
        tree.links.new(node.outputs[0], shader.inputs["Color"])
        shown(tmp_path)
    shader.mute = True
    shown(tmp_path)
    end.mute = True
    shown(tmp_path)

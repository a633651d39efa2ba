"""Displacement as bump, and chains of Bump nodes, against Cycles: the normal that a surface comes to, one square for each case."""

import pytest


def slope(tree, x=0.3, y=0.2):
    """A height that rises evenly in the object's own coordinates."""
    place, product = tree.nodes.new("ShaderNodeTexCoord"), tree.nodes.new("ShaderNodeVectorMath")
    product.operation = "DOT_PRODUCT"
    tree.links.new(place.outputs["Object"], product.inputs[0])
    product.inputs[1].default_value = (x, y, 0.0)
    return product.outputs["Value"]


def moved(tree, end, kind, height=None, **fields):
    """A displacement node at the output; capitals are sockets."""
    node = tree.nodes.new(f"ShaderNode{kind}")
    for name, value in fields.items():
        if name[0].islower():
            setattr(node, name, value)
        else:
            node.inputs[name].default_value = value
    tree.links.new(height or slope(tree), node.inputs[0])
    tree.links.new(node.outputs[0], end.inputs["Displacement"])
    return node


def directions(tree):
    """A vector that varies in all components."""
    parts = tree.nodes.new("ShaderNodeCombineXYZ")
    for socket, (x, y) in zip(parts.inputs, ((0.1, 0.4), (0.3, 0.2), (-0.2, 0.5)), strict=True):
        tree.links.new(slope(tree, x, y), socket)
    return parts.outputs[0]


def bumps(tree):
    """Two bumps, one upon the other, of different widths."""
    first, second = tree.nodes.new("ShaderNodeBump"), tree.nodes.new("ShaderNodeBump")
    for node, x in ((first, 0.8), (second, -0.3)):
        node.inputs["Distance"].default_value = 0.7
        tree.links.new(slope(tree, x), node.inputs["Height"])
    first.inputs["Filter Width"].default_value, second.inputs["Strength"].default_value = 2.0, 0.6
    tree.links.new(slope(tree), second.inputs["Filter Width"])
    tree.links.new(first.outputs[0], second.inputs["Normal"])
    return second.outputs[0]


def below(tree, end):
    """A bump whose own normal is the displaced one."""
    moved(tree, end, "Displacement", Scale=1.0)
    return bumps_alone(tree)


def bumps_alone(tree):
    node = tree.nodes.new("ShaderNodeBump")
    node.inputs["Distance"].default_value = 1.0
    tree.links.new(slope(tree, -0.2, 0.7), node.inputs["Height"])
    return node.outputs[0]


CASES = {
    "object": lambda tree, end: moved(tree, end, "Displacement", Scale=0.8, Midlevel=0.3),
    "world": lambda tree, end: moved(tree, end, "Displacement", space="WORLD", Scale=0.8),
    "vector, object": lambda tree, end: moved(tree, end, "VectorDisplacement", directions(tree), space="OBJECT", Scale=0.8),
    "vector, world": lambda tree, end: moved(tree, end, "VectorDisplacement", directions(tree), space="WORLD", Scale=0.8),
    "vector, tangent": lambda tree, end: moved(tree, end, "VectorDisplacement", directions(tree), Scale=0.8, Midlevel=0.1),
    "number": lambda tree, end: tree.links.new(slope(tree), end.inputs["Displacement"]),
    "bumps": lambda tree, end: bumps(tree),
    "bump below": below,
    "bump without height": lambda tree, end: tree.nodes.new("ShaderNodeBump").outputs[0],
}


def square(name, case, place):
    """A square of a metre whose object is scaled, and that shines with its normal."""
    import bpy
    from beside_cycles import link, shining

    mesh = bpy.data.meshes.new(name)
    mesh.from_pydata([(0, 0, 0), (0.5, 0, 0), (0.5, 2, 0), (0, 2, 0)], [], [(0, 1, 2, 3)])
    mesh.uv_layers.new(name="Map").uv.foreach_set("vector", [0, 0, 1, 0, 1, 1, 0, 1])
    made, tree, colour = shining(name)
    end = next(node for node in tree.nodes if node.bl_idname == "ShaderNodeOutputMaterial")
    found = case(tree, end)
    is_normal = getattr(found, "type", "") == "VECTOR" and found.node.bl_idname == "ShaderNodeBump"
    shown = tree.nodes.new("ShaderNodeVectorMath")
    shown.operation = "MULTIPLY_ADD"
    shown.inputs[1].default_value = shown.inputs[2].default_value = (0.5, 0.5, 0.5)
    tree.links.new(found if is_normal else tree.nodes.new("ShaderNodeNewGeometry").outputs["Normal"], shown.inputs[0])
    tree.links.new(shown.outputs[0], colour)
    mesh.materials.append(made)
    thing = link(bpy.data.objects.new(name, mesh))
    thing.location, thing.scale = place, (2.0, 0.5, 1.5)
    return made


@pytest.mark.blender
def test_displacement_bends_normals_as_cycles_bends_them(tmp_path):
    import numpy as np
    from beside_cycles import both, scene

    scene(len(CASES))
    for number, (name, case) in enumerate(CASES.items()):
        square(name, case, (number - 0.5 * len(CASES), 0.0, 0.0))
    cycles, gonio = (picture[1] for picture in both(tmp_path))
    wrong = {name: (cycles[n], gonio[n]) for n, name in enumerate(CASES) if np.abs(cycles[n] - gonio[n]).max() > 1e-4}
    assert not wrong, wrong
    assert np.abs(cycles[: len(CASES) - 1, :2] - 0.5).max(axis=1).min() > 0.02 and cycles[:, 2].min() > 0.5


@pytest.mark.blender
def test_methods_move_the_surface_bend_its_normal_or_both():
    import bpy
    from recorder import translated

    bpy.ops.wm.read_factory_settings(use_empty=True)
    for method in ("DISPLACEMENT", "BOTH", "BUMP"):
        made = square(method, CASES["object"], (0, 0, 0))
        made.displacement_method = method
        description, lines = translated(made)
        assert not lines, lines
        moved, operations = description.get("displacement"), str([node["operation"] for node in description["graph"]["nodes"]])
        assert (moved is not None) == (method != "BUMP")
        assert moved is None or (moved["kind"], moved["keep_normals"]) == ("World", method == "BOTH")
        # Heights beside the hit are those of the surface as it was before it moved, the way there that of the moved one.
        assert ("PositionStep" in operations) == (method != "DISPLACEMENT")
        assert ("'PrimvarStep': {'name': 'blender position'" in operations) == (method != "DISPLACEMENT")


@pytest.mark.blender
def test_shaders_without_a_normal_of_their_own_have_the_displaced_one():
    import bpy
    from recorder import material, translated

    bpy.ops.wm.read_factory_settings(use_empty=True)
    made, tree, end = material()
    shader = tree.nodes.new("ShaderNodeBsdfPrincipled")
    shader.inputs["Coat Weight"].default_value = 1.0
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    moved(tree, end, "Displacement", Scale=1.0)
    (closure,) = translated(made)[0]["closures"]
    assert closure["normal"] is not None and closure["normal"] == closure["coat_normal"]
    tree.links.remove(end.inputs["Displacement"].links[0])
    (closure,) = translated(made)[0]["closures"]
    assert closure["normal"] is None and closure["coat_normal"] is None

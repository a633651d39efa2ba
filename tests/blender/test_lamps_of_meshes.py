"""Glowing meshes that look otherwise to rays of some kinds: as lamps they are sampled as even ones are, and noise is that of an even lamp."""

import pytest


def mixed(tree, usual, seen, output):
    """Two strengths, of which rays of one kind see the second: as a mixture of shaders."""
    path, mix = tree.nodes.new("ShaderNodeLightPath"), tree.nodes.new("ShaderNodeMixShader")
    tree.links.new(path.outputs[output], mix.inputs[0])
    for number, strength in ((1, usual), (2, seen)):
        glow = tree.nodes.new("ShaderNodeEmission")
        glow.inputs["Strength"].default_value = strength
        tree.links.new(glow.outputs[0], mix.inputs[number])
    return mix.outputs[0]


def by_strength(tree, usual, seen, output):
    """The same by the strength of one shader."""
    path, sum_, glow = (tree.nodes.new(f"ShaderNode{name}") for name in ("LightPath", "Math", "Emission"))
    sum_.operation = "MULTIPLY_ADD"
    sum_.inputs[1].default_value, sum_.inputs[2].default_value = seen - usual, usual
    tree.links.new(path.outputs[output], sum_.inputs[0])
    tree.links.new(sum_.outputs[0], glow.inputs["Strength"])
    return glow.outputs[0]


@pytest.mark.blender
@pytest.mark.parametrize("output", ["Is Camera Ray", "Is Diffuse Ray"])
@pytest.mark.parametrize("make", ["mixed", "by_strength"])
def test_lamps_of_meshes_are_sampled_whatever_rays_see_them(tmp_path, make, output):
    import bpy
    from beside_cycles import both, scene
    from recorder import material

    scene(16, 16, scale=4.0, samples=64)
    floor, tree, end = material("Floor")
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Surface"])
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.data.materials.append(floor)
    lamp, tree, end = material("Lamp")
    makers = {"mixed": mixed, "by_strength": by_strength}
    tree.links.new(makers[make](tree, 100.0, 0.5, output), end.inputs["Surface"])
    bpy.ops.mesh.primitive_plane_add(size=0.3, location=(-1.0, -1.0, 2.0))
    bpy.context.object.data.materials.append(lamp)
    cycles, gonio = both(tmp_path)
    # Half of the picture lies far from what the lamp covers.
    assert gonio[:, 8:] == pytest.approx(cycles[:, 8:], rel=0.05)

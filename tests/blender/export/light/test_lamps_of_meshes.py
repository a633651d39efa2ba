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


def by_image(tree):
    """Stripes of an image, dark ones among them."""
    import bpy
    import numpy as np

    stripes = np.ones((8, 8, 4), dtype=np.float32)
    stripes[:, ::2, :3] = 0.0, 0.25, 0.0
    image = bpy.data.images.new("Stripes", 8, 8, float_buffer=True)
    image.pixels.foreach_set(stripes.ravel())
    texture, glow = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeEmission")
    texture.image = image
    glow.inputs["Strength"].default_value = 100.0
    tree.links.new(texture.outputs["Color"], glow.inputs["Color"])
    return glow.outputs[0]


def by_checker(tree):
    """A half open Principled whose strength is a checkerboard."""
    checker, glow = tree.nodes.new("ShaderNodeTexChecker"), tree.nodes.new("ShaderNodeBsdfPrincipled")
    checker.inputs["Color1"].default_value, checker.inputs["Color2"].default_value = (200.0,) * 3 + (1.0,), (0.0, 0.0, 0.0, 1.0)
    for name, value in {"Emission Color": (1.0, 0.5, 0.2, 1.0), "Alpha": 0.5}.items():
        glow.inputs[name].default_value = value
    tree.links.new(checker.outputs["Color"], glow.inputs["Emission Strength"])
    return glow.outputs[0]


def by_object(tree):
    """A number of the object's own."""
    info, glow = tree.nodes.new("ShaderNodeObjectInfo"), tree.nodes.new("ShaderNodeEmission")
    glow.inputs["Strength"].default_value = 100.0
    tree.links.new(info.outputs["Color"], glow.inputs["Color"])
    return glow.outputs[0]


def by_side(tree):
    """Light on one side alone."""
    side, mix, glow = (tree.nodes.new(f"ShaderNode{name}") for name in ("NewGeometry", "MixShader", "Emission"))
    glow.inputs["Strength"].default_value = 100.0
    tree.links.new(side.outputs["Backfacing"], mix.inputs[0])
    tree.links.new(glow.outputs[0], mix.inputs[2])
    return mix.outputs[0]


def by_angle(tree):
    """More light to where it is seen at a grazing angle."""
    facing, glow = tree.nodes.new("ShaderNodeLayerWeight"), tree.nodes.new("ShaderNodeEmission")
    power = tree.nodes.new("ShaderNodeMath")
    power.operation, power.inputs[1].default_value = "MULTIPLY", 200.0
    tree.links.new(facing.outputs["Facing"], power.inputs[0])
    tree.links.new(power.outputs[0], glow.inputs["Strength"])
    return glow.outputs[0]


def lamp_over_floor(make):
    """A small plane of a material that `make` gives the shader of, over a large grey floor."""
    import bpy
    from recorder import material

    floor, tree, end = material("Floor")
    tree.links.new(tree.nodes.new("ShaderNodeBsdfDiffuse").outputs[0], end.inputs["Surface"])
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.data.materials.append(floor)
    lamp, tree, end = material("Lamp")
    tree.links.new(make(tree), end.inputs["Surface"])
    bpy.ops.mesh.primitive_plane_add(size=0.3, location=(-1.0, -1.0, 2.0))
    bpy.context.object.data.materials.append(lamp)


@pytest.mark.blender
@pytest.mark.parametrize("make", ["by_image", "by_checker", "by_object", "by_side", "by_angle"])
def test_meshes_that_glow_by_patterns_are_sampled(tmp_path, make):
    import bpy
    from beside_cycles import both, scene

    scene(16, 16, scale=4.0, samples=1024)
    makers = {"by_image": by_image, "by_checker": by_checker, "by_object": by_object, "by_side": by_side, "by_angle": by_angle}
    lamp_over_floor(makers[make])
    bpy.context.object.color = (0.2, 1.0, 0.4, 1.0)
    cycles, gonio = both(tmp_path)
    cycles, gonio = cycles[:, 8:], gonio[:, 8:]
    assert gonio.mean(axis=(0, 1)) == pytest.approx(cycles.mean(axis=(0, 1)), rel=0.01, abs=1e-6)
    # Cycles has noise of its own; found by chance there would be thirty times as much.
    assert gonio == pytest.approx(cycles, rel=0.1, abs=1e-6)


@pytest.mark.blender
@pytest.mark.parametrize("output", ["Is Camera Ray", "Is Diffuse Ray"])
@pytest.mark.parametrize("make", ["mixed", "by_strength"])
def test_lamps_of_meshes_are_sampled_whatever_rays_see_them(tmp_path, make, output):
    from beside_cycles import both, scene

    scene(16, 16, scale=4.0, samples=64)
    makers = {"mixed": mixed, "by_strength": by_strength}
    lamp_over_floor(lambda tree: makers[make](tree, 100.0, 0.5, output))
    cycles, gonio = both(tmp_path)
    # Half of the picture lies far from what the lamp covers.
    assert gonio[:, 8:] == pytest.approx(cycles[:, 8:], rel=0.05)

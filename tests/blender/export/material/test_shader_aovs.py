"""Shader AOVs: AOV Output nodes in the passes of a view layer, as Cycles fills them."""

import pytest

SIZE = 48


def aov(tree, name, source=None, socket="Color", value=None):
    """An AOV Output node that reads a socket, or holds a value."""
    node = tree.nodes.new("ShaderNodeOutputAOV")
    node.aov_name = name
    if source is not None:
        tree.links.new(source, node.inputs[socket])
    else:
        node.inputs[socket].default_value = value
    return node


def painted_plane():
    """A plane seen from above that leaves a border of the picture free: a material with outputs of an attribute, an image and a group."""
    import bpy
    import scenes

    scene = scenes.empty(width=SIZE, height=SIZE, samples=4)
    bpy.ops.mesh.primitive_plane_add(size=2.0)
    thing = bpy.context.object
    paint = thing.data.attributes.new("paint", "FLOAT_COLOR", "POINT")
    for number, entry in enumerate(paint.data):
        entry.color = (number / 4.0, 1.0 - number / 4.0, 2.0 * (number % 2), 0.5)
    picture = bpy.data.images.new("picture", 8, 8, float_buffer=True)
    picture.pixels.foreach_set([((x * y) % 5) / 4.0 if c < 3 else 1.0 for y in range(8) for x in range(8) for c in range(4)])
    material = scenes.diffuse("Painted", (0.5, 0.5, 0.5))
    thing.data.materials.append(material)
    tree = material.node_tree
    attribute, image = tree.nodes.new("ShaderNodeAttribute"), tree.nodes.new("ShaderNodeTexImage")
    attribute.attribute_name, image.image, image.interpolation = "paint", picture, "Closest"
    aov(tree, "paint", attribute.outputs["Color"])
    aov(tree, "paint number", attribute.outputs["Color"], "Value")
    aov(tree, "picture", image.outputs["Color"])
    aov(tree, "unwanted", image.outputs["Color"])
    inner = bpy.data.node_groups.new("Inner", "ShaderNodeTree")
    aov(inner, "from a group", value=0.75, socket="Value")
    tree.nodes.new("ShaderNodeGroup").node_tree = inner
    bpy.ops.object.camera_add(location=(0, 0, 5), rotation=(0, 0, 0))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 2.5
    for name, kind in KINDS.items():
        entry = scene.view_layers[0].aovs.add()
        entry.name, entry.type = name, kind
    return scene


KINDS = {"paint": "COLOR", "paint number": "VALUE", "picture": "COLOR", "from a group": "VALUE", "nowhere": "COLOR"}


@pytest.mark.blender
def test_passes_are_those_of_cycles(tmp_path):
    import numpy
    import scenes

    scene = painted_plane()
    # A filter so narrow that both look at the middles of pixels.
    scene.gonio.pixel_filter_type, scene.gonio.filter_width = "GAUSSIAN", 0.01
    scenes.render(tmp_path / "gonio.exr")
    found = scenes.read(tmp_path / "gonio.exr")
    scene.render.engine, scene.cycles.samples, scene.cycles.use_denoising = "CYCLES", 1, False
    scene.cycles.pixel_filter_type, scene.cycles.filter_width = "GAUSSIAN", 0.01
    scenes.render(tmp_path / "cycles.exr")
    expected = scenes.read(tmp_path / "cycles.exr")
    for name, kind in KINDS.items():
        for channel in "RGBA" if kind == "COLOR" else "X":
            mine, theirs = (channels[f"ViewLayer.{name}.{channel}"] for channels in (found, expected))
            # Edges of the plane and of texels may fall to either side of a pixel's middle.
            differing = numpy.abs(mine - theirs) > 2e-3
            assert differing.mean() < 0.01, (name, channel, differing.mean())
    assert found["ViewLayer.paint.R"].max() > 0.6 and found["ViewLayer.from a group.X"].max() == 0.75
    assert found["ViewLayer.nowhere.A"].max() == 0.0


@pytest.mark.blender
def test_materials_carry_only_what_the_view_layer_shows(tmp_path):
    import bpy
    from recorder import exporter, depsgraph

    painted_plane()
    made, report = exporter()
    names = ("paint", "from a group")
    made.sync(depsgraph(), shader_aovs=frozenset(names))
    (material,) = [each for each in made.scene.materials if each["origin"]["name"] == "Painted"]
    assert sorted(output["name"] for output in material["shader_outputs"]) == sorted(names)
    made.sync(depsgraph())
    (material,) = [each for each in made.scene.materials if each["origin"]["name"] == "Painted"]
    assert material["shader_outputs"] == [] and material["graph"]["nodes"] == []
    bpy.context.scene.world.node_tree.nodes.new("ShaderNodeOutputAOV")
    assert not report.diagnostics
    made.sync(depsgraph())
    assert any("worlds" in line.message for line in report.diagnostics)

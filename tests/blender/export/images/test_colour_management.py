"""Colours of files whose working space is wide, and images in spaces that gonio has no name for."""

import pytest

# ACEScg to linear Rec.709 by the Bradford transform, as in OpenColorIO's configurations.
FROM_ACESCG = ((1.70505, -0.62179, -0.08326), (-0.13026, 1.14080, -0.01055), (-0.02400, -0.12897, 1.15297))
COLOUR = (0.8, 0.1, 0.2)


def _in_rec709(colour):
    return [sum(a * b for a, b in zip(row, colour, strict=True)) for row in FROM_ACESCG]


def _acescg():
    """An empty file that works in ACEScg."""
    import unittest

    import bpy
    from scenes import empty

    scene = empty(width=16, height=16, samples=4)
    if not hasattr(bpy.data, "colorspace"):
        raise unittest.SkipTest("this Blender has one working space")
    bpy.ops.wm.set_working_color_space(working_space="ACEScg")
    assert bpy.data.colorspace.working_space == "ACEScg"
    return scene


@pytest.mark.blender
def test_sockets_lamps_and_ramps_come_in_as_rec709(tmp_path):
    import bpy
    from recorder import constant, depsgraph, exporter, link, material, quad, translated

    _acescg()
    made, tree, end = material()
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
    shader.inputs["Color"].default_value = (*COLOUR, 1.0)
    tree.links.new(shader.outputs[0], end.inputs["Surface"])
    assert constant(translated(made)[0]["closures"][0], "base_color")[:3] == pytest.approx(_in_rec709(COLOUR), abs=1e-4)
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    ramp.color_ramp.elements[0].color = ramp.color_ramp.elements[1].color = (*COLOUR, 1.0)
    tree.links.new(ramp.outputs[0], shader.inputs["Color"])
    assert constant(translated(made)[0]["closures"][0], "base_color")[:3] == pytest.approx(_in_rec709(COLOUR), abs=1e-4)
    mesh = quad()
    colours = mesh.color_attributes.new("Col", "FLOAT_COLOR", "POINT")
    colours.data.foreach_set("color", [*COLOUR, 1.0] * 4)
    attribute = tree.nodes.new("ShaderNodeVertexColor")
    attribute.layer_name = "Col"
    tree.links.new(attribute.outputs[0], shader.inputs["Color"])
    mesh.materials.append(made)
    link(bpy.data.objects.new("Quad", mesh))
    lamp = bpy.data.lights.new("Lamp", "SUN")
    lamp.color, lamp.energy = COLOUR, 1.0
    link(bpy.data.objects.new("Lamp", lamp))
    export, _ = exporter()
    scene = export.sync(depsgraph())
    radiance = scene.lights[0]["emission"]["radiance"]
    wanted = _in_rec709(COLOUR)
    assert [x / radiance[0] for x in radiance] == pytest.approx([x / wanted[0] for x in wanted], abs=1e-3)
    assert scene.meshes[0]["primvars"]["Col"][0][:3] == pytest.approx(wanted, abs=1e-4)


@pytest.mark.blender
def test_what_shines_comes_out_as_it_went_in(tmp_path):
    import bpy
    from scenes import read, render

    scene = _acescg()
    bpy.ops.object.camera_add(location=(0, 0, 5))
    scene.camera = bpy.context.object
    tree = scene.world.node_tree
    background = tree.nodes["Background"]

    def shown(name):
        render(tmp_path / f"{name}.exr")
        channels = read(tmp_path / f"{name}.exr")
        return [float(next(v for k, v in channels.items() if k.endswith(f"Combined.{c}")).mean()) for c in "RGB"]

    background.inputs["Color"].default_value = (*COLOUR, 1.0)
    assert shown("socket") == pytest.approx(COLOUR, abs=2e-3)
    blackbody = tree.nodes.new("ShaderNodeBlackbody")
    blackbody.inputs["Temperature"].default_value = 2700.0
    tree.links.new(blackbody.outputs[0], background.inputs["Color"])
    lamp = bpy.data.lights.new("Warm", "POINT")
    lamp.use_temperature, lamp.temperature = True, 2700.0
    assert shown("blackbody") == pytest.approx(tuple(lamp.temperature_color), abs=6e-3)
    # sRGB's 0.8, 0.1, 0.1 in ACEScg.
    tree.nodes.remove(blackbody)
    image = bpy.data.images.new("Red", 8, 8)
    image.pixels.foreach_set([0.8, 0.1, 0.1, 1.0] * 64)
    image.pack()
    texture = tree.nodes.new("ShaderNodeTexEnvironment")
    texture.image = image
    tree.links.new(texture.outputs[0], background.inputs["Color"])
    assert shown("image") == pytest.approx([0.374, 0.052, 0.0226], abs=3e-3)


@pytest.mark.blender
def test_spaces_without_a_name_go_through_blenders_configuration(tmp_path):
    import bpy
    from recorder import Recorder, empty, material, module

    empty()
    image = bpy.data.images.new("Wide", 4, 4)
    image.pixels.foreach_set([0.5, 0.4, 0.3, 1.0] * 16)
    image.filepath_raw, image.file_format = str(tmp_path / "wide.png"), "PNG"
    image.save()
    kept = bpy.data.images.load(str(tmp_path / "wide.png"))
    # A transfer function and a gamut, of which one is not sRGB's.
    kept.colorspace_settings.name = space = "Rec.2020" if bpy.app.version >= (5, 0, 0) else "AgX Log"
    scene, report = Recorder(), module("report").Report()
    images = module("export.images").Images(scene, module("export.slots").Slots())
    _, tree, _ = material()
    node = tree.nodes.new("ShaderNodeTexImage")
    texture = scene.textures[images.texture(kept, node.image_user, report)]
    bpy.utils.expose_bundled_modules()
    import PyOpenColorIO

    folder = bpy.utils.system_resource("DATAFILES", path="colormanagement")
    config = PyOpenColorIO.Config.CreateFromFile(f"{folder}/config.ocio")
    processor = config.getProcessor(space, "Linear Rec.709").getDefaultCPUProcessor()
    expected = processor.applyRGB(list(kept.pixels[:3]))
    assert texture["pixels"][0, 0, :3] == pytest.approx(expected, abs=1e-3)
    assert texture["colour_space"] == "raw" and not report.diagnostics

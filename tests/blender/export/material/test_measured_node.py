"""The Measured BSDF node: its file in gonio, its fallback elsewhere."""

import math

import pytest
from measured_files import matt_text


def write_matt(folder, reflectance=(0.6, 0.3, 0.1)):
    """A Lambertian measurement."""
    path = folder / "matt.gbsdf"
    path.write_text(matt_text(reflectance))
    return path


def measured_material(path=None):
    """A material of one such node: it, its tree and the node."""
    from recorder import material

    made, tree, end = material("Sample")
    node = tree.nodes.new("GonioShaderNodeMeasured")
    if path is not None:
        node.filepath = str(path)
    tree.links.new(node.outputs[0], end.inputs["Surface"])
    return made, tree, node


@pytest.mark.blender
def test_the_file_becomes_a_measured_closure(tmp_path):
    from recorder import constant, empty, translated

    empty()
    made, tree, node = measured_material(write_matt(tmp_path))
    node.inputs["Tint"].default_value = (0.5, 1.0, 1.0, 1.0)
    node.inputs["Scale"].default_value = 0.75
    node.inputs["Rotation"].default_value = 0.125
    description, lines = translated(made)
    (closure,) = description["closures"]
    assert (closure["model"], closure["measured"], closure["tangent"], closure["normal"]) == ("Measured", 0, None, None)
    assert constant(closure, "base_color")[:3] == [0.5, 1.0, 1.0]
    assert constant(closure, "specular_scale")[0] == 0.75 and constant(closure, "specular_rotation")[0] == 0.125
    assert not lines
    tangent = tree.nodes.new("ShaderNodeTangent")
    tangent.direction_type = "UV_MAP"
    tree.links.new(tangent.outputs[0], node.inputs["Tangent"])
    assert translated(made)[0]["closures"][0]["tangent"] is not None


@pytest.mark.blender
def test_one_file_is_read_once_and_again_when_it_changes(tmp_path):
    import os

    from recorder import Recorder, empty, module

    empty()
    scene, slots = Recorder(), module("export.slots").Slots()
    measurements = module("export.measured").Measurements(scene, slots)
    path = write_matt(tmp_path)
    assert [measurements.number(path), measurements.number(path)] == [0, 0] and scene.calls == ["measured"]
    slots.begin()
    os.utime(path, ns=(1, 1))
    assert measurements.number(path) == 1
    slots.sweep()
    broken = tmp_path / "broken.gbsdf"
    broken.write_text("gbsdf 1\n")
    for wrong in (broken, tmp_path / "none.gbsdf"):
        with _raises(Exception):
            measurements.number(wrong)
    assert len(scene.measured) == 2


def _raises(kind):
    """`pytest.raises` without pytest, which a Python with bpy may lack."""
    import unittest

    return unittest.TestCase().assertRaises(kind)


@pytest.mark.blender
def test_missing_and_broken_files_are_one_line_and_the_fallback(tmp_path):
    from recorder import empty, translated

    empty()
    broken = tmp_path / "broken.gbsdf"
    broken.write_text("gbsdf 1\ntable up\n")
    for path, expected in [(None, "no file is chosen"), (tmp_path / "none.bsdf", "none.bsdf"), (broken, "broken.gbsdf:2: ")]:
        made, tree, node = measured_material(path)
        description, lines = translated(made)
        assert len(lines) == 1 and "Measured BSDF" in lines[0] and expected in lines[0] and "fallback" in lines[0], lines
        assert {closure["model"] for closure in description["closures"]} == {"Principled"}
        shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
        tree.links.new(shader.outputs[0], node.inputs["Fallback"])
        node.update()
        description, _ = translated(made)
        assert [closure["model"] for closure in description["closures"]] == ["Diffuse"]


@pytest.mark.blender
def test_other_engines_get_the_nearest_surface(tmp_path):
    from recorder import empty

    empty()
    _, _, node = measured_material(write_matt(tmp_path))
    assert node.is_readable and node.status == "isotropic, 3 channels"
    assert list(node.inputs["Fitted Color"].default_value)[:3] == pytest.approx([0.6, 0.3, 0.1], abs=0.02)
    assert node.inputs["Fitted Metallic"].default_value == 0.0 and node.inputs["Fitted IOR"].default_value < 1.05
    node.filepath = str(tmp_path / "none.gbsdf")
    assert not node.is_readable and "No such file" in node.status


@pytest.mark.blender
def test_nodes_share_one_tree_and_know_their_links(tmp_path):
    import bpy
    from recorder import empty

    empty()
    path = write_matt(tmp_path)
    made, tree, node = measured_material(path)
    _, _, other = measured_material()
    copy = made.copy()
    copied = next(each for each in copy.node_tree.nodes if each.bl_idname == node.bl_idname)
    assert node.node_tree == other.node_tree == copied.node_tree and len(bpy.data.node_groups) == 1
    assert copied.filepath == str(path) and copied.inputs["Fitted Color"].default_value[0] == pytest.approx(0.6, abs=0.02)
    assert other.inputs["Fitted Color"].default_value[0] == pytest.approx(0.8)
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
    tree.links.new(shader.outputs[0], node.inputs["Fallback"])
    node.update()
    assert node.inputs["Use Fallback"].default_value == 1.0 and copied.inputs["Use Fallback"].default_value == 0.0
    tree.links.clear()
    node.update()
    assert node.inputs["Use Fallback"].default_value == 0.0
    made.use_fake_user = True
    saved = tmp_path / "kept.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(saved))
    bpy.ops.wm.open_mainfile(filepath=str(saved))
    kept = next(each for each in bpy.data.materials["Sample"].node_tree.nodes if each.bl_idname == "GonioShaderNodeMeasured")
    assert kept.filepath and kept.node_tree and kept.inputs["Fitted Color"].default_value[0] == pytest.approx(0.6, abs=0.02)


@pytest.mark.blender
def test_the_node_is_in_the_menu_and_goes_with_the_extension(tmp_path):
    import sys

    import bpy

    extension = sys.modules["gonio_extension"]
    menu = bpy.types.NODE_MT_category_shader_shader

    def entries():
        return [draw for draw in menu._dyn_ui_initialize() if draw.__module__.startswith("gonio_extension")]

    def is_known():
        return bpy.types.Node.bl_rna_get_subclass_py("GonioShaderNodeMeasured") is not None

    assert len(entries()) == 1 and is_known()
    extension.unregister()
    assert not entries() and not is_known()
    extension.register()
    assert len(entries()) == 1 and is_known()


def sunny_plane(made):
    """A plane of the material under a sun, seen straight from above: a Lambertian's radiance is its reflectance over π."""
    import bpy
    from recorder import link, quad

    mesh = quad()
    mesh.materials.append(made)
    link(bpy.data.objects.new("Plane", mesh))
    sun = bpy.data.lights.new("Sun", "SUN")
    sun.energy = math.pi
    link(bpy.data.objects.new("Sun", sun))
    camera = bpy.data.cameras.new("Camera")
    camera.type, camera.ortho_scale = "ORTHO", 0.5
    holder = link(bpy.data.objects.new("Camera", camera))
    holder.location = (0.5, 0.5, 2.0)
    scene = bpy.context.scene
    scene.camera, scene.render.resolution_x, scene.render.resolution_y = holder, 8, 8
    scene.view_settings.view_transform = "Raw"
    return scene


def mean_colour(scene, path):
    """The mean of a rendered picture, linear."""
    import bpy
    import numpy

    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    image = bpy.data.images.load(str(path))
    pixels = numpy.empty(8 * 8 * 4, "f4")
    image.pixels.foreach_get(pixels)
    return pixels.reshape(-1, 4)[:, :3].mean(axis=0).tolist()


@pytest.mark.blender
def test_cycles_shows_the_fallback(tmp_path):
    import addon_utils
    from recorder import empty

    empty()
    addon_utils.enable("cycles")
    made, tree, node = measured_material(write_matt(tmp_path))
    scene = sunny_plane(made)
    scene.render.engine = "CYCLES"
    scene.cycles.samples = 16
    assert mean_colour(scene, tmp_path / "fitted.exr") == pytest.approx([0.6, 0.3, 0.1], rel=0.05)
    shader = tree.nodes.new("ShaderNodeBsdfDiffuse")
    shader.inputs["Color"].default_value = (0.1, 0.2, 0.3, 1.0)
    tree.links.new(shader.outputs[0], node.inputs["Fallback"])
    node.update()
    assert mean_colour(scene, tmp_path / "linked.exr") == pytest.approx([0.1, 0.2, 0.3], rel=0.02)


@pytest.mark.blender
def test_gonio_shows_the_measurement(tmp_path):
    from recorder import empty

    empty()
    made, _, node = measured_material(write_matt(tmp_path))
    node.inputs["Scale"].default_value = 0.5
    scene = sunny_plane(made)
    scene.render.engine = "GONIO"
    scene.gonio.samples = 16
    assert mean_colour(scene, tmp_path / "measured.exr") == pytest.approx([0.3, 0.15, 0.05], rel=0.02)

"""Smooth normals that stand far from the faces', in the white and as Cycles shows them."""

import pytest

SIZE = 32


def seen(location, target, scale):
    """Makes an orthographic camera the scene's."""
    import bpy
    from mathutils import Vector

    bpy.ops.object.camera_add(location=location)
    camera = bpy.context.scene.camera = bpy.context.object
    camera.rotation_euler = (Vector(target) - camera.location).to_track_quat("-Z", "Y").to_euler()
    camera.data.type, camera.data.ortho_scale = "ORTHO", scale


def turned(profile, steps):
    """A smooth mesh: a profile of radii and heights turned about z."""
    import math

    import bpy

    around = [(math.cos(2 * math.pi * i / steps), math.sin(2 * math.pi * i / steps)) for i in range(steps)]
    corners = [(r * x, r * y, z) for r, z in profile for x, y in around]
    rows = range(len(profile) - 1)
    faces = [[(row + up) * steps + (i + on) % steps for on, up in ((0, 0), (1, 0), (1, 1), (0, 1))] for row in rows for i in range(steps)]
    mesh = bpy.data.meshes.new("Turned")
    mesh.from_pydata(corners, [], faces)
    mesh.polygons.foreach_set("use_smooth", [True] * len(faces))
    thing = bpy.data.objects.new("Turned", mesh)
    bpy.context.scene.collection.objects.link(thing)
    return mesh


def shader(kind, **inputs):
    """A material of one closure."""
    import bpy

    material = bpy.data.materials.new(kind)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    node, output = tree.nodes.new(f"ShaderNodeBsdf{kind}"), tree.nodes.new("ShaderNodeOutputMaterial")
    for name, value in inputs.items():
        node.inputs[name].default_value = value
    tree.links.new(node.outputs[0], output.inputs["Surface"])
    return material


def colour(path):
    import numpy
    import scenes

    scenes.render(path)
    channels = scenes.read(path)
    return numpy.stack([channels[f"ViewLayer.Combined.{channel}"] for channel in "RGB"], axis=-1)


def ball(kind, *, world=0.0, segments, rings, samples, **inputs):
    """A scene of one coarse smooth ball under an even world."""
    import bpy
    import scenes

    scene = scenes.empty(width=SIZE, height=SIZE, samples=samples)
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (world, world, world, 1)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=segments, ring_count=rings)
    bpy.ops.object.shade_smooth()
    bpy.context.object.data.materials.append(shader(kind, **inputs))
    return scene


def from_cycles(path, samples):
    import bpy

    scene = bpy.context.scene
    scene.render.engine, settings = "CYCLES", scene.cycles
    settings.samples, settings.use_denoising, settings.use_adaptive_sampling = samples, False, False
    settings.sample_clamp_indirect = settings.blur_glossy = 0.0
    settings.pixel_filter_type = "BOX"
    return colour(path)


@pytest.mark.blender
def test_mirrors_of_few_faces_have_no_dark_edge(tmp_path):
    ball("Anisotropic", world=1.0, segments=8, rings=4, samples=16, Color=(1, 1, 1, 1), Roughness=0.0)
    seen((0, -5, 1), (0, 0, 0), 2.2)
    assert colour(tmp_path / "mirror.exr") == pytest.approx(1.0, abs=1e-3)


@pytest.mark.blender
def test_rims_of_smooth_glass_are_those_of_cycles(tmp_path):
    import scenes

    samples, white = 256, (1, 1, 1, 1)
    scene = scenes.empty(width=SIZE, height=SIZE // 4, samples=samples)
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = white
    wall = [(0.28, 1.35), (0.265, 1.35), (0.315, 1.1), (0.28, 0.82), (0.1, 0.65), (0.0, 0.62)]
    mesh = turned([(0.0, 0.6), (0.12, 0.6), (0.3, 0.8), (0.33, 1.1), *wall], 16)
    mesh.materials.append(shader("Glass", Color=white, Roughness=0.0, IOR=1.5))
    seen((0, -4.2, 2.2), (0, 0, 1.33), 0.56)
    scene.gonio.pixel_filter_type, scene.gonio.filter_width = "BOX", 1.0
    found, expected = colour(tmp_path / "gonio.exr"), from_cycles(tmp_path / "cycles.exr", samples)
    blocks = [picture.reshape(2, SIZE // 8, SIZE // 4, 4, 3).mean(axis=(1, 3, 4)) for picture in (found, expected)]
    assert blocks[0] == pytest.approx(blocks[1], rel=0.1)
    assert found.mean() == pytest.approx(expected.mean(), rel=0.02)


@pytest.mark.blender
@pytest.mark.parametrize("kind", ["SUN", "AREA"])
def test_light_grazes_coarse_balls_as_in_cycles(tmp_path, kind):
    import bpy

    samples = 256
    scene = ball("Diffuse", segments=12, rings=8, samples=samples, Color=(1, 1, 1, 1))
    bpy.ops.object.light_add(type=kind, location=(5, -1, 1.5), rotation=(0, 1.3, -0.2))
    bpy.context.object.data.energy = 3.0 if kind == "SUN" else 300.0
    seen((0, -5, 1), (0, 0, 0), 2.2)
    scene.gonio.pixel_filter_type, scene.gonio.filter_width = "BOX", 1.0
    shown = {offset: (tmp_path / f"{offset}.exr") for offset in (0.1, 0.0)}
    found = {}
    for offset, path in shown.items():
        bpy.data.objects["Sphere"].shadow_terminator_geometry_offset = offset
        found[offset] = colour(path)
    bpy.data.objects["Sphere"].shadow_terminator_geometry_offset = 0.1
    expected = from_cycles(tmp_path / "cycles.exr", samples)
    off = {offset: abs(picture - expected).mean() / expected.mean() for offset, picture in found.items()}
    assert off[0.1] < 0.01 and off[0.0] > 2.0 * off[0.1], off


@pytest.mark.blender
def test_smooth_meshes_that_shine_light_themselves_no_more_than_in_cycles(tmp_path):
    glowing = {"Base Color": (0.8, 0.8, 0.8, 1.0), "Emission Color": (1.0, 1.0, 1.0, 1.0), "Emission Strength": 0.5}
    ball("Principled", world=0.5, segments=16, rings=8, samples=64, **glowing)
    seen((0.0, -3.0, 1.0), (0.0, 0.0, 0.0), 2.2)
    # Each triangle's own light would count from within its plane, times whatever rounding leaves of it.
    picture = colour(tmp_path / "gonio.exr")
    cycles = from_cycles(tmp_path / "cycles.exr", 64)
    assert picture.max() < 3.0
    assert abs(picture.mean() / cycles.mean() - 1.0) < 0.02, (picture.mean(), cycles.mean())

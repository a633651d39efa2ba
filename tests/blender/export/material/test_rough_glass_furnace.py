"""Balls of rough glass in a white furnace: who is right where Cycles' Filter Glossy makes glass darker than here."""

import pytest

SIZE, SAMPLES = 32, 256


def ball(distribution, roughness):
    """A scene of one smooth ball of clear glass that fills most of the picture, in a world of 1."""
    import bpy
    import scenes

    scene = scenes.empty(width=SIZE, height=SIZE, samples=SAMPLES)
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32)
    bpy.ops.object.shade_smooth()
    material = bpy.data.materials.new("Glass")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    glass, output = tree.nodes.new("ShaderNodeBsdfGlass"), tree.nodes.new("ShaderNodeOutputMaterial")
    glass.distribution = distribution
    glass.inputs["Roughness"].default_value, glass.inputs["IOR"].default_value = roughness, 1.45
    tree.links.new(glass.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(material)
    bpy.ops.object.camera_add(location=(0, 0, 8))
    camera = scene.camera = bpy.context.object
    camera.data.type, camera.data.ortho_scale = "ORTHO", 1.4
    return scene


def mean(path):
    import numpy
    import scenes

    scenes.render(path)
    channels = scenes.read(path)
    return float(numpy.mean([channels[f"ViewLayer.Combined.{channel}"] for channel in "RGB"]))


def in_cycles(path, scene, blur):
    scene.render.engine, settings = "CYCLES", scene.cycles
    settings.samples, settings.use_denoising, settings.use_adaptive_sampling = SAMPLES, False, False
    settings.sample_clamp_indirect, settings.blur_glossy = 0.0, blur
    settings.max_bounces = settings.transmission_bounces = settings.glossy_bounces = 64
    return mean(path)


@pytest.mark.blender
@pytest.mark.parametrize("distribution", ["MULTI_GGX", "GGX"])
def test_filter_glossy_takes_light_from_rough_glass(tmp_path, distribution):
    scene = ball(distribution, 0.3)
    for limit in ("max_bounces", "glossy_bounces", "transmission_bounces"):
        setattr(scene.gonio, limit, 64)
    here = mean(tmp_path / "gonio.exr")
    sharp, blurred = (in_cycles(tmp_path / f"{blur}.exr", scene, blur) for blur in (0.0, 1.0))
    # Glass without colour takes nothing: the furnace shows 1, but for what single scattering loses (plain GGX).
    assert here == pytest.approx(sharp, abs=0.005), (here, sharp)
    assert distribution == "GGX" or abs(here - 1.0) < 0.005 > abs(sharp - 1.0), (here, sharp)
    assert blurred < sharp - 0.015, (sharp, blurred)

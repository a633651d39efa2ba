"""Shadow catchers as Cycles shows them: a cube over a plane, under a sun and a sky."""

import pytest

SIZE, SAMPLES = 96, 256


def cube_over_plane(transparent):
    import bpy
    import scenes
    from mathutils import Vector

    scene = scenes.empty(width=SIZE, height=SIZE, samples=SAMPLES)
    scene.render.film_transparent = transparent
    bpy.ops.mesh.primitive_plane_add(size=8)
    bpy.context.object.is_shadow_catcher = True
    bpy.context.object.data.materials.append(scenes.diffuse("Floor", (0.6, 0.6, 0.6)))
    bpy.ops.mesh.primitive_cube_add(size=1.5, location=(0, 0, 0.8))
    bpy.context.object.data.materials.append(scenes.diffuse("Cube", (0.8, 0.3, 0.1)))
    bpy.ops.object.light_add(type="SUN", rotation=(-0.7, 0.5, 0.4))
    bpy.context.object.data.energy, bpy.context.object.data.angle = 2.0, 0.1
    background = scene.world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value, background.inputs["Strength"].default_value = (0.5, 0.7, 1.0, 1.0), 0.6
    bpy.ops.object.camera_add(location=(4, -6, 5))
    scene.camera = bpy.context.object
    scene.camera.rotation_euler = (Vector((0, 0, 0.3)) - scene.camera.location).to_track_quat("-Z", "Y").to_euler()
    return scene


def combined(path):
    """The picture's RGBA."""
    import numpy
    import scenes

    scenes.render(path)
    channels = scenes.read(path)
    return numpy.stack([channels[f"ViewLayer.Combined.{channel}"] for channel in "RGBA"], axis=-1)


@pytest.mark.blender
@pytest.mark.parametrize("transparent", [True, False])
def test_catchers_are_those_of_cycles(tmp_path, transparent):
    import numpy

    scene = cube_over_plane(transparent)
    scene.gonio.pixel_filter_type, scene.gonio.filter_width = "BOX", 1.0
    found = combined(tmp_path / "gonio.exr")
    scene.render.engine, settings = "CYCLES", scene.cycles
    settings.samples, settings.use_denoising, settings.use_adaptive_sampling = SAMPLES, False, False
    settings.sample_clamp_indirect, settings.pixel_filter_type = 0.0, "BOX"
    expected = combined(tmp_path / "cycles.exr")
    assert found.mean(axis=(0, 1)) == pytest.approx(expected.mean(axis=(0, 1)), rel=0.01)
    blocks = [picture.reshape(SIZE // 8, 8, SIZE // 8, 8, 4).mean(axis=(1, 3)) for picture in (found, expected)]
    assert numpy.abs(blocks[0] - blocks[1]).max() < 0.02
    assert 0.1 < found[..., 3].mean() <= 1.0

"""Textures within Blender's memory limit."""

import pytest


def pictured_plane(path):
    """A plane with a picture of 800 × 800 texels from a file, lit by the world."""
    import bpy
    import numpy as np
    import scenes

    scene = scenes.empty(width=32, height=32, samples=4)
    image = bpy.data.images.new("Picture", 800, 800)
    image.pixels.foreach_set(np.random.default_rng(1).uniform(0.0, 1.0, 800 * 800 * 4).astype("f4"))
    image.filepath_raw, image.file_format = str(path), "PNG"
    image.save()
    bpy.ops.mesh.primitive_plane_add(size=2.0)
    material = bpy.data.materials.new("Pictured")
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    texture, shader = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeEmission")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    texture.image = bpy.data.images.load(str(path))
    tree.links.new(texture.outputs["Color"], shader.inputs["Color"])
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    bpy.context.object.data.materials.append(material)
    bpy.ops.object.camera_add(location=(0.1, 0.2, 3), rotation=(0.3, 0, 0))
    scene.camera = bpy.context.object
    return scene


@pytest.mark.blender
def test_the_picture_is_the_same_within_the_limit(tmp_path):
    import bpy
    import numpy as np
    import scenes

    from gonio_extension.export import settings

    scene = pictured_plane(tmp_path / "picture.png")
    scenes.render(tmp_path / "whole.exr")
    cache = tmp_path / "tiles"
    # The picture and its mip maps take three and a half megabytes.
    scene.gonio.texture_memory, scene.gonio.texture_cache = 1, str(cache)
    scenes.render(tmp_path / "limited.exr")
    assert len(list(cache.glob("*.gtiles"))) == 1
    whole, limited = (scenes.read(tmp_path / f"{name}.exr")["ViewLayer.Combined.G"] for name in ("whole", "limited"))
    assert np.array_equal(whole, limited) and whole.any()
    arguments = settings.settings(bpy.context.evaluated_depsgraph_get(), width=8, height=8, crop=None, preview=False, passes=[])
    assert (arguments["texture_memory"], arguments["texture_cache"]) == (1 << 20, str(cache))


@pytest.mark.blender
def test_tiles_that_cannot_be_made_anew_are_in_the_report(tmp_path):
    import os

    import scenes
    from recorder import module
    from texture_memory import spoil_tiles

    picture, cache = tmp_path / "picture.png", tmp_path / "tiles"
    scene = pictured_plane(picture)
    scene.render.use_persistent_data = True
    # The last levels, which lie beside the checksums, stay sound.
    scene.render.resolution_x = scene.render.resolution_y = 200
    scene.gonio.texture_memory, scene.gonio.texture_cache = 1, str(cache)
    # First nothing of it is seen.
    scene.camera.rotation_euler = (3.1, 0, 0)
    scenes.render(tmp_path / "away.exr")
    latest = module("report").latest
    assert not any("damaged" in line.message for line in latest().diagnostics)
    spoil_tiles(cache)
    about = picture.stat()
    # Its head stays: of an unknown kind Blender would hand over the pixels that it holds.
    picture.write_bytes(picture.read_bytes()[:64] + bytes(about.st_size - 64))
    os.utime(picture, ns=(about.st_atime_ns, about.st_mtime_ns))
    scene.camera.rotation_euler = (0.3, 0, 0)
    scenes.render(tmp_path / "seen.exr")
    told = [line.message for line in latest().diagnostics if "damaged" in line.message]
    assert len(told) == 1 and "picture.png" in told[0] and "black" in told[0], told

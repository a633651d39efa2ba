"""Images of bytes seen from afar keep the mean of their light, as in Cycles, which mixes bytes as they are encoded only between texels."""

import pytest


def halves():
    """A ground of one image, repeated, half of it black."""
    import bpy
    import numpy as np
    from beside_cycles import shining

    image = bpy.data.images.new("Halves", 64, 64)
    texels = np.ones((64, 64, 4), dtype=np.float32)
    texels[:, :32, :3] = 0.0
    image.pixels.foreach_set(texels.ravel())
    image.pack()
    ground, tree, end = shining()
    texture, place = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeTexCoord")
    texture.image = image
    tree.links.new(place.outputs["Object"], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], end)
    bpy.ops.mesh.primitive_plane_add(size=100.0)
    bpy.context.object.data.materials.append(ground)


@pytest.mark.blender
def test_images_keep_their_light_from_afar(tmp_path):
    from beside_cycles import both, scene

    scene(8, 8, scale=16.0, samples=256)
    halves()
    cycles, gonio = both(tmp_path)
    assert cycles.mean() == pytest.approx(0.5, rel=0.02)
    assert gonio.mean() == pytest.approx(0.5, rel=0.01)

"""Images of bytes seen from afar keep the mean of their light, as in Cycles, which mixes bytes as they are encoded only between texels; and as sharp
as its pictures are."""

import pytest


def halves():
    """A ground of one image, repeated, half of it black."""
    import numpy as np

    texels = np.ones((64, 64, 4), dtype=np.float32)
    texels[:, :32, :3] = 0.0
    ground(texels)


def ground(texels):
    """A ground that shines as an image does, repeated, as wide as a metre each."""
    import bpy
    from beside_cycles import shining

    image = bpy.data.images.new("Ground", *texels.shape[1::-1])
    image.pixels.foreach_set(texels.ravel())
    image.pack()
    cover, tree, end = shining()
    texture, place = tree.nodes.new("ShaderNodeTexImage"), tree.nodes.new("ShaderNodeTexCoord")
    texture.image = image
    tree.links.new(place.outputs["Object"], texture.inputs["Vector"])
    tree.links.new(texture.outputs["Color"], end)
    bpy.ops.mesh.primitive_plane_add(size=100.0)
    bpy.context.object.data.materials.append(cover)


@pytest.mark.blender
def test_images_keep_their_light_from_afar(tmp_path):
    from beside_cycles import both, scene

    scene(8, 8, scale=16.0, samples=256)
    halves()
    cycles, gonio = both(tmp_path)
    assert cycles.mean() == pytest.approx(0.5, rel=0.02)
    assert gonio.mean() == pytest.approx(0.5, rel=0.01)


@pytest.mark.blender
def test_images_are_as_sharp_as_in_cycles(tmp_path):
    import numpy as np
    from beside_cycles import both, scene

    # Eight texels a pixel; two pixels wide stands a dim patch among bright texels.
    scene(8, 8, scale=1.0, samples=64)
    texels = np.ones((64, 64, 4), dtype=np.float32)
    # The middle of the picture is a corner of the image.
    texels[24:40, 24:40, :3] = 0.1
    texels = np.roll(texels, (32, 32), axis=(0, 1))
    ground(texels)
    cycles, gonio = (picture[3:5, 3:5].mean() for picture in both(tmp_path))
    # Looked up over whole pixels it was brighter by 0.22.
    assert cycles < 0.03 and abs(gonio - cycles) < 0.06, (cycles, gonio)

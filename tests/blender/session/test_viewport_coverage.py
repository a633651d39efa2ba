"""What a 3D viewport shows through: nothing where the world is seen, the background where the film is transparent."""

import pytest


@pytest.mark.blender
def test_a_world_that_is_seen_covers():
    import bpy
    import numpy
    import scenes
    from mathutils import Matrix
    from viewport import Viewport

    scene = scenes.lit_floor(samples=4)
    floor = bpy.data.objects["Floor"]
    floor.scale, floor.rotation_euler.z = (0.05, 0.05, 1.0), 0.3
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0.25, 0.25, 0.25, 1)
    scene.gonio.preview_samples, scene.gonio.use_preview_denoising = 4, False
    view = Viewport(Matrix.Translation((0, 0, 3)))
    for transparent in (False, True):
        for operator in ("NONE", "PHOTOGRAPHIC"):
            scene.render.film_transparent, scene.gonio.tone_map = transparent, operator
            view.draw()
            shown = view.finish()
            pixels = numpy.asarray(shown.pixels).reshape(shown.height, shown.width, 4)
            corner, middle = pixels[2, 2], pixels[shown.height // 2, shown.width // 2]
            assert middle[3] == 1.0 and middle[1] > 0.0
            if not transparent:
                assert (pixels[..., 3] == 1.0).all() and corner[1] > 0.05, operator
                continue
            assert (corner == 0.0).all(), operator
            # Blender takes colours that are multiplied by their alpha.
            partly = (pixels[..., 3] > 0.2) & (pixels[..., 3] < 0.8)
            assert partly.sum() > 20
            straight = pixels[partly][:, 1] / pixels[partly][:, 3]
            assert numpy.median(straight) == pytest.approx(numpy.median(pixels[pixels[..., 3] == 1.0][:, 1]), rel=0.15), operator
    view.close()

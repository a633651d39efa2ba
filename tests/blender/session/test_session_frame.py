"""Sizes, borders and views."""

import importlib
import math
from types import SimpleNamespace

import pytest


def part(name):
    """A module of the extension."""
    return importlib.import_module(f"gonio_extension.{name}")


@pytest.mark.blender
def test_final_frames_agree_with_blender():
    import random

    import bpy

    frame = part("session.frame")
    chance = random.Random(5)
    render = bpy.context.scene.render
    for _ in range(200):
        render.resolution_x, render.resolution_y = chance.randint(4, 3000), chance.randint(4, 3000)
        render.resolution_percentage = chance.choice((100, 50, 33, 7))
        render.use_border = chance.random() < 0.7
        render.border_min_x, render.border_max_x = sorted(chance.random() for _ in range(2))
        render.border_min_y, render.border_max_y = sorted(chance.random() for _ in range(2))
        made = frame.final_frame(render)
        width, height = made.size
        assert 0 < width <= made.width and 0 < height <= made.height
        if made.crop is not None:
            x0, y0, x1, y1 = made.crop
            assert made.corner == (x0, made.height - y1)
            assert math.isclose(x0 / made.width, render.border_min_x, abs_tol=1 / made.width)
            assert math.isclose(1 - y1 / made.height, render.border_min_y, abs_tol=1 / made.height)
        for factor in (2, 4, 16):
            small = made.reduced(factor)
            assert small.size[0] >= 1 and small.size[1] >= 1 and small.width <= made.width
            if small.crop is not None:
                assert small.crop[2] <= small.width and small.crop[3] <= small.height


@pytest.mark.blender
def test_the_border_of_a_camera_view_lies_in_the_cameras_frame():
    import bpy
    from mathutils import Matrix

    view = part("session.view")
    scene, camera = bpy.context.scene, bpy.context.scene.camera
    scene.render.resolution_x, scene.render.resolution_y = 1600, 1000
    # A viewport of the same shape whose frame fills half of it.
    projection = Matrix.Diagonal((0.5, 0.5, 1.0, 1.0)) @ camera.calc_matrix_camera(
        bpy.context.evaluated_depsgraph_get(), x=1600, y=1000, scale_x=1, scale_y=1
    )
    region = SimpleNamespace(
        view_perspective="CAMERA",
        view_matrix=camera.matrix_world.inverted(),
        window_matrix=projection,
        perspective_matrix=projection @ camera.matrix_world.inverted(),
    )
    edges = view.camera_frame(scene, camera, region)
    assert all(math.isclose(edge, expected, abs_tol=1e-4) for edge, expected in zip(edges, (0.25, 0.25, 0.75, 0.75), strict=True))
    scene.render.use_border = True
    scene.render.border_min_x, scene.render.border_max_x, scene.render.border_min_y, scene.render.border_max_y = 0.0, 0.5, 0.0, 1.0
    space = SimpleNamespace(use_local_camera=False, camera=camera, use_render_border=False)
    crop = view.frame_of(scene, space, region, 1600, 1000).crop
    assert all(abs(edge - expected) <= 1 for edge, expected in zip(crop, (400, 250, 800, 750), strict=True))


@pytest.mark.blender
def test_status_lines():
    status = part("session.status")
    progress = SimpleNamespace(samples=3, fraction=0.3, remaining=75.4)
    assert status.text(progress, 10) == "Sample 3/10, 1:15 left"
    assert status.text(progress, 0) == "Sample 3"
    assert status.clock(3661) == "1:01:01"

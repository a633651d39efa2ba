"""Denoised bakes: nothing between the parts of a texture darkens their borders."""

import importlib
from pathlib import Path

import pytest


@pytest.mark.blender
def test_pixels_between_parts_have_what_is_near(tmp_path: Path):
    import numpy as np

    filled = importlib.import_module("gonio_extension.baking.denoised").filled
    chance = np.random.default_rng(1)
    for height, width in ((7, 5), (16, 16), (1, 9)):
        known = chance.random((height, width)) < 0.3
        known[0, 0] = True
        pixels = chance.random((height, width, 3)).astype("f4") + 1.0
        found = filled(pixels * known[..., None], known)
        assert np.array_equal(found[known], pixels[known]) and found.min() >= 1.0 and found.max() <= 2.0
    # A part is mirrored at its borders, and nothing at all stays nothing.
    known = np.zeros((4, 12), bool)
    known[1:3, 4:8] = True
    row = np.array([3.0, 3.0, 2.0, 1.0, 1.0, 2.0, 3.0, 4.0, 4.0, 3.0, 2.0, 2.0])
    pixels = np.array([1.0, 1.0, 2.0, 2.0])[:, None, None] * row[None, :, None].repeat(3, axis=2)
    found = filled(pixels * known[..., None], known)
    assert np.array_equal(found[:, 3:9], pixels[:, 3:9]) and (found > 0.0).all()
    assert not filled(np.zeros((4, 4, 3), "f4"), np.zeros((4, 4), bool)).any()


@pytest.mark.blender
def test_borders_of_parts_keep_their_light(tmp_path: Path):
    import importlib.util
    import unittest

    import bpy
    import numpy as np
    import scenes
    from test_bake import bake, choose, image_of, pixels

    if importlib.util.find_spec("pyoidn") is None:
        raise unittest.SkipTest("this bpy's Python has no pyoidn: pip install pyoidn")
    scene = scenes.empty(samples=16)
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (1, 1, 1, 1)
    bpy.ops.mesh.primitive_plane_add(size=2.0)
    floor = bpy.context.object
    floor.data.materials.append(scenes.diffuse("Grey", (0.5, 0.5, 0.5)))
    # The plane fills the middle quarter of its texture.
    for corner in floor.data.uv_layers.active.uv:
        corner.vector = (0.25 + 0.5 * corner.vector.x, 0.25 + 0.5 * corner.vector.y)
    bpy.ops.mesh.primitive_cube_add(size=1.2, location=(0.0, 0.0, 1.3))
    bpy.context.object.data.materials.append(scenes.diffuse("Dark", (0.2, 0.2, 0.2)))
    choose(floor)
    image = image_of(floor, 64, 64)
    found = {}
    for name, samples, denoised in (("exact", 512, False), ("noisy", 16, False), ("quiet", 16, True)):
        scene.gonio.samples, scene.gonio.use_denoising = samples, denoised
        bake("COMBINED")
        found[name] = pixels(image)[..., 0].copy()
    inside = np.zeros((64, 64), bool)
    inside[16:48, 16:48] = True
    border = inside.copy()
    border[17:47, 17:47] = False
    error = {name: [np.sqrt(((found[name] - found["exact"])[part] ** 2).mean()) for part in (inside, border)] for name in ("noisy", "quiet")}
    assert error["quiet"][0] < 0.4 * error["noisy"][0] and error["quiet"][1] < 0.5 * error["noisy"][1], error
    assert found["quiet"][border].mean() == pytest.approx(found["exact"][border].mean(), rel=0.01)
    assert not found["quiet"][~inside].any()

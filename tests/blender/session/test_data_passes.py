"""Passes of data where nothing is, and of materials without images, as in Cycles."""

import pytest


@pytest.mark.blender
@pytest.mark.parametrize("smooth", [False, True])
def test_depth_and_coordinates_are_those_of_cycles(tmp_path, smooth):
    import bpy
    import numpy
    from beside_cycles import scene
    from scenes import diffuse, read, render

    made = scene(8, 4)
    # A plane over the middle of the picture, or a ball.
    add = bpy.ops.mesh.primitive_uv_sphere_add if smooth else bpy.ops.mesh.primitive_plane_add
    add(**({"radius": 1.5, "segments": 64, "ring_count": 32} if smooth else {"size": 4.0}))
    if smooth:
        bpy.ops.object.shade_smooth()
    bpy.context.object.data.materials.append(diffuse("Plain", (0.5, 0.5, 0.5)))
    layer = bpy.context.view_layer
    layer.use_pass_z = layer.use_pass_uv = layer.use_pass_normal = True
    # The first sample of Cycles lies in a pixel's middle.
    made.cycles.pixel_filter_type, made.cycles.filter_width = "GAUSSIAN", 0.01
    found = {}
    for engine in ("CYCLES", "GONIO"):
        made.render.engine = engine
        if engine == "GONIO":
            bpy.ops.gonio.settings_from_cycles()
        render(tmp_path / f"{engine}.exr")
        found[engine] = {name: values for name, values in read(tmp_path / f"{engine}.exr").items() if "Combined" not in name}
    assert found["GONIO"].keys() == found["CYCLES"].keys() and len(found["GONIO"]) == 7
    for name, expected in found["CYCLES"].items():
        assert numpy.allclose(found["GONIO"][name], expected, atol=5e-3), (name, found["GONIO"][name], expected)
    depth = found["GONIO"]["ViewLayer.Depth.Z"]
    assert depth.max() == numpy.float32(1e10) and depth.min() < 5.01

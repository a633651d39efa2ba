"""The pixel filter beside Cycles: how an edge goes over pixels."""

import pytest


@pytest.mark.blender
def test_edges_are_as_soft_as_in_cycles(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import both, scene, shining

    made = scene(16, 64, samples=256)
    bpy.ops.mesh.primitive_plane_add(size=200.0, location=(100.0, 0.0, 0.0))
    bpy.context.object.data.materials.append(shining()[0])
    for kind, width in (("BLACKMAN_HARRIS", 1.5), ("BLACKMAN_HARRIS", 3.0), ("GAUSSIAN", 2.0), ("BOX", 3.0)):
        made.cycles.pixel_filter_type, made.cycles.filter_width = kind, width
        cycles, gonio = (picture[..., 0].mean(axis=0) for picture in both(tmp_path))
        # Noise of 64 × 256 samples a column.
        assert np.abs(cycles - gonio).max() < 0.015, (kind, width, cycles, gonio)
        assert kind != "BLACKMAN_HARRIS" or 0.05 < gonio[7] < 0.45

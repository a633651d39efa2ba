"""Sky textures on surfaces against Cycles."""

import pytest


def sky(kind):
    from beside_cycles import fed

    def prepare(node):
        node.sky_type = kind
        if hasattr(node, "sun_disc"):
            node.sun_disc = False
        node.sun_elevation, node.sun_rotation = 0.5, 0.7

    return fed("ShaderNodeTexSky", prepare)


@pytest.mark.blender
def test_skies_on_surfaces_are_those_of_cycles(tmp_path):
    import bpy
    import numpy as np
    from beside_cycles import board, both, differences

    kinds = ("NISHITA", "PREETHAM") if bpy.app.version < (5, 0, 0) else ("SINGLE_SCATTERING", "MULTIPLE_SCATTERING", "PREETHAM")
    cases = {kind: sky(kind) for kind in kinds}
    values = np.random.default_rng(2).normal(size=(60, 3))
    values[:, 2] = np.abs(values[:, 2]) + 0.1
    values /= np.linalg.norm(values, axis=1, keepdims=True)
    board(cases, values)
    found = differences(both(tmp_path), cases, len(values))
    assert all(each[0] < 0.04 and each[2].max() > 0.01 for each in found.values()), found

"""Nodes where colours are negative or above one, bases negative, and pictures at their borders, against Cycles."""

import pytest


def with_fields(node_type, output=0, inputs=(0,), **fields):
    from beside_cycles import fed

    def prepare(node):
        for name, value in fields.items():
            setattr(node, name, value)

    return fed(node_type, prepare, output, inputs)


def powers(exponent):
    from beside_cycles import fed

    def prepare(node):
        node.operation, node.inputs[1].default_value = "POWER", exponent

    return fed("ShaderNodeMath", prepare)


def blended(mode):
    from beside_cycles import fed

    def prepare(node):
        node.blend_type = mode
        node.inputs[0].default_value, node.inputs[2].default_value = 0.7, (0.3, 0.6, 0.4, 1.0)

    return fed("ShaderNodeMixRGB", prepare, inputs=(1,))


@pytest.mark.blender
def test_values_beyond_the_usual_are_those_of_cycles(tmp_path):
    import numpy as np
    from beside_cycles import alike, board, both

    cases = {f"power {exponent}": powers(exponent) for exponent in (-3.0, -2.0, -0.5, 0.0, 1.0, 2.0, 3.0, 2.5)}
    cases.update({mode: blended(mode) for mode in ("HUE", "COLOR", "SATURATION", "VALUE")})
    cases.update({f"HSL {number}": with_fields("ShaderNodeSeparateColor", number, mode="HSL") for number in range(3)})
    values = np.random.default_rng(5).uniform(-2.0, 2.0, (80, 3))
    board(cases, values)
    # Cubes that cancel each other have lost that much.
    alike(both(tmp_path), cases, len(values), 2e-5)


def tiled(sides, output, is_normalized):
    from beside_cycles import fed

    def prepare(node):
        node.normalize = is_normalized
        node.inputs["Sides"].default_value = sides

    return fed("ShaderNodeRadialTiling", prepare, output)


@pytest.mark.blender
def test_radial_tiling_is_that_of_cycles(tmp_path):
    import unittest

    import bpy
    import numpy as np
    from beside_cycles import alike, board, both

    if bpy.app.version < (5, 0, 0):
        raise unittest.SkipTest("there is no Radial Tiling before 5.0")
    cases = {
        f"{sides} {output} {normal}": tiled(sides, output, normal)
        for sides in (5.0, 3.6)
        for output in range(4)
        for normal in (True, False)
    }
    values = np.random.default_rng(9).uniform(-2.0, 2.0, (60, 3))
    board(cases, values)
    alike(both(tmp_path), cases, len(values), 1e-4)

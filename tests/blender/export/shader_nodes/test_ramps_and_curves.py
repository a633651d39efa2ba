"""Colour ramps and curves of every kind against Cycles."""

import pytest


def ramp(mode, interpolation, hue="NEAR"):
    def prepare(node):
        ramp = node.color_ramp
        ramp.color_mode, ramp.interpolation, ramp.hue_interpolation = mode, interpolation, hue
        for place, colour in ((0.2, (0.9, 0.2, 0.1, 0.5)), (0.55, (0.1, 0.6, 0.9, 1.0)), (0.56, (0.9, 0.9, 0.1, 0.2))):
            ramp.elements.new(place).color = colour

    return prepare


def bent(extend, *points, handle="AUTO", every=False):
    """Curves through points; all of them, or the first and the last alone."""

    def prepare(node):
        mapping = node.mapping
        mapping.extend = extend
        curves = mapping.curves
        for curve in curves if every else {curves[0], curves[-1]}:
            for place in points:
                curve.points.new(*place).handle_type = handle
        mapping.update()

    return prepare


def pulled_in(node):
    """Curves whose points leave out both ends of 0 to 1."""
    for curve in node.mapping.curves:
        curve.points[0].location, curve.points[-1].location = (0.15, 0.3), (0.8, 0.6)
    node.mapping.update()


def ramps():
    from beside_cycles import fed

    found = {}
    for interpolation in ("LINEAR", "EASE", "CARDINAL", "B_SPLINE", "CONSTANT"):
        for output in (0, 1):
            found[f"{interpolation} {output}"] = fed("ShaderNodeValToRGB", ramp("RGB", interpolation), output)
    for mode in ("HSV", "HSL"):
        for hue in ("NEAR", "FAR", "CW", "CCW"):
            found[f"{mode} {hue}"] = fed("ShaderNodeValToRGB", ramp(mode, "LINEAR", hue))
    return found


def curves(kinds):
    from beside_cycles import fed

    found = {}
    for kind in kinds:
        for extend in ("EXTRAPOLATED", "HORIZONTAL"):
            for handle in ("AUTO", "VECTOR", "AUTO_CLAMPED"):
                prepare = bent(extend, (0.3, 0.7), (0.6, 0.35), handle=handle)
                found[f"{kind} {extend} {handle}"] = fed(f"ShaderNode{kind}", prepare, inputs=(1,))
        found[f"{kind} pulled in"] = fed(f"ShaderNode{kind}", pulled_in, inputs=(1,))
        found[f"{kind} by half"] = fed(f"ShaderNode{kind}", by_half, inputs=(1,))
    return found


def by_half(node):
    bent("EXTRAPOLATED", (0.5, 0.9))(node)
    node.inputs[0].default_value = 0.5


def values():
    import numpy as np

    return np.repeat(np.concatenate([np.linspace(-0.3, 1.3, 36), [0.2, 0.55, 0.555, 0.56]])[:, None], 3, axis=1)


@pytest.mark.blender
def test_ramps_are_those_of_cycles(tmp_path):
    from beside_cycles import alike, board, both

    shown, entries = ramps(), values()
    board(shown, entries)
    alike(both(tmp_path), shown, len(entries), 2e-5)


@pytest.mark.blender
def test_curves_of_numbers_are_those_of_cycles(tmp_path):
    from beside_cycles import alike, board, both

    shown, entries = curves(["FloatCurve"]), values()
    board(shown, entries)
    alike(both(tmp_path), shown, len(entries), 2e-5)


@pytest.mark.blender
def test_curves_of_colours_and_vectors_are_those_of_cycles(tmp_path):
    import numpy as np
    from beside_cycles import alike, board, both

    shown, entries = curves(["RGBCurve", "VectorCurve"]), np.random.default_rng(3).uniform(-0.6, 1.6, (40, 3))
    board(shown, entries)
    alike(both(tmp_path), shown, len(entries), 2e-5)


@pytest.mark.blender
def test_colours_as_numbers_have_the_luminance_of_cycles(tmp_path):
    import numpy as np
    from beside_cycles import alike, board, both, fed

    shown = {"grey": fed("ShaderNodeRGBToBW")}
    entries = np.concatenate([np.eye(3), np.random.default_rng(4).uniform(0.0, 1.0, (30, 3))])
    board(shown, entries)
    alike(both(tmp_path), shown, len(entries), 3e-7)

"""Curves and points of stages: what is read, and what is said of what does not fit."""

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

POINTS = "point3f[] points = [(0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 1, 0), (0, 0, 1), (1, 0, 1), (2, 0, 1), (3, 1, 1)]"
BASES = {"bezier": "Bezier", "bspline": "BSpline", "catmullRom": "CatmullRom"}


def read(tmp_path, text):
    path = tmp_path / "stage.usda"
    path.write_text(f'#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Y"\n)\n{text}')
    scene = gonio.load_usd(str(path))
    return scene.to_dict(), [message for _, message in scene.diagnostics]


@pytest.mark.parametrize("basis", BASES)
def test_cubic_curves_keep_basis_wrap_and_values(tmp_path, basis):
    body = f"""
    uniform token basis = "{basis}"
    uniform token wrap = "pinned"
    int[] curveVertexCounts = [4, 4]
    {POINTS}
    float[] widths = [0.1, 0.2] (interpolation = "uniform")
    color3f[] primvars:displayColor = [(1, 0, 0), (0, 1, 0)] (interpolation = "uniform")
    float[] primvars:age = [1, 2, 3, 4, 5, 6, 7, 8] (interpolation = "vertex")
    float[] primvars:wrong = [1, 2, 3] (interpolation = "vertex")
"""
    scene, messages = read(tmp_path, f'def BasisCurves "a"\n{{{body}}}\n')
    (curves,) = scene["curves"]
    assert (curves["basis"], curves["wrap"], curves["shape"]) == (BASES[basis], "Pinned", "Round")
    assert curves["widths"]["interpolation"] == "Uniform" and curves["counts"] == [4, 4]
    assert {each["name"]: each["interpolation"] for each in curves["primvars"]} == {"displayColor": "Uniform", "age": "Vertex"}
    assert scene["instances"][0]["mesh"] == {"curves": 0}
    assert sum("'wrong' has 3 values, expected 8" in message for message in messages) == 1, messages


def test_hermite_curves_become_bezier_spans(tmp_path):
    body = "int[] curveVertexCounts = [2]\npoint3f[] points = [(0, 0, 0), (3, 0, 0)]\nvector3f[] tangents = [(3, 3, 0), (3, -3, 0)]\n"
    scene, _ = read(tmp_path, f'def HermiteCurves "a"\n{{\n{body}float[] widths = [0.1, 0.3]\n}}\n')
    (curves,) = scene["curves"]
    assert curves["basis"] == "Bezier" and curves["counts"] == [4]
    assert np.allclose(curves["points"], [(0, 0, 0), (1, 1, 0), (2, 1, 0), (3, 0, 0)])
    assert curves["widths"]["interpolation"] == "Varying"


def test_nurbs_curves_follow_their_basis(tmp_path):
    body = "int[] curveVertexCounts = [4]\nint[] order = [4]\ndouble[] knots = [0, 0, 0, 0, 1, 1, 1, 1]\n"
    points = "point3f[] points = [(0, 0, 0), (1, 2, 0), (2, 2, 0), (3, 0, 0)]\nfloat[] widths = [0.1, 0.1, 0.3, 0.3]\n"
    scene, _ = read(tmp_path, f'def NurbsCurves "a"\n{{\n{body}{points}}}\n')
    (curves,) = scene["curves"]
    # With these knots it is a Bézier span.
    t = np.linspace(0, 1, len(curves["points"]))[:, None]
    control = np.array([(0, 0, 0), (1, 2, 0), (2, 2, 0), (3, 0, 0)], dtype=float)
    weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    assert np.allclose(curves["points"], sum(w * p for w, p in zip(weights, control, strict=True)), atol=1e-6)
    assert np.allclose(curves["widths"]["values"], sum(w * p for w, p in zip(weights, (0.1, 0.1, 0.3, 0.3), strict=True))[:, 0])


def test_nurbs_curves_pass_knots_between_their_ends(tmp_path):
    control = np.array([(0, 0, 0), (0.3, 0.9, 0.1), (0.7, -0.3, 0), (1, 0.8, 0), (1.3, 0.2, 0)])
    for knots, joints in (
        ("0, 0, 0, 0, 0.5, 1, 1, 1, 1", [(1, 0, 0, 0, 0), (0, 1 / 4, 1 / 2, 1 / 4, 0), (0, 0, 0, 0, 1)]),
        ("0, 1, 2, 3, 4, 5, 6, 7, 8", [(1 / 6, 2 / 3, 1 / 6, 0, 0), (0, 1 / 6, 2 / 3, 1 / 6, 0), (0, 0, 1 / 6, 2 / 3, 1 / 6)]),
    ):
        body = f"int[] curveVertexCounts = [5]\nint[] order = [4]\ndouble[] knots = [{knots}]\n"
        points = f"point3f[] points = {[tuple(point) for point in control.tolist()]}\nfloat[] widths = [0.1, 0.1, 0.1, 0.1, 0.1]\n"
        scene, _ = read(tmp_path, f'def NurbsCurves "a"\n{{\n{body}{points}}}\n')
        found = np.array(scene["curves"][0]["points"])[[0, 8, 16]]
        assert np.allclose(found, np.array(joints) @ control, atol=1e-6), knots


def test_points_have_widths_and_values(tmp_path):
    body = f"{POINTS}\nfloat[] widths = [1, 2, 3, 4, 5, 6, 7, 8]\nint64[] ids = [1, 2, 3, 4, 5, 6, 7, 8]\n"
    colour = 'color3f[] primvars:displayColor = [(1, 0, 0)] (interpolation = "constant")\n'
    scene, messages = read(tmp_path, f'def Points "a"\n{{\n{body}{colour}}}\ndef Points "b"\n{{\n{POINTS}\n}}\n')
    first, second = scene["points"]
    assert first["widths"]["values"] == [1, 2, 3, 4, 5, 6, 7, 8] and first["widths"]["interpolation"] == "Vertex"
    assert second["widths"]["values"] == [1] and sum("no widths that fit" in message for message in messages) == 1
    assert [each["mesh"] for each in scene["instances"]] == [{"points": 0}, {"points": 1}]


@pytest.mark.parametrize(("size", "width"), [(1, 5**0.5 / 400), (1000, 1)])
def test_curves_without_widths_are_thin(tmp_path, size, width):
    """Hair that Blender writes in metres has no widths."""
    points = f"point3f[] points = [(0, 0, 0), ({size}, 0, 0), ({size}, {2 * size}, 0)]"
    body = f'uniform token type = "linear"\nint[] curveVertexCounts = [3]\n{points}\n'
    scene, messages = read(tmp_path, f'def BasisCurves "a"\n{{\n{body}}}\n')
    assert scene["curves"][0]["widths"]["values"] == pytest.approx([width], rel=1e-5)
    assert any("no widths that fit" in message for message in messages)


def test_broken_curves_are_said_and_left_out(tmp_path):
    counts = "int[] curveVertexCounts = [4, 4]"
    scene, messages = read(
        tmp_path,
        'def BasisCurves "empty" {}\n'
        f'def BasisCurves "count" {{\nint[] curveVertexCounts = [3]\n{POINTS}\n}}\n'
        f'def HermiteCurves "hermite" {{\n{counts}\n{POINTS}\n}}\n'
        f'def NurbsCurves "nurbs" {{\n{counts}\nint[] order = [4, 4]\n{POINTS}\n}}\n'
        'def Points "none" {}\n',
    )
    parts = ("no usable points or curveVertexCounts", "add up to 3", "0 tangents, expected 8", "0 knots, expected 16", "no usable points")
    assert all(any(part in message for message in messages) for part in parts), messages
    assert scene["curves"] == [] and scene["points"] == []

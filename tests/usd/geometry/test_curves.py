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


def bezier(curves, number=0, samples=5):
    """Points along all spans of a curve, with values of its points beside."""
    counts = curves["counts"]
    first, points = sum(counts[:number]), np.array(curves["points"])
    t = np.linspace(0, 1, samples)[:, None]
    weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]

    def along(values):
        own = np.asarray(values).reshape(len(points), -1)[first : first + counts[number]]
        return np.concatenate([sum(w * own[at + k] for k, w in enumerate(weights)) for at in range(0, len(own) - 1, 3)])

    assert curves["basis"] == "Bezier" and counts[number] % 3 == 1
    return along(points), along


def nurbs(tmp_path, body, points, extra="float[] widths = [0.1] (interpolation = \"constant\")"):
    scene, messages = read(tmp_path, f'def NurbsCurves "a"\n{{\n{body}\npoint3f[] points = {[tuple(p) for p in points]}\n{extra}\n}}\n')
    return scene["curves"][0], messages


ARCH = [(0, 0, 0), (0, 2, 0), (2, 2, 0), (2, 0, 0)]


def test_nurbs_curves_follow_their_basis(tmp_path):
    body = "int[] curveVertexCounts = [4]\nint[] order = [4]\ndouble[] knots = [0, 0, 0, 0, 1, 1, 1, 1]\n"
    values = "float[] widths = [0.1, 0.1, 0.3, 0.3]\ncolor3f[] primvars:tint = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1)] (interpolation = \"vertex\")\n"
    curves, messages = nurbs(tmp_path, body, ARCH, values)
    assert messages == [message for message in messages if "camera" in message]
    # With these knots it is a Bézier span, here cut into many.
    found, along = bezier(curves)
    t = np.concatenate([(number + np.linspace(0, 1, 5)) / 32 for number in range(32)])[:, None]
    weights = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    of = lambda control: sum(w * np.atleast_1d(p) for w, p in zip(weights, np.array(control, dtype=float), strict=True))  # noqa: E731
    assert np.allclose(found, of(ARCH), atol=1e-6)
    assert np.allclose(along(curves["widths"]["values"])[:, 0], of([0.1, 0.1, 0.3, 0.3])[:, 0], atol=1e-6)
    (tint,) = curves["primvars"]
    assert tint["interpolation"] == "Vertex" and np.allclose(along(tint["values"]), of([(0, 0, 0), (1, 0, 0), (1, 1, 0), (1, 1, 1)]), atol=1e-6)


def test_nurbs_curves_pass_knots_between_their_ends(tmp_path):
    control = np.array([(0, 0, 0), (0.3, 0.9, 0.1), (0.7, -0.3, 0), (1, 0.8, 0), (1.3, 0.2, 0)])
    for knots, joints in (
        ("0, 0, 0, 0, 0.5, 1, 1, 1, 1", [(1, 0, 0, 0, 0), (0, 1 / 4, 1 / 2, 1 / 4, 0), (0, 0, 0, 0, 1)]),
        ("0, 1, 2, 3, 4, 5, 6, 7, 8", [(1 / 6, 2 / 3, 1 / 6, 0, 0), (0, 1 / 6, 2 / 3, 1 / 6, 0), (0, 0, 1 / 6, 2 / 3, 1 / 6)]),
    ):
        body = f"int[] curveVertexCounts = [5]\nint[] order = [4]\ndouble[] knots = [{knots}]\n"
        curves, _ = nurbs(tmp_path, body, control.tolist())
        found = np.array(curves["points"])
        assert np.allclose(found[[0, len(found) // 2, -1]], np.array(joints) @ control, atol=1e-6), knots


QUARTER = [(1, -2, 0), (1, -1, 0), (0, -1, 0)]


@pytest.mark.parametrize("wide", [0.1, 1.5])
def test_rational_curves_are_round(tmp_path, wide):
    body = "int[] curveVertexCounts = [3]\nint[] order = [3]\ndouble[] knots = [0, 0, 0, 1, 1, 1]\ndouble[] pointWeights = [1, 0.7071067811865476, 1]\n"
    curves, _ = nurbs(tmp_path, body, QUARTER, f"float[] widths = [{wide}] (interpolation = \"constant\")")
    found, _ = bezier(curves)
    assert np.abs(np.hypot(found[:, 0], found[:, 1] + 2) - 1).max() < 1e-6
    assert np.allclose(found[[0, -1]], [(1, -2, 0), (0, -1, 0)], atol=1e-6)


def test_ranges_cut_nurbs_curves(tmp_path):
    body = "int[] curveVertexCounts = [4, 3]\nint[] order = [4, 3]\ndouble[] knots = [0, 0, 0, 0, 1, 1, 1, 1, 0, 0, 0, 2, 2, 2]\ndouble2[] ranges = [(0, 0.5), (1, 2)]\n"
    curves, _ = nurbs(tmp_path, body, ARCH + QUARTER)
    first, _ = bezier(curves)
    assert np.allclose(first[[0, -1]], [(0, 0, 0), (1, 1.5, 0)], atol=1e-6)
    second, _ = bezier(curves, 1)
    assert np.allclose(second[[0, -1]], [(0.75, -1.25, 0), (0, -1, 0)], atol=1e-6)


def test_knots_as_modelling_programs_count_them(tmp_path):
    """Without the first and the last, as Maya and Rhino have them."""
    body = "int[] curveVertexCounts = [4]\nint[] order = [4]\ndouble[] knots = [{}]\n"
    curves, _ = nurbs(tmp_path, body.format("0, 0, 0, 1, 1, 1"), ARCH)
    whole, _ = nurbs(tmp_path, body.format("0, 0, 0, 0, 1, 1, 1, 1"), ARCH)
    assert curves["points"] == whole["points"]


def test_values_at_knots_go_straight_between_them(tmp_path):
    body = "int[] curveVertexCounts = [4]\nint[] order = [3]\ndouble[] knots = [0, 0, 0, 1, 2, 2, 2]\n"
    curves, _ = nurbs(tmp_path, body, ARCH, "float[] widths = [0.1, 0.5, 0.3] (interpolation = \"varying\")")
    widths = curves["widths"]
    assert widths["interpolation"] == "Varying"
    half = len(widths["values"]) // 2
    assert np.allclose(widths["values"], np.interp(np.linspace(0, 2, 2 * half + 1), [0, 1, 2], [0.1, 0.5, 0.3]), atol=1e-6)


@pytest.mark.parametrize(("interpolation", "widths", "middle"), [("vertex", (0.0, 0.0, 0.8, 0.8), 0.4), ("varying", (0.2, 0.8), 0.5), ("vertex", (0.8, 0.0, 0.0, 0.8), 0.2)])  # fmt: skip
def test_widths_along_a_bezier_curve_are_seen(tmp_path, interpolation, widths, middle):
    """The height of a straight curve's middle, from the points that are seen there."""
    path = tmp_path / "stage.usda"
    path.write_text(f"""#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Y"
)
def BasisCurves "a"
{{
    int[] curveVertexCounts = [4]
    point3f[] points = [(-3, 0, 0), (-1, 0, 0), (1, 0, 0), (3, 0, 0)]
    float[] widths = {list(widths)} (interpolation = "{interpolation}")
}}
def Camera "Cam"
{{
    token projection = "orthographic"
    float horizontalAperture = 0.5
    float verticalAperture = 10
    double3 xformOp:translate = (0, 0, 5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
""")
    scene = gonio.load_usd(str(path))
    scene.set(width=5, height=100, samples=16, passes=["alpha"], filter="box", filter_width=1.0)
    with gonio.Render(scene) as render:
        assert render.wait()
        covered = np.asarray(render.film()["alpha"])
    assert covered[:, 2].sum() / 100 == pytest.approx(middle, abs=0.015)


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

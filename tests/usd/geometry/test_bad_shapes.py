"""Curves, points and moving shapes of stages with little or wrong in them: one message and a picture, never a crash."""

import numpy as np
import pictures
import pytest

pytest.importorskip("gonio")
pytest.importorskip("pxr")

PLACES = [(-1, 0.2, 0), (-0.3, 1, 0), (0.3, 1.2, 0.2), (1, 0.2, 0), (-1, 1.4, 0), (-0.3, 0.6, 0), (0.3, 0.7, 0), (1, 1.5, 0.3)]
POINTS = f"point3f[] points = {PLACES}"
COUNTS = "int[] curveVertexCounts = [4, 4]"
SPLINE = 'uniform token basis = "catmullRom"\nuniform token wrap = "pinned"'
WIDE = 'float[] widths = [0.2] (interpolation = "constant")'
SHUTTER = "    double shutter:open = 0\n    double shutter:close = 1\n}"


def curves(*body):
    return 'def BasisCurves "Thing"\n{\n' + "\n".join([SPLINE, *body]) + "\n}\n"


def points(*body):
    return 'def Points "Thing"\n{\n' + "\n".join(body) + "\n}\n"


def every(value, count=8):
    return f"[{', '.join([str(value)] * count)}]"


def vertex(*values):
    return f'float[] widths = [{", ".join(values)}] (interpolation = "vertex")'


def samples(kind, name, *values):
    return f"{kind}[] {name}.timeSamples = {{ {', '.join(f'{k}: {value}' for k, value in enumerate(values))} }}"


def mesh(*body):
    return 'def Mesh "Thing"\n{\nuniform token subdivisionScheme = "none"\n' + "\n".join(body) + "\n}\n"


FIT = "no widths that fit"
BAD = "negative, too large or not a number"
NOWHERE = "not finite or lie beyond"
MORE = [*PLACES, (0, 0, 0)]
FACES = "int[] faceVertexCounts = [3]", "int[] faceVertexIndices = [0, 1, 2]"
# What the prim says, what is said of it, and whether something is seen.
CASES = {
    "curves of no width": (curves(COUNTS, POINTS, f"float[] widths = {every(0)}"), "all widths are 0", False),
    "curves of negative width": (curves(COUNTS, POINTS, vertex(*["-0.1"] * 8)), BAD, False),
    "curves of nan width": (curves(COUNTS, POINTS, vertex(*["nan"] * 8)), BAD, False),
    "curves of huge width": (curves(COUNTS, POINTS, vertex(*["1e30"] * 8)), BAD, False),
    "curves of some bad widths": (curves(COUNTS, POINTS, vertex("0.2", "-1", "nan", "inf", *["0.2"] * 4)), BAD, True),
    "curves of other widths": (curves(COUNTS, POINTS, vertex("0.2", "0.2", "0.2")), FIT, True),
    "curves through nowhere": (curves(COUNTS, POINTS.replace("(-0.3, 1, 0)", "(nan, inf, 0)"), WIDE), NOWHERE, True),
    "curves far away": (curves(COUNTS, f"point3f[] points = {[(1e30 * x, 1e30 * y, z) for x, y, z in PLACES]}", WIDE), NOWHERE, False),
    "curves of one point": (curves(f"int[] curveVertexCounts = {every(1)}", POINTS, WIDE), "too few points", False),
    "curves of one point among others": (curves("int[] curveVertexCounts = [1, 4, 2, 1]", POINTS, WIDE), "too few points", True),
    "curves of negative counts": (curves("int[] curveVertexCounts = [-4, 12]", POINTS, WIDE), "curveVertexCounts", False),
    "curves of absurd counts": (curves("int[] curveVertexCounts = [2147483647, 2147483647, 10]", POINTS, WIDE), "curveVertexCounts", False),
    "points of no width": (points(POINTS, f"float[] widths = {every(0)}"), "all widths are 0", False),
    "points of negative width": (points(POINTS, f"float[] widths = {every(-0.1)}"), BAD, False),
    "points of nan width": (points(POINTS, f"float[] widths = {every('nan')}"), BAD, False),
    "points of huge width": (points(POINTS, f"float[] widths = {every('1e30')}"), BAD, False),
    "points nowhere": (points(POINTS.replace("(-0.3, 1, 0)", "(nan, inf, 0)"), f"float[] widths = {every(0.3)}"), NOWHERE, True),
    "curves with other counts at a time": (
        curves(samples("int", "curveVertexCounts", "[4, 4]", "[8]"), POINTS, WIDE), "topology", True,
    ),
    "curves with more points at a time": (
        curves(samples("int", "curveVertexCounts", "[4, 4]", "[4, 5]"), samples("point3f", "points", PLACES, MORE), WIDE), "topology", True,
    ),
    "curves with nan at a time": (
        curves(COUNTS, samples("point3f", "points", PLACES, every("(nan, nan, nan)")), WIDE), "not finite", True,
    ),
    "points that become more": (
        points(samples("point3f", "points", PLACES, MORE), 'float[] widths = [0.3] (interpolation = "constant")'), "topology", True,
    ),
    "faces that change": (
        mesh(samples("int", "faceVertexCounts", "[3]", "[4]"), samples("int", "faceVertexIndices", "[0, 1, 2]", "[0, 1, 2, 3]"), POINTS),
        "topology", True,
    ),
    "mesh with nan at a time": (mesh(*FACES, samples("point3f", "points", PLACES, every("(nan, nan, nan)"))), "not blurred", True),
}  # fmt: skip


@pytest.mark.parametrize("name", CASES)
def test_bad_shapes_are_told_and_the_rest_is_shown(run, tmp_path, name):
    thing, told, seen = CASES[name]
    camera = pictures.camera().rstrip().removesuffix("}") + SHUTTER
    sky = 'def DomeLight "Sky"\n{\n    float inputs:intensity = 1\n}\n'
    path = pictures.stage(tmp_path / "stage.usda", thing, sky, camera)
    done = run("render", path, "-v", "-o", tmp_path / "out.exr", "--res", 32, 32, "--spp", 4, "--aov", "color", "--frames", "0")
    assert done.returncode == 0, done.stderr
    assert told in done.stderr and done.stderr.count("warning") <= 2, done.stderr
    picture = pictures.read(tmp_path / "out.exr")
    assert np.isfinite(picture.rgb).all()
    assert (picture["A"].max() > 0.0) == seen

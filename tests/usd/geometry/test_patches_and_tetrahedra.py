"""NURBS patches and tetrahedra of stages, as meshes."""

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HALF = 0.7071067811865476
# A quarter of a cylinder about z, of radius 1 and length 2: a rational arc along u, straight along v.
PATCH = f"""
    int uVertexCount = 3
    int vVertexCount = 2
    int uOrder = 3
    int vOrder = 2
    double[] uKnots = [0, 0, 0, 1, 1, 1]
    double[] vKnots = [0, 0, 1, 1]
    point3f[] points = [(1, 0, 0), (1, 1, 0), (0, 1, 0), (1, 0, 2), (1, 1, 2), (0, 1, 2)]
    double[] pointWeights = [1, {HALF}, 1, 1, {HALF}, 1]
    float[] primvars:height = [0, 0, 0, 2, 2, 2] (interpolation = "vertex")
"""
TETRAHEDRA = """
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]
    int4[] tetVertexIndices = [(0, 1, 2, 3), (1, 2, 3, 4)]
"""


def load(tmp_path, text, **options):
    path = tmp_path / "stage.usda"
    path.write_text("#usda 1.0\n(\n    metersPerUnit = 1\n)\n" + text)
    scene = gonio.load_usd(str(path), **options)
    return scene.to_dict(), [" ".join(map(str, line)) for line in scene.diagnostics]


def arrays(mesh):
    return np.asarray(mesh["points"]).reshape(-1, 3), np.asarray(mesh["triangles"]).reshape(-1, 3)


def area(points, triangles):
    a, b, c = (points[triangles[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1).sum() / 2


def test_a_rational_patch_is_round(tmp_path):
    scene, told = load(tmp_path, f'def NurbsPatch "P"\n{{{PATCH}}}\n')
    points, triangles = arrays(scene["meshes"][0])
    assert np.hypot(points[:, 0], points[:, 1]) == pytest.approx(1.0, abs=1e-6)
    assert area(points, triangles) == pytest.approx(np.pi, rel=2e-3)
    normals = np.asarray(scene["meshes"][0]["normals"]["values"]).reshape(-1, 3)
    assert np.abs(normals[:, :2] - points[:, :2]).max() < 1e-6
    height = next(one for one in scene["meshes"][0]["primvars"] if one["name"] == "height")
    assert np.asarray(height["values"]) == pytest.approx(points[:, 2], abs=1e-6)
    assert not any("NurbsPatch" in line for line in told), told


def test_complexity_says_how_fine(tmp_path):
    counts = [len(arrays(load(tmp_path, f'def NurbsPatch "P"\n{{{PATCH}}}\n', complexity=c)[0]["meshes"][0])[1]) for c in ("low", "high")]
    assert counts[1] == 16 * counts[0]


def test_patches_that_make_no_sense_are_left_out_and_told(tmp_path):
    wrong = [
        PATCH.replace("uVertexCount = 3", "uVertexCount = 4"),
        PATCH.replace("[0, 0, 1, 1]", "[0, 0, 1]"),
        PATCH.replace("uOrder = 3", "uOrder = 1000"),
        PATCH.replace("[0, 0, 0, 1, 1, 1]", "[0, 0, 0, 0, 0, 0]"),
        PATCH.replace("point3f[] points", "point3f[] other"),
    ]
    for text in wrong:
        scene, told = load(tmp_path, f'def NurbsPatch "P"\n{{{text}}}\n')
        assert scene["meshes"] == [] and any("/P" in line and "left out" in line for line in told), (text, told)


def test_trim_curves_are_told(tmp_path):
    _, told = load(tmp_path, f'def NurbsPatch "P"\n{{{PATCH}    int[] trimCurve:counts = [1]\n}}\n')
    assert any("trim curves" in line for line in told), told


def test_tetrahedra_show_their_outer_faces(tmp_path):
    scene, _ = load(tmp_path, f'def TetMesh "T"\n{{{TETRAHEDRA}}}\n')
    points, triangles = arrays(scene["meshes"][0])
    assert len(triangles) == 6
    middle = points.mean(axis=0)
    a, b, c = (points[triangles[:3][:, k]] for k in range(3))
    outward = np.einsum("ij,ij->i", np.cross(b - a, c - a), (a + b + c) / 3 - middle)
    assert (outward > 0).all()


def test_stated_surface_faces_count(tmp_path):
    text = TETRAHEDRA + "    int3[] surfaceFaceVertexIndices = [(0, 1, 3)]\n"
    scene, _ = load(tmp_path, f'def TetMesh "T"\n{{{text}}}\n')
    assert arrays(scene["meshes"][0])[1].tolist() == [[0, 1, 3]]


def test_tetrahedra_that_make_no_sense_are_told(tmp_path):
    for text in (TETRAHEDRA.replace("(1, 2, 3, 4)", "(1, 2, 3, 9)"), TETRAHEDRA.replace("int4[] tet", "int4[] other")):
        _, told = load(tmp_path, f'def TetMesh "T"\n{{{text}}}\n')
        assert any("/T" in line for line in told), told

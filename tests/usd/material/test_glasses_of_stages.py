"""`gonio:glass` on material prims."""

import gonio
import numpy as np
import pytest

STAGE = """#usda 1.0
(
    upAxis = "Z"
    metersPerUnit = 1
)
def Mesh "Square" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    rel material:binding = </Glass>
}
def Material "Glass"
{
    GLASS
    token outputs:mtlx:surface.connect = </Glass/Surface.outputs:surface>
    def Shader "Surface"
    {
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
        float inputs:specular_roughness = 0
        float inputs:transmission_weight = WEIGHT
        bool inputs:geometry_thin_walled = 1
        token outputs:surface
    }
}
def Mesh "Wall" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-9, -9, -1), (9, -9, -1), (9, 9, -1), (-9, 9, -1)]
    rel material:binding = </Shine>
}
def Material "Shine"
{
    token outputs:surface.connect = </Shine/Surface.outputs:surface>
    def Shader "Surface"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:emissiveColor = (1, 1, 1)
        color3f inputs:diffuseColor = (0, 0, 0)
        token outputs:surface
    }
}
def Camera "Camera"
{
    float focalLength = 500
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def passed(tmp_path, glass, weight="1"):
    """What a sheet of the glass lets pass of a wall behind it, and what is told."""
    (tmp_path / "stage.usda").write_text(STAGE.replace("GLASS", glass, 1).replace("WEIGHT", weight))
    made = gonio.load_usd(tmp_path / "stage.usda")
    made.set(width=8, height=8, samples=16)
    with gonio.Render(made) as rendering:
        rendering.wait()
        found = np.asarray(rendering.film()["color"])[..., :3].mean(axis=(0, 1))
        return [float(part) for part in found], [str(told) for told in [*made.diagnostics, *rendering.diagnostics]]


def test_a_name_and_a_file(tmp_path):
    glass = gonio.glass("N-SF6")
    (tmp_path / "glass.csv").write_text("\n".join(f"{nm} {n}" for nm, n in zip(glass["wavelengths_nm"], glass["n"], strict=True)))
    plain = passed(tmp_path, "")[0]
    whole = plain[0] / (2 * 1.5 / (1.5**2 + 1))
    expected = 2 * glass["ior"] / (glass["ior"] ** 2 + 1) * whole
    for named in ('string gonio:glass = "n-sf6"', "asset gonio:glass = @glass.csv@"):
        found, told = passed(tmp_path, named)
        assert found == pytest.approx([expected] * 3, rel=1e-3) and not any("gonio:glass" in each for each in told)


def test_what_is_no_glass_is_told(tmp_path):
    found, told = passed(tmp_path, 'string gonio:glass = "unobtainium"')
    assert found == pytest.approx(passed(tmp_path, "")[0]) and any("unobtainium" in each and "keeps its index" in each for each in told)
    (tmp_path / "bad.csv").write_text("400 1.5\n390 1.5\n700 1.5\n")
    assert any("bad.csv:2: 390 after 400" in each and "keeps its index" in each for each in passed(tmp_path, "asset gonio:glass = @bad.csv@")[1])
    assert any("lets no light pass" in each for each in passed(tmp_path, 'string gonio:glass = "water"', "0")[1])

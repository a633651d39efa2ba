"""`gonio:metal` on material prims."""

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
    rel material:binding = </Metal>
}
def Material "Metal"
{
    METAL
    token outputs:surface.connect = </Metal/Surface.outputs:surface>
    def Shader "Surface"
    {
        uniform token info:id = "UsdPreviewSurface"
        float inputs:metallic = 1
        float inputs:roughness = 0
        color3f inputs:diffuseColor = (0.2, 0.2, 0.9)
        token outputs:surface
    }
}
def DomeLight "Sky" { }
def Camera "Camera"
{
    float focalLength = 500
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def shown(tmp_path, metal):
    (tmp_path / "stage.usda").write_text(STAGE.replace("METAL", metal, 1))
    made = gonio.load_usd(tmp_path / "stage.usda")
    made.set(width=8, height=8, samples=16)
    with gonio.Render(made) as rendering:
        rendering.wait()
        film = rendering.film()
        return [float(part) for part in np.asarray(film["color"]).mean(axis=(0, 1))[:3]], [str(told) for told in rendering.diagnostics]


def test_a_name_and_a_file(tmp_path):
    gold = gonio.metal("gold")
    rows = zip(gold["wavelengths_nm"], gold["n"], gold["k"], strict=True)
    (tmp_path / "gold.csv").write_text("\n".join(f"{nm} {n} {k}" for nm, n, k in rows))
    expected = [min(part, 0.995) for part in gold["color"]]
    assert shown(tmp_path, 'string gonio:metal = "gold"')[0] == pytest.approx(expected, abs=3e-3)
    assert shown(tmp_path, "asset gonio:metal = @gold.csv@")[0] == pytest.approx(expected, abs=3e-3)
    assert shown(tmp_path, "")[0] == pytest.approx([0.2, 0.2, 0.9], abs=3e-3)


def test_no_metal_of_that_name_is_told(tmp_path):
    (tmp_path / "stage.usda").write_text(STAGE.replace("METAL", 'string gonio:metal = "unobtainium"', 1))
    made = gonio.load_usd(tmp_path / "stage.usda")
    assert any("unobtainium" in str(told) and "keeps its colours" in str(told) for told in made.diagnostics)

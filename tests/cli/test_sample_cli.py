"""`gonio bsdf --sample`: samples of stages into files that gonio reads again."""

import json

import pytest

STAGE = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Y"
)
def Xform "Sample"
{
    def Mesh "Pane" (prepend apiSchemas = ["MaterialBindingAPI"])
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-200, -200, 0), (200, -200, 0), (200, 200, 0), (-200, 200, 0)]
        uniform token subdivisionScheme = "none"
        rel material:binding = </Sample/Paint>
    }
    def Material "Paint"
    {
        token outputs:surface.connect = </Sample/Paint/Shader.outputs:surface>
        def Shader "Shader"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.5, 0.25, 0.125)
            float inputs:roughness = 1
            color3f inputs:specularColor = (0, 0, 0)
            int inputs:useSpecularWorkflow = 1
            token outputs:surface
        }
    }
}
def SphereLight "Lamp"
{
    double3 xformOp:translate = (0, 0, 100)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


@pytest.fixture
def stage(tmp_path):
    path = tmp_path / "pane.usda"
    path.write_text(STAGE)
    return path


QUICK = ("--window", "-1,-1", "1,1", "--basis", "quarter", "--error", "10%")


def test_a_sample_becomes_a_file(run, stage, tmp_path):
    out, material = tmp_path / "pane.xml", tmp_path / "material.usda"
    done = run("bsdf", "--sample", stage, *QUICK, "--colour", "-o", out, "--material", material, "--json")
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert (found["format"], found["channels"], found["sample"]["converged"]) == ("BSDF XML", "XYZ", True)
    front = found["sample"]["sides"][0]
    assert front["from"] == "front" and front["diffuse"]["transmitted"]["value"] == 0
    assert front["diffuse"]["reflected"]["value"] == pytest.approx(0.2126 * 0.5 + 0.7152 * 0.25 + 0.0722 * 0.125, rel=0.05)
    assert "Lamp" in done.stderr and "left out" in done.stderr
    again = json.loads(run("bsdf", out, "--json").stdout)
    assert again["parts"] == found["parts"] and again["problems"] == []
    assert again["albedo"][2]["reflected"]["rgb"] == pytest.approx([0.5, 0.25, 0.125], rel=0.1)
    assert "./pane.xml" in material.read_text()


def test_text(run, stage):
    text = run("bsdf", "--sample", stage, "--prim", "/Sample", *QUICK, "-q").stdout
    for part in ("sample: 4.0000 × 4.0000 × 0.0000 m, a window of 2.0000 × 2.0000 m", "diffuse light from the back: reflected", "rays:"):
        assert part in text


@pytest.mark.parametrize(
    ("options", "words"),
    [
        (("--window", "5,5", "6,6"), "beside the sample"),
        (("--window", "1,1", "1,2"), "window"),
        (("--window", "1", "2,2"), "expected X,Y"),
        (("--front", "y", "--up", "z"), "does the front look that way"),
        (("--up", "-z"), "up"),
        (("--error", "200%"), "error"),
        (("--prim", "/Lamp"), "no geometry"),
        (("--material", "m.usda"), "-o"),
        (("-o", "sample.txt"), "output"),
    ],
)
def test_what_cannot_be_measured_is_told(run, stage, options, words):
    done = run("bsdf", "--sample", stage, *options, cwd=stage.parent)
    assert done.returncode == 1 and words in done.stderr, done.stderr
    assert [path.name for path in stage.parent.iterdir()] == ["pane.usda"]


def test_nothing_to_read(run, stage):
    assert run("bsdf").returncode == 2
    assert run("bsdf", stage, "--window", "0,0", "1,1").returncode == 2
    both = run("bsdf", stage, "--sample", stage)
    assert both.returncode == 1 and "both were named" in both.stderr

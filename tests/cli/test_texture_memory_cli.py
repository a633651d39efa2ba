"""`--texture-memory`: the same picture, and what is told of it."""

import pictures
import pytest
import texture_memory as made

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Y"
)
def Mesh "Square" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 1, 0), (0, 1, 0)]
    texCoord2f[] primvars:st = [(0, 0), (2, 0), (2, 1), (0, 1)] (interpolation = "vertex")
    rel material:binding = </Looks>
}
def Material "Looks"
{
    token outputs:surface.connect = </Looks/Surface.outputs:surface>
    def Shader "Surface"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </Looks/Image.outputs:rgb>
        token outputs:surface
    }
    def Shader "Image"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @./<UDIM>.png@
        float2 inputs:st.connect = </Looks/Reader.outputs:result>
        float3 outputs:rgb
    }
    def Shader "Reader"
    {
        uniform token info:id = "UsdPrimvarReader_float2"
        string inputs:varname = "st"
        float2 outputs:result
    }
}
def Camera "Camera"
{
    matrix4d xformOp:transform = ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0), (1, 0.5, 2, 1))
    uniform token[] xformOpOrder = ["xformOp:transform"]
}
"""


@pytest.fixture(scope="module")
def stage(tmp_path_factory):
    """A square with two tiles of a UDIM set, seen from its middle."""
    folder = tmp_path_factory.mktemp("udim")
    for number in (1001, 1002):
        made.write_png(folder / f"{number}.png", 192, number)
    (folder / "square.usda").write_text(STAGE)
    return folder / "square.usda"


def test_the_picture_is_the_same(stage, picture, tmp_path):
    whole = picture(stage)
    limited = picture(stage, "--texture-memory", "1", "--texture-cache", tmp_path / "tiles")
    assert pictures.same(whole, limited) and whole["R"].any()
    assert len(list((tmp_path / "tiles").iterdir())) == 2


def test_what_it_took_is_told(stage, run, tmp_path):
    options = ["--texture-memory", "64K", "--texture-cache", tmp_path / "tiles", "--res", 32, 32, "--spp", 2, "--threads", 2]
    done = run("render", stage, "-o", tmp_path / "out.exr", "-v", *options)
    assert done.returncode == 0, done.stderr
    assert "texture memory:" in done.stderr and "looked up" in done.stderr
    quiet = run("render", stage, "-o", tmp_path / "out.exr", *options)
    # No more than that two worker threads want a megabyte is said.
    assert quiet.stderr.count("texture memory") <= 1 and "looked up" not in quiet.stderr


def test_a_size_that_is_none_is_refused(stage, run, tmp_path):
    done = run("render", stage, "-o", tmp_path / "out.exr", "--texture-memory", "lots")
    assert done.returncode == 2 and "512M" in done.stderr

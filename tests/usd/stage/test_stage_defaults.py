"""What USD's specification says where a stage says nothing: opacity, light, values of instances."""

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")

PANE = """
def Mesh "Pane" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
    rel material:binding = </M>
}
def Material "M"
{
    token outputs:surface.connect = </M/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0, 0, 0)
        float inputs:ior = 1.5
        INPUTS
        token outputs:surface
    }
}
def Camera "Cam"
{
    float focalLength = 100
    float horizontalAperture = 2
    float verticalAperture = 2
    double3 xformOp:translate = (0, 0, 8)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
# Behind the camera, so that it is seen in the pane alone.
SOFTBOX = """
def RectLight "Box"
{
    float inputs:intensity = 30
    float inputs:width = 2
    float inputs:height = 2
    double3 xformOp:translate = (0, 0, 9)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
# Before which the pane stands.
WALL = """
def RectLight "Wall"
{
    float inputs:intensity = 5
    float inputs:width = 4
    float inputs:height = 4
    double3 xformOp:translate = (0, 0, -3)
    float xformOp:rotateY = 180
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateY"]
}
"""
INTERFACE = 0.04


@pytest.mark.parametrize("mode", ["", 'token inputs:opacityMode = "transparent"'])
@pytest.mark.parametrize(("inputs", "share"), [("float inputs:opacity = 0\nfloat inputs:roughness = 0", 0), ("float inputs:opacity = 0.1\nfloat inputs:roughness = 0", 0.1)])
def test_what_is_transparent_keeps_its_reflection(picture, tmp_path, mode, inputs, share):
    pane = PANE.replace("INPUTS", inputs + "\n" + mode)
    reflected = picture(pictures.stage(tmp_path / "box.usda", pane, SOFTBOX), size=8, spp=256)
    assert reflected.rgb.mean() == pytest.approx(30 * INTERFACE, rel=0.06)
    through = picture(pictures.stage(tmp_path / "wall.usda", pane, WALL), size=8, spp=256)
    assert through.rgb.mean() == pytest.approx(5 * (1 - share) * (1 - INTERFACE), rel=0.04)


def test_presence_takes_the_reflection_along(picture, tmp_path):
    pane = PANE.replace("INPUTS", 'float inputs:opacity = 0.25\nfloat inputs:roughness = 0\ntoken inputs:opacityMode = "presence"')
    reflected = picture(pictures.stage(tmp_path / "box.usda", pane, SOFTBOX), size=8, spp=256)
    assert reflected.rgb.mean() == pytest.approx(0.25 * 30 * INTERFACE, rel=0.1)


UNLIT = """
def Mesh "White"
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 1, 4, 5, 2]
    point3f[] points = [(-1, -1, 0), (0, -1, 0), (0, 1, 0), (-1, 1, 0), (0.5, -1, -0.8660254), (0.5, 1, -0.8660254)]
    color3f[] primvars:displayColor = [(0.9, 0.9, 0.9)]
}
"""
FRONT = """
def Camera "Cam"
{
    token projection = "orthographic"
    float horizontalAperture = 30
    float verticalAperture = 30
    double3 xformOp:translate = TRANSLATE
    float3 xformOp:rotateXYZ = ROTATE
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}
"""


@pytest.mark.parametrize(("place", "turn", "left", "right"), [("(0, 0, 5)", "(0, 0, 0)", 1, 0.5), ("(4.33, 0, 2.5)", "(0, 60, 0)", 0.5, 1)])
def test_an_unlit_stage_is_lit_from_the_camera(picture, tmp_path, place, turn, left, right):
    camera = FRONT.replace("TRANSLATE", place).replace("ROTATE", turn)
    seen = picture(pictures.stage(tmp_path / "unlit.usda", UNLIT, camera), "--integrator", "direct", size=48, spp=64)
    shown = seen.rgb[24]
    covered = np.flatnonzero(seen["A"][24] > 0.99)
    assert shown[covered[1]] == pytest.approx([0.9 * left] * 3, rel=0.02)
    assert shown[covered[-2]] == pytest.approx([0.9 * right] * 3, rel=0.02)
    assert seen["A"][0, 0] == 0 and (seen.rgb[0, 0] == 0).all(), "nothing is behind"


def values(tmp_path, text, name="displayColor"):
    path = pictures.stage(tmp_path / "stage.usda", text)
    scene = gonio.load_usd(str(path))
    assert not [said for said in scene.diagnostics if "interpolation" in said[1]]
    found = []
    for instances in scene.to_dict()["instances"]:
        primvar = next(p for p in instances["primvars"] if p["name"] == name)
        found.append((primvar["interpolation"], [round(float(x), 3) for x in np.ravel(primvar["values"])]))
    return found


CUBE = 'def Cube "p" {\n double size = 1\n }'


def test_instance_interpolation_is_one_value_an_instance(tmp_path):
    text = f"""
def PointInstancer "I"
{{
    point3f[] positions = [(-2, 0, 0), (0, 0, 0), (2, 0, 0)]
    int[] protoIndices = [0, 0, 0]
    color3f[] primvars:displayColor = [(0.8, 0, 0), (0, 0.8, 0), (0, 0, 0.8)] (interpolation = "instance")
    rel prototypes = </I/p>
    {CUBE}
}}
"""
    assert values(tmp_path, text) == [("Uniform", [0.8, 0, 0, 0, 0.8, 0, 0, 0, 0.8])]


def test_instance_interpolation_with_indices_and_masked_instances(tmp_path):
    text = f"""
def PointInstancer "I"
{{
    point3f[] positions = [(-2, 0, 0), (0, 0, 0), (2, 0, 0), (4, 0, 0)]
    int[] protoIndices = [0, 0, 0, 0]
    int64[] ids = [10, 11, 12, 13]
    int64[] invisibleIds = [11]
    float[] primvars:wear = [0.25, 0.75] (interpolation = "instance")
    int[] primvars:wear:indices = [1, 0, 0, 1]
    rel prototypes = </I/p>
    {CUBE}
}}
"""
    assert values(tmp_path, text, "wear") == [("Uniform", [0.75, 0.25, 0.75])]


def test_instance_interpolation_of_a_native_instance_is_its_value(tmp_path):
    text = f"""
class "Asset"
{{
    {CUBE}
}}
def Xform "a" (instanceable = true
    inherits = </Asset>)
{{
    color3f[] primvars:displayColor = [(0.1, 0.2, 0.3)] (interpolation = "instance")
}}
"""
    assert values(tmp_path, text) == [("Constant", [0.1, 0.2, 0.3])]


def test_white_is_white_where_the_light_is_at_the_camera(run, tmp_path):
    camera = FRONT.replace("TRANSLATE", "(0, 0, 5)").replace("ROTATE", "(0, 0, 0)")
    unlit = pictures.stage(tmp_path / "unlit.usda", UNLIT, camera)
    lit = pictures.stage(tmp_path / "lit.usda", UNLIT, camera, 'def DomeLight "Sky" {}\n')

    def shown(stage, *options):
        done = run("render", stage, "-o", tmp_path / "a.png", "--res", 16, 16, "--spp", 4, *options)
        assert done.returncode == 0, done.stderr
        return (tmp_path / "a.png").read_bytes()

    assert shown(unlit) == shown(unlit, "--tonemap", "none") != shown(unlit, "--tonemap", "photographic")
    assert shown(lit) == shown(lit, "--tonemap", "photographic")


def test_indirect_samples_are_limited_where_the_light_is_at_the_camera(tmp_path):
    unlit = pictures.stage(tmp_path / "unlit.usda", UNLIT)
    lit = pictures.stage(tmp_path / "lit.usda", UNLIT, 'def DomeLight "Sky" {}\n')
    limits = [gonio.load_usd(str(stage)).to_dict()["settings"]["clamp_indirect"] for stage in (unlit, lit)]
    assert limits == [2.0, 0.0]


def test_units_of_single_precision_are_read(tmp_path):
    """As Blender 2.9 to 3.1 wrote them, which pxr refuses."""
    from pxr import Usd, UsdGeom

    path = tmp_path / "stage.usdc"
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.Sphere.Define(stage, "/s")
    UsdGeom.SetStageMetersPerUnit(stage, 0.25)
    stage.Save()
    del stage
    # A quarter as an inlined double (type 9 of the format); type 8 is a float.
    double, single = b"\x00\x00\x80\x3e\x00\x00\x09\x40", b"\x00\x00\x80\x3e\x00\x00\x08\x40"
    content = path.read_bytes()
    assert content.count(double[2:]) == 1
    copy = tmp_path / "old.usdc"
    copy.write_bytes(content.replace(double[2:], single[2:]))
    scene = gonio.load_usd(str(copy)).to_dict()
    assert scene["instances"][0]["transforms"][0]["columns"][0][0] == pytest.approx(0.25)

"""The command line: what of a stage is read, and warnings."""

import json

import numpy as np
import pictures
import pytest
from failures import fails


def test_purposes(picture, tmp_path):
    guide = 'def Cube "Guide"\n{\n    uniform token purpose = "guide"\n    double size = 3\n}\n'
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), guide)
    usual = picture(stage, "--aov", "depth", name="usual.exr")
    assert not pictures.same(usual, picture(stage, "--aov", "depth", "--purposes", "render,guide", name="guide.exr"))
    assert pictures.same(usual, picture(stage, "--aov", "depth", "--purposes", "default,proxy", name="proxy.exr"))


def test_unknown_purpose(run, room, tmp_path):
    assert "purposes" in fails(run, "render", room, "-o", tmp_path / "a.exr", "--purposes", "final")


def test_mask(picture, room):
    image = picture(room, "--mask", "/Floor,/Lamp,/Cam", "--aov", "P", "--filter", "box", "--filter-width", 0.01)
    assert np.abs(image["P.Y"]).max() < 1e-4


def test_variant(picture, run, tmp_path):
    text = """
def Xform "Choice" (
    variants = { string shape = "none" }
    prepend variantSets = "shape"
)
{
    variantSet "shape" = {
        "none" { }
        "big" {
            def Cube "Big"
            {
                double size = 3
            }
        }
    }
}
"""
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), text)
    assert not pictures.same(picture(stage, name="a.exr"), picture(stage, "--variant", "/Choice{shape=big}", name="b.exr"))
    assert "variant" in fails(run, "render", stage, "-o", tmp_path / "c.exr", "--variant", "shape=big")


def test_session_layer(picture, room, tmp_path):
    layer = tmp_path / "dim.usda"
    layer.write_text('#usda 1.0\nover "Lamp"\n{\n    float inputs:intensity = 200\n}\n')
    plain, dim = picture(room, name="a.exr"), picture(room, "--session-layer", layer, name="b.exr")
    assert dim["G"] == pytest.approx(plain["G"] / 2, rel=1e-4)
    assert pictures.same(dim, picture(room, "--sessionLayer", layer, name="c.exr"))


def test_complexity_refines(run, tmp_path):
    cube = """
def Mesh "Cube"
{
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
    point3f[] points = [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (1, 1, -1), (-1, -1, 1), (1, -1, 1), (-1, 1, 1), (1, 1, 1)]
}
"""
    stage = pictures.stage(tmp_path / "a.usda", cube)
    counts = [json.loads(run("info", stage, "--json", "--complexity", level).stdout)["triangles"] for level in ("low", "medium", "high", "veryhigh")]
    assert counts == [12, 48, 192, 768]


def test_warnings_name_the_prim_and_are_fatal_with_strict(run, tmp_path):
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), pictures.BROKEN)
    done = run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1)
    assert done.returncode == 0 and "gonio: warning: " in done.stderr and "/Broken" in done.stderr
    strict = run("render", stage, "-o", tmp_path / "b.exr", "--res", 8, 8, "--spp", 1, "--strict")
    assert strict.returncode == 1 and "/Broken" in strict.stderr and not (tmp_path / "b.exr").exists()


def test_strict_passes_a_faultless_stage(run, room, tmp_path):
    done = run("render", room, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1, "--strict")
    assert done.returncode == 0, done.stderr


def test_many_warnings_are_cut_short_without_verbose(run, tmp_path):
    many = "".join(pictures.BROKEN.replace("Broken", f"Broken{k}") for k in range(30))
    stage = pictures.stage(tmp_path / "a.usda", pictures.ROOM, pictures.LAMP, pictures.camera(), many)
    brief = run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1).stderr
    assert brief.count("gonio: warning: ") == 20 and "10 more" in brief
    assert run("render", stage, "-o", tmp_path / "a.exr", "--res", 8, 8, "--spp", 1, "-v").stderr.count("gonio: warning: ") == 30


MASKED = """
def Scope "Looks"
{
    def Material "Red"
    {
        token outputs:surface.connect = </Looks/Red/S.outputs:surface>
        def Shader "S"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.7, 0.1, 0.1)
            token outputs:surface
        }
    }
}
def Xform "World" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    rel material:binding = </Looks/Red>
    def Cube "Bound"
    {
        double size = 1
    }
    def Cube "Other"
    {
        double size = 1
    }
    def PointInstancer "Copies"
    {
        rel prototypes = [</Elsewhere/Ball>]
        int[] protoIndices = [0, 0]
        point3f[] positions = [(2, 0, 0), (4, 0, 0)]
    }
}
def Scope "Elsewhere"
{
    def Sphere "Ball" { }
}
def Scope "Lights"
{
    def SphereLight "Lamp" (prepend apiSchemas = ["CollectionAPI:lightLink"])
    {
        rel collection:lightLink:includes = </World/Other>
        bool collection:lightLink:includeRoot = 0
    }
    def SphereLight "Second" { }
}
"""


def masked(run, tmp_path, paths):
    stage = pictures.stage(tmp_path / "m.usda", MASKED, pictures.camera())
    done = run("info", stage, "--json", "--mask", paths)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_a_mask_takes_in_what_its_prims_refer_to(run, tmp_path):
    """As usdrecord, by `ExpandPopulationMask`."""
    said = masked(run, tmp_path, "/World/Bound")
    assert said["prims"].get("Cube") == 1 and said["lights"] == []
    # The binding of the prim above, which stands elsewhere.
    assert said["materials"] == 1 and said["diagnostics"] == []
    said = masked(run, tmp_path, "/World/Copies")
    # Two copies, and the prototype, which stands for itself where it is.
    assert said["instances"] == 3 and "Cube" not in said["prims"]
    # What a lamp is linked to.
    said = masked(run, tmp_path, "/Lights/Lamp")
    assert [light["path"] for light in said["lights"]] == ["/Lights/Lamp"] and said["prims"]["Cube"] == 1


def test_a_mask_takes_in_what_instances_refer_to(run, tmp_path):
    thing = """def Xform "Thing" (
    instanceable = true
    prepend references = </Proto>
)
{
}
"""
    proto = """def "Proto"
{
    def Cube "Body" (prepend apiSchemas = ["MaterialBindingAPI"])
    {
        rel material:binding = </Apart/Red>
    }
}
"""
    red = """def Scope "Apart"
{
    def Material "Red"
    {
        token outputs:surface.connect = </Apart/Red/S.outputs:surface>
        def Shader "S"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = (0.8, 0, 0)
            token outputs:surface
        }
    }
}
"""
    stage = pictures.stage(tmp_path / "m.usda", thing, proto.replace('def "Proto"', 'over "Proto"'), red, pictures.camera())
    whole = json.loads(run("info", stage, "--json").stdout)
    said = json.loads(run("info", stage, "--json", "--mask", "/Thing").stdout)
    assert said["materials"] == whole["materials"] == 1 and said["diagnostics"] == whole["diagnostics"] == []


def test_a_mask_keeps_the_camera_and_the_settings_that_are_named(run, tmp_path):
    settings = 'def Scope "Render"\n{\n    def RenderSettings "S"\n    {\n        rel camera = </Cam>\n        uniform int2 resolution = (8, 4)\n    }\n}\n'
    stage = pictures.stage(tmp_path / "m.usda", MASKED, pictures.camera(), pictures.camera("Left", -2), settings)
    options = ("--mask", "/World/Bound", "--spp", 1)
    done = run("render", stage, "-o", tmp_path / "a.exr", *options, "--settings", "/Render/S", "-v")
    assert done.returncode == 0, done.stderr
    picture = pictures.read(tmp_path / "a.exr")
    assert picture.shape == (4, 8) and picture.header["gonio:camera"] == "/Cam"
    done = run("render", stage, "-o", tmp_path / "b.exr", *options, "--res", 4, 4, "--camera", "/Left")
    assert done.returncode == 0 and pictures.read(tmp_path / "b.exr").header["gonio:camera"] == "/Left", done.stderr
    stage.write_text(stage.read_text().replace("upAxis", 'renderSettingsPrimPath = "/Render/S"\n    upAxis', 1))
    done = run("render", stage, "-o", tmp_path / "c.exr", *options)
    assert done.returncode == 0 and "renderSettingsPrimPath" not in done.stderr, done.stderr
    assert pictures.read(tmp_path / "c.exr").shape == (4, 8)


def test_a_masks_materials_may_stand_in_a_document(run, tmp_path):
    (tmp_path / "doc.mtlx").write_text(
        '<materialx version="1.39"><surface_unlit name="U" type="surfaceshader"/>'
        '<surfacematerial name="M" type="material"><input name="surfaceshader" type="surfaceshader" nodename="U"/></surfacematerial></materialx>'
    )
    (tmp_path / "looks.usda").write_text('#usda 1.0\n(\n    defaultPrim = "L"\n)\ndef "L" (references = @doc.mtlx@</MaterialX>) {}\n')
    text = 'def "Looks" (references = @looks.usda@) {}\ndef Cube "C" (prepend apiSchemas = ["MaterialBindingAPI"])\n{\n    rel material:binding = </Looks/Materials/M>\n}\n'
    stage = pictures.stage(tmp_path / "m.usda", text, pictures.camera())
    said = json.loads(run("info", stage, "--json", "--mask", "/C").stdout)
    assert said["materials"] == 1 and said["diagnostics"] == [], said["diagnostics"]


ELSEWHERE = """
def Scope "Looks"
{
    def Material "Red"
    {
        token outputs:surface.connect = </Shared/S.outputs:surface>
    }
}
def Scope "Shared"
{
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </Readers/R.outputs:result>
        token outputs:surface
    }
}
def Scope "Readers"
{
    def Shader "R"
    {
        uniform token info:id = "UsdPrimvarReader_float3"
        float3 inputs:fallback = (1, 0, 0)
        string inputs:varname = "x"
        float3 outputs:result
    }
}
def Scope "Sets" (prepend apiSchemas = ["CollectionAPI:c"])
{
    rel collection:c:includes = </Chosen/A>
}
def Xform "Chosen" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    rel material:binding:collection:c = [</Sets.collection:c>, </Looks/Red>]
    def Sphere "A" { }
    def Sphere "B" { }
}
class "_kind" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    rel material:binding:full = </Looks/Red>
}
def Sphere "Kept" (inherits = </_kind>) { }
def Mesh "Parted"
{
    int[] faceVertexCounts = [3, 3]
    int[] faceVertexIndices = [0, 1, 2, 0, 2, 1]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]
    def GeomSubset "first" (prepend apiSchemas = ["MaterialBindingAPI"])
    {
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices = [0]
        rel material:binding = </Looks/Red>
    }
}
"""


@pytest.mark.parametrize(("path", "materials", "things"), [("/Chosen/A", 1, 1), ("/Kept", 1, 1), ("/Parted", 2, 1)])
def test_a_masks_materials_are_found_by_collection_class_and_subset(run, tmp_path, path, materials, things):
    """Their nodes stand in yet other places."""
    stage = pictures.stage(tmp_path / "m.usda", ELSEWHERE, pictures.camera())
    said = json.loads(run("info", stage, "--json", "--mask", path).stdout)
    assert (said["materials"], said["instances"], said["diagnostics"]) == (materials, things, [])

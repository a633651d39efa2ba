"""A thousand malformed variants of ten stages: no crash, no hang, one clear message each. GONIO_VARIANTS says how many."""

import os
import pathlib
import subprocess

import pytest
import variants

REPOSITORY = pathlib.Path(__file__).resolve().parents[3]
COUNT = int(os.environ.get("GONIO_VARIANTS", "1000"))
# Longest that a variant may take, seconds.
LONGEST = 20
# What no message may show.
BAD_WORDS = ("Traceback", "panicked", "thread '", "RUST_BACKTRACE", "/usr/src", "Segmentation")

OWN = """#usda 1.0
(
    upAxis = "Z"
    metersPerUnit = 0.01
    renderSettingsPrimPath = "/Render/Settings"
)
def Scope "Render"
{
    def RenderSettings "Settings"
    {
        uniform int2 resolution = (16, 9)
        rel camera = </Cam>
        rel products = </Render/Product>
        float4 dataWindowNDC = (-0.1, 0, 1, 1)
    }
    def RenderProduct "Product"
    {
        token productName = "unused.exr"
        rel orderedVars = [</Render/Color>, </Render/Wear>]
    }
    def RenderVar "Color"
    {
        string sourceName = "Ci"
    }
    def RenderVar "Wear"
    {
        string sourceName = "wear"
        token sourceType = "primvar"
        token dataType = "float"
    }
}
def Camera "Cam"
{
    float fStop = 2
    float focusDistance = 400
    double3 xformOp:translate = (0, -500, 100)
    double3 xformOp:rotateXYZ = (80, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}
def Mesh "Body" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4, 4, 3]
    int[] faceVertexIndices = [0, 1, 2, 3, 3, 2, 4, 5, 4, 2, 1]
    point3f[] points.timeSamples = {
        1: [(-90, 0, 0), (90, 0, 0), (90, 0, 90), (-90, 0, 90), (90, 90, 90), (-90, 90, 90)],
        9: [(-80, 0, 0), (80, 0, 0), (80, 0, 80), (-80, 0, 80), (80, 80, 80), (-80, 80, 80)],
    }
    int[] creaseIndices = [0, 1]
    int[] creaseLengths = [2]
    float[] creaseSharpnesses = [3]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1)] (interpolation = "faceVarying")
    int[] primvars:st:indices = [0, 1, 2, 2, 0, 1, 2, 0, 1, 2, 0]
    float[] primvars:wear = [0.1, 0.2, 0.3] (interpolation = "uniform")
    rel material:binding = </Looks/Paint>
    def GeomSubset "Part"
    {
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices = [1]
    }
}
def PointInstancer "Crowd"
{
    int[] protoIndices = [0, 1, 0]
    point3f[] positions = [(-50, 0, 0), (0, 0, 0), (50, 0, 0)]
    quath[] orientations = [(1, 0, 0, 0), (0.7, 0, 0.7, 0), (1, 0, 0, 0)]
    float3[] scales = [(1, 1, 1), (2, 2, 2), (1, 1, 1)]
    int64[] invisibleIds = [2]
    rel prototypes = [</Crowd/Ball>, </Crowd/Can>]
    def Sphere "Ball"
    {
        double radius = 10
    }
    def Cylinder "Can"
    {
        double height = 20
        double radius = 5
        token axis = "X"
    }
}
def RectLight "Panel" (prepend apiSchemas = ["ShapingAPI"])
{
    float inputs:intensity = 3000
    float inputs:width = 60
    float inputs:height = 60
    float inputs:shaping:cone:angle = 60
    bool inputs:enableColorTemperature = 1
    float inputs:colorTemperature = 3000
    double3 xformOp:translate = (0, 0, 300)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DomeLight "Sky"
{
    float inputs:intensity = 0.2
}
def Scope "Looks"
{
    def Material "Paint"
    {
        token outputs:surface.connect = </Looks/Paint/S.outputs:surface>
        def Shader "S"
        {
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor.connect = </Looks/Paint/T.outputs:rgb>
            float inputs:roughness = 0.4
            float inputs:clearcoat = 1
            token outputs:surface
        }
        def Shader "T"
        {
            uniform token info:id = "UsdUVTexture"
            asset inputs:file = @absent.png@
            float2 inputs:st.connect = </Looks/Paint/P.outputs:result>
            float4 inputs:fallback = (0.2, 0.4, 0.6, 1)
            float3 outputs:rgb
        }
        def Shader "P"
        {
            uniform token info:id = "UsdPrimvarReader_float2"
            string inputs:varname = "st"
            float2 outputs:result
        }
    }
}
"""


def as_crate(path, text=OWN):
    from pxr import Sdf

    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(text)
    layer.Export(str(path))
    return path.read_bytes()


def as_package(path):
    from pxr import UsdUtils

    # A package wants all its files.
    as_crate(path.with_name("inner.usdc"), OWN.replace("            asset inputs:file = @absent.png@\n", ""))
    assert UsdUtils.CreateNewUsdzPackage(str(path.with_name("inner.usdc")), str(path))
    return path.read_bytes()


def stages(folder):
    """Ten stages by name, of all three formats; of the shared ones as many as there are."""
    found = {"own.usda": OWN.encode(), "own.usdc": as_crate(folder / "own.usdc"), "own.usdz": as_package(folder / "own.usdz")}
    for name in ("sundial.usda", "downlight.usda"):
        found[name] = (REPOSITORY / "examples" / "usd" / name).read_bytes()
    shared = pathlib.Path(os.environ.get("GONIO_SHARED", REPOSITORY.parent / "shared")) / "data" / "usd"
    paths = [
        "wg-assets/test_assets/MaterialXTest/basic.usda",
        "wg-assets/test_assets/USDZ/BoxAnimated/BoxAnimated.usdz",
        "wg-assets/test_assets/RelationshipEncapsulationTests/InternalReferenceTest.usda",
        "wg-assets/test_assets/foundation/stage_composition/inherit_and_specialize.usda",
        "wg-assets/test_assets/schemaTests/usdGeom/primitives/capsule.usda",
    ]
    found.update({pathlib.Path(path).name: (shared / path).read_bytes() for path in paths if (shared / path).exists()})
    return found


def judge(run, stage, out):
    """What is wrong with how a run went, or nothing."""
    try:
        done = run("render", stage, "-o", out, "--res", 8, 8, "--spp", 1, "-j", 1, "--time-limit", LONGEST, timeout=LONGEST)
    except subprocess.TimeoutExpired:
        return "hangs"
    if any(word in done.stderr for word in BAD_WORDS):
        return f"says {done.stderr[-300:]!r}"
    if done.returncode == 0:
        return None if out.exists() else "ends well without a picture"
    errors = [line for line in done.stderr.splitlines() if line.startswith("gonio: error: ")]
    if done.returncode not in (1, 3) or len(errors) != 1:
        return f"ends with {done.returncode} and {done.stderr[-300:]!r}"
    return None if len(errors[0]) < 600 and not out.exists() else f"has a message of {len(errors[0])} letters, or a picture beside an error"


@pytest.mark.validate
@pytest.mark.timeout(7200)
def test_malformed_variants(run, tmp_path):
    pytest.importorskip("pxr")
    sources = stages(tmp_path)
    faults, seen = [], {}
    for number in range(COUNT):
        name = list(sources)[number % len(sources)]
        data, kind = variants.variant(sources[name], name, number // len(sources))
        stage, out = tmp_path / f"variant_{name}", tmp_path / "out.exr"
        stage.write_bytes(data)
        out.unlink(missing_ok=True)
        seen[kind] = seen.get(kind, 0) + 1
        if fault := judge(run, stage, out):
            kept = tmp_path / f"fault_{number}_{name}"
            stage.rename(kept)
            faults.append(f"{number} {name} {kind}: {fault}; kept as {kept}")
    print(seen)
    assert not faults, "\n".join(faults)

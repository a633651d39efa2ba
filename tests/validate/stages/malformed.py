"""Malformed variants of ten stages, run in shares: what is judged stands in a ledger, and the next run goes on behind it.

    python tests/validate/stages/malformed.py --ledger out/variants.jsonl --minutes 20 --patience 6
"""

import argparse
import contextlib
import json
import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

import variants

REPOSITORY = pathlib.Path(__file__).resolve().parents[3]
COUNT = 1000
# Longest that a variant may take, seconds of the processor; of the clock it may be so many times that where others work too.
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


def gonio(*arguments, timeout):
    """Runs gonio with the arguments; gives the finished process with its text."""
    script = pathlib.Path(sys.executable).with_name("gonio")
    line = ([str(script)] if script.exists() else [sys.executable, "-m", "gonio.cli"]) + [str(argument) for argument in arguments]
    return subprocess.run(line, capture_output=True, text=True, errors="replace", timeout=timeout)


def seconds_of_children():
    """Time of the processor that children have used which have ended."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime


def judge(run, stage, out, patience=1):
    """What is wrong with how a run went, or nothing; and the line of its error."""
    line = ("render", stage, "-o", out, "--res", 8, 8, "--spp", 1, "-j", 1, "--time-limit", LONGEST)
    before = seconds_of_children()
    for tries_left in (1, 0):
        try:
            done = run(*line, timeout=LONGEST * patience)
            break
        except subprocess.TimeoutExpired:
            # One that was held up from outside has used little time.
            if not tries_left or seconds_of_children() - before > LONGEST / 2:
                return "hangs", ""
    if (used := seconds_of_children() - before) > LONGEST:
        return f"takes {used:.0f} s", ""
    if any(word in done.stderr for word in BAD_WORDS):
        return f"says {done.stderr[-300:]!r}", ""
    if done.returncode == 0:
        return None if out.exists() else "ends well without a picture", ""
    errors = [line for line in done.stderr.splitlines() if line.startswith("gonio: error: ")]
    if done.returncode not in (1, 3) or len(errors) != 1:
        return f"ends with {done.returncode} and {done.stderr[-300:]!r}", ""
    is_clear = len(errors[0]) < 600 and not out.exists()
    return None if is_clear else f"has a message of {len(errors[0])} letters, or a picture beside an error", errors[0]


def read_ledger(path):
    """What is known of variants, by their numbers; of a line that was being written nothing."""
    known = {}
    for line in path.read_text().splitlines() if path and path.exists() else []:
        with contextlib.suppress(ValueError):
            entry = json.loads(line)
            known[entry["number"]] = entry
    return known


def judge_all(run, folder, count=COUNT, ledger=None, minutes=None, patience=1):
    """Judges the variants that the ledger does not have; gives all that are known by number. What went wrong is kept in the folder."""
    sources, known = stages(folder), read_ledger(ledger)
    end = time.monotonic() + 60 * minutes if minutes else None
    for number in range(count):
        if number in known:
            continue
        if end and time.monotonic() > end:
            break
        name = list(sources)[number % len(sources)]
        data, kind = variants.variant(sources[name], name, number // len(sources))
        stage, out = folder / f"variant_{name}", folder / "out.exr"
        stage.write_bytes(data)
        out.unlink(missing_ok=True)
        fault, message = judge(run, stage, out, patience)
        if fault:
            kept = folder / f"fault_{number}_{name}"
            stage.rename(kept)
            fault += f"; kept as {kept}"
        known[number] = {"number": number, "name": name, "kind": kind, "fault": fault, "message": message}
        if ledger:
            with ledger.open("a") as file:
                file.write(json.dumps(known[number]) + "\n")
    return known


def faults_of(known):
    """A line for each variant that went wrong."""
    return [f"{entry['number']} {entry['name']} {entry['kind']}: {entry['fault']}" for entry in known.values() if entry["fault"]]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--count", type=int, default=COUNT)
    parser.add_argument("--ledger", type=pathlib.Path, required=True)
    parser.add_argument("--minutes", type=float)
    parser.add_argument("--patience", type=float, default=1)
    given = parser.parse_args()
    given.ledger.parent.mkdir(parents=True, exist_ok=True)
    folder = pathlib.Path(tempfile.mkdtemp(prefix="gonio_variants_"))
    known = judge_all(gonio, folder, given.count, given.ledger, given.minutes, given.patience)
    faults = faults_of(known)
    print(f"{len(known)} of {given.count} judged, {len(faults)} with faults", *faults, sep="\n")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()

"""Frames of an animation: each is the picture that it is alone, whatever was rendered before it; what time does not change is kept."""

import pathlib
import re
import subprocess

import numpy as np
import pictures
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdSkel, Vt

FRAMES = (1, 2, 3, 4)

# Of each kind of shape one that stands still, and one of which something changes with time.
MOVING = """
def Mesh "Sheet"
{
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 3, 2, 5, 4]
    point3f[] points.timeSamples = {
        1: [(-3, 1, -1), (-2, 1, -1), (-2, 1.5, -2), (-3, 1.5, -2), (-3, 2.5, -1), (-2, 2.5, -1)],
        4: [(-3, 1, -1), (-2, 1, -1), (-2, 2.5, -2), (-3, 2.5, -2), (-3, 3, -1), (-2, 3, -1)],
    }
}
def Mesh "Slider"
{
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 3, 2, 5, 4]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (1, 0.5, 0), (0, 0.5, 0), (0, 1, 0.3), (1, 1, 0.3)]
    color3f[] primvars:displayColor.timeSamples = { 1: [(0.8, 0.2, 0.1)], 4: [(0.1, 0.8, 0.2)] }
    double3 xformOp:translate = (-2, 0.2, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Mesh "Split" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 3, 2, 5, 4]
    point3f[] points = [(1, 1, -2), (2, 1, -2), (2, 1.5, -2), (1, 1.5, -2), (1, 2, -1.7), (2, 2, -1.7)]
    uniform token subdivisionScheme = "none"
    rel material:binding = </Looks/Grey>
    def GeomSubset "Part"
    {
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices.timeSamples = { 1: [0], 3: [1] }
        rel material:binding = </Looks/Red>
    }
}
def Sphere "Swelling"
{
    double radius.timeSamples = { 1: 0.2, 4: 0.5 }
    double3 xformOp:translate.timeSamples = { 1: (0, 2, 0), 4: (1, 2, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "Carrier"
{
    double xformOp:rotateY.timeSamples = { 1: 0, 4: 90 }
    uniform token[] xformOpOrder = ["xformOp:rotateY"]
    color3f[] primvars:displayColor.timeSamples = { 1: [(0.2, 0.2, 0.9)], 4: [(0.9, 0.9, 0.1)] }
    def Cube "Rider"
    {
        double size = 0.5
        double3 xformOp:translate = (2, 0.3, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def BasisCurves "Hair"
    {
        uniform token type = "linear"
        int[] curveVertexCounts = [3]
        point3f[] points = [(1, 0, 1), (1, 0.6, 1), (1.2, 1, 1)]
        float[] widths = [0.1] (interpolation = "constant")
    }
    def Points "Dust"
    {
        point3f[] points.timeSamples = { 1: [(-1, 0.5, 1), (-1.5, 0.5, 1)], 4: [(-1, 1.5, 1), (-1.5, 0.2, 1)] }
        float[] widths = [0.3, 0.2]
    }
}
def Sphere "Blinking"
{
    double radius = 0.3
    token visibility.timeSamples = { 1: "inherited", 2: "invisible", 3: "inherited" }
    double3 xformOp:translate = (2, 0.4, 1.5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def PointInstancer "Crowd"
{
    int[] protoIndices = [0, 0, 1]
    point3f[] positions.timeSamples = { 1: [(-2, 0.2, 2), (-1, 0.2, 2), (0, 0.2, 2)], 4: [(-2, 0.8, 2), (-1, 0.5, 2), (0, 0.2, 1)] }
    rel prototypes = [</Crowd/Ball>, </Crowd/Tile>]
    def Sphere "Ball"
    {
        double radius = 0.2
    }
    def Mesh "Tile"
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (0.4, 0, 0), (0.4, 0.4, 0), (0, 0.4, 0)]
    }
}
class "Chair"
{
    def Mesh "Seat"
    {
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(0, 0, 0), (0.5, 0, 0), (0.5, 0, -0.5), (0, 0, -0.5)]
        double3 xformOp:translate.timeSamples = { 1: (0, 0.2, 0), 4: (0, 0.7, 0) }
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
def Xform "A" (
    instanceable = true
    prepend inherits = </Chair>
)
{
    double3 xformOp:translate = (-1, 0, -1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "B" (
    instanceable = true
    prepend inherits = </Chair>
)
{
    double3 xformOp:translate.timeSamples = { 1: (0, 0, -1), 4: (0.5, 0.3, -1) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""

PULSING = """
def RectLight "Pulsing"
{
    float inputs:intensity.timeSamples = { 1: 2, 4: 9 }
    float inputs:width = 2
    float inputs:height = 2
    double3 xformOp:translate = (0, 5, 0)
    float xformOp:rotateX = -90
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateX"]
}
"""


def moving(folder, *more):
    return pictures.stage(folder / "moving.usda", pictures.ROOM, pictures.LAMP, MOVING, PULSING, pictures.camera(), *more)


def bent(folder, blurred=False):
    """The stage of all kinds, with a skinned mesh under a SkelRoot that bends."""
    path = moving(folder)
    stage = Usd.Stage.Open(str(path))
    root = UsdSkel.Root.Define(stage, "/Figure")
    UsdGeom.XformCommonAPI(root).SetTranslate(Gf.Vec3d(-2.5, 0, 0))
    skeleton = UsdSkel.Skeleton.Define(stage, "/Figure/Skeleton")
    joints = ["Hip", "Hip/Knee"]
    rest = [Gf.Matrix4d(1), Gf.Matrix4d().SetTranslate(Gf.Vec3d(0, 1, 0))]
    skeleton.CreateJointsAttr(joints)
    skeleton.CreateRestTransformsAttr(rest)
    skeleton.CreateBindTransformsAttr([Gf.Matrix4d(1), Gf.Matrix4d().SetTranslate(Gf.Vec3d(0, 1, 0))])
    motion = UsdSkel.Animation.Define(stage, "/Motion")
    motion.CreateJointsAttr(joints)
    motion.CreateTranslationsAttr([Gf.Vec3f(0), Gf.Vec3f(0, 1, 0)])
    motion.CreateScalesAttr([Gf.Vec3h(1), Gf.Vec3h(1)])
    for frame in FRAMES:
        turn = Gf.Quatf(Gf.Rotation(Gf.Vec3d(0, 0, 1), 20.0 * frame).GetQuat())
        motion.CreateRotationsAttr().Set(Vt.QuatfArray([Gf.Quatf(1), turn]), frame)
    mesh = UsdGeom.Mesh.Define(stage, "/Figure/Leg")
    mesh.CreatePointsAttr([(-0.2, 0, 0), (0.2, 0, 0), (0.2, 1, 0), (-0.2, 1, 0), (0.2, 2, 0), (-0.2, 2, 0)])
    mesh.CreateFaceVertexCountsAttr([4, 4])
    mesh.CreateFaceVertexIndicesAttr([0, 1, 2, 3, 3, 2, 4, 5])
    mesh.CreateSubdivisionSchemeAttr("none")
    for prim in (mesh.GetPrim(), skeleton.GetPrim()):
        binding = UsdSkel.BindingAPI.Apply(prim)
        binding.CreateSkeletonRel().SetTargets(["/Figure/Skeleton"])
        binding.CreateAnimationSourceRel().SetTargets(["/Motion"])
    binding = UsdSkel.BindingAPI(mesh)
    binding.CreateJointIndicesPrimvar(False, 1).Set(Vt.IntArray([0, 0, 0, 0, 1, 1]))
    binding.CreateJointWeightsPrimvar(False, 1).Set(Vt.FloatArray([1] * 6))
    if blurred:
        camera = stage.GetPrimAtPath(next(prim.GetPath() for prim in stage.Traverse() if prim.GetTypeName() == "Camera"))
        camera.CreateAttribute("shutter:open", Sdf.ValueTypeNames.Double).Set(-0.25)
        camera.CreateAttribute("shutter:close", Sdf.ValueTypeNames.Double).Set(0.25)
    out = folder / "bent.usda"
    stage.Export(str(out))
    return out


def frames_of(run, stage, folder, frames, *options):
    done = run("render", stage, f"--frames={frames}", "-o", folder / "####.exr", "--res", 48, 48, "--spp", 4, "--verbose", *options)
    assert done.returncode == 0, done.stderr
    return done.stderr


def held_against_alone(run, stage, folder, frames):
    told = frames_of(run, stage, folder / "all", frames)
    before = None
    for frame in FRAMES:
        frames_of(run, stage, folder / f"alone{frame}", frame)
        alone = pictures.read(folder / f"alone{frame}" / f"{frame:04}.exr")
        assert pictures.same(pictures.read(folder / "all" / f"{frame:04}.exr"), alone), frame
        assert before is None or not pictures.same(before, alone), "nothing moves"
        before = alone
    return [int(count) for count in re.findall(r"(\d+) shapes are as in the frame before", told)]


@pytest.mark.parametrize("frames", ["1:4", "3,1,4,2"])
def test_a_frame_of_a_sequence_is_that_frame_alone(run, tmp_path, frames):
    kept = held_against_alone(run, moving(tmp_path), tmp_path, frames)
    # Floor, seat and tile; box, two balls, rider and the blinking ball, whose geometry is another's; the hair.
    assert len(kept) == 3 and min(kept) >= 7


def test_skinned_meshes_among_others(run, tmp_path):
    kept = held_against_alone(run, bent(tmp_path), tmp_path, "1:4")
    assert len(kept) == 3 and min(kept) >= 1


def test_frames_that_are_blurred(run, tmp_path):
    held_against_alone(run, bent(tmp_path, blurred=True), tmp_path, "1:4")


def test_a_frame_that_fails_does_not_end_the_sequence(run, tmp_path):
    """At the second frame the luminaire's file is not there."""
    profile = tmp_path / "lamp.ies"
    profile.write_text("IESNA:LM-63-2002\nTILT=NONE\n1 1000 1 3 1 1 2 0 0 0\n1 1 10\n0 45 90\n0\n100 80 0\n")
    asset = f'asset inputs:shaping:ies:file.timeSamples = {{ 1: @{profile.name}@, 2: @absent.ies@, 3: @{profile.name}@ }}'
    lamp = f'def SphereLight "Spot" (prepend apiSchemas = ["ShapingAPI"])\n{{\n    float inputs:intensity = 5\n    {asset}\n}}\n'
    stage = pictures.stage(tmp_path / "failing.usda", pictures.ROOM, lamp, pictures.camera())
    done = run("render", stage, "--frames", "1:3", "-o", tmp_path / "a.#.exr", "--res", 8, 8, "--spp", 1)
    assert done.returncode == 1
    assert "frame 2: error: " in done.stderr and "error: 1 of 3 frames failed: 2" in done.stderr, done.stderr
    assert sorted(path.name for path in tmp_path.glob("*.exr")) == ["a.1.exr", "a.3.exr"]
    alone = run("render", stage, "--frames", "2", "-o", tmp_path / "b.#.exr", "--res", 8, 8, "--spp", 1)
    assert alone.returncode == 1 and len([line for line in alone.stderr.splitlines() if "error" in line]) == 1


def resident(process):
    """Bytes of memory of a process and of those below it that are resident."""
    folder = pathlib.Path("/proc")
    below = (folder / f"{process}/task/{process}/children").read_text().split()
    status = ((folder / str(pid) / "status").read_text() for pid in (process, *below))
    return sum(int(re.search(r"VmRSS:\s+(\d+)", text).group(1)) * 1024 for text in status)


@pytest.mark.validate
@pytest.mark.timeout(1800)
def test_a_thousand_frames_leak_nothing(command, tmp_path):
    """From the hundredth frame on the memory stays within a few megabytes; the stage moves all the time."""
    stage = bent(tmp_path, blurred=True)
    line = [*command, "render", str(stage), "--frames", "1:1000", "-o", str(tmp_path / "####.png"), "--res", "8", "8", "--spp", "1", "-j", "1"]
    with subprocess.Popen(line, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True) as process:
        sizes = [resident(process.pid) for printed in process.stdout if printed.strip().endswith(".png")]
    assert process.returncode == 0 and len(sizes) == 1000
    print(f"frame 100: {sizes[99] / 1e6:.1f} MB, 500: {sizes[499] / 1e6:.1f} MB, 1000: {sizes[-1] / 1e6:.1f} MB")
    middle, last = np.median(sizes[100:200]), np.median(sizes[900:])
    assert last - middle < 6e6, (middle, last)

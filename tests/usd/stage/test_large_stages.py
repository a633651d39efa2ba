"""Large stages: how long a large mesh and many small ones take to read, and how much memory many instances take."""

import os
import re
import statistics
import subprocess
import sys

import numpy as np
import pytest
from pxr import Gf, Sdf, Usd, UsdGeom, UsdShade, Vt

pytestmark = pytest.mark.validate

LONGEST_READ_S = 0.3
LONGEST_INGEST_S = 1.5
MOST_BYTES = 1e9


def wavy(stage, path, squares):
    """A square of triangles, `squares` squares a side."""
    side = np.linspace(0, 1, squares + 1, dtype="f4")
    x, z = np.meshgrid(side, side)
    points = np.stack([x, 0.05 * np.sin(20 * x) * np.cos(20 * z), z], axis=-1).reshape(-1, 3).astype("f4")
    corner = np.arange(squares * (squares + 1)).reshape(squares, squares + 1)[:, :-1].ravel()
    square = corner[:, None] + np.array([0, 1, squares + 2, 0, squares + 2, squares + 1])
    mesh = UsdGeom.Mesh.Define(stage, path)
    mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy(points))
    mesh.CreateFaceVertexIndicesAttr(Vt.IntArray.FromNumpy(square.ravel().astype("i4")))
    mesh.CreateFaceVertexCountsAttr(Vt.IntArray.FromNumpy(np.full(2 * len(corner), 3, dtype="i4")))
    mesh.CreateSubdivisionSchemeAttr("none")


def lit(path):
    """A stage in metres under an even sky."""
    stage = Usd.Stage.CreateNew(str(path))
    UsdGeom.SetStageMetersPerUnit(stage, 1)
    stage.DefinePrim("/Sky", "DomeLight")
    return stage


def test_a_million_triangles_are_read_in_a_third_of_a_second(run, tmp_path):
    stage = lit(tmp_path / "large.usdc")
    wavy(stage, "/Mesh", 708)
    stage.Save()
    seconds = []
    for _ in range(5):
        done = run("render", tmp_path / "large.usdc", "-o", tmp_path / "a.exr", "--res", 64, 64, "--spp", 1, "--verbose")
        assert done.returncode == 0 and "1002528 triangles" in done.stderr, done.stderr
        seconds.append(float(re.search(r"read in ([\d.]+) s", done.stderr).group(1)))
    assert statistics.median(seconds) < LONGEST_READ_S, seconds


def test_200_thousand_instances_stay_under_a_gigabyte(command, tmp_path):
    stage = lit(tmp_path / "many.usdc")
    instancer = UsdGeom.PointInstancer.Define(stage, "/Many")
    wavy(stage, "/Many/Mesh", 71)
    instancer.CreatePrototypesRel().SetTargets(["/Many/Mesh"])
    place = np.arange(200_000)
    positions = np.stack([place % 448 * 1.2, 0 * place, place // 448 * 1.2], axis=-1).astype("f4")
    instancer.CreatePositionsAttr(Vt.Vec3fArray.FromNumpy(positions))
    instancer.CreateProtoIndicesAttr(Vt.IntArray.FromNumpy(np.zeros(len(place), dtype="i4")))
    stage.Save()
    line = [*command, "render", str(tmp_path / "many.usdc"), "-o", str(tmp_path / "a.exr"), "--res", "256", "256", "--spp", "4"]
    process = subprocess.Popen(line)
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0
    assert usage.ru_maxrss * 1024 < MOST_BYTES, usage.ru_maxrss


def unique_blocks(stage, count, material_count=200, parent="/World/Row{row}"):
    """Blocks of points of their own, each with a place and a material, half of them with a primvar; a hundred a row."""
    chance = np.random.default_rng(7)
    materials = []
    for number in range(material_count):
        material = UsdShade.Material.Define(stage, f"/Looks/M{number}")
        shader = UsdShade.Shader.Define(stage, f"/Looks/M{number}/S")
        shader.CreateIdAttr("UsdPreviewSurface")
        shader.CreateInput("diffuseColor", Sdf.ValueTypeNames.Color3f).Set(Gf.Vec3f(*chance.random(3).tolist()))
        shader.CreateInput("roughness", Sdf.ValueTypeNames.Float).Set(float(chance.random()))
        material.CreateSurfaceOutput().ConnectToSource(shader.ConnectableAPI(), "surface")
        materials.append(material)
    corners = np.array([(x, y, z) for x in (-0.4, 0.4) for y in (-0.4, 0.4) for z in (-0.4, 0.4)], dtype="f4")
    faces = Vt.IntArray([0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3])
    for number in range(count):
        mesh = UsdGeom.Mesh.Define(stage, parent.format(row=number // 100, number=number) + f"/Block{number}")
        mesh.CreatePointsAttr(Vt.Vec3fArray.FromNumpy((corners * chance.uniform(0.6, 1, (8, 3))).astype("f4")))
        mesh.CreateFaceVertexCountsAttr(Vt.IntArray([4] * 6))
        mesh.CreateFaceVertexIndicesAttr(faces)
        mesh.CreateSubdivisionSchemeAttr("none")
        mesh.CreateExtentAttr([Gf.Vec3f(-0.4), Gf.Vec3f(0.4)])
        place = UsdGeom.XformCommonAPI(mesh)
        place.SetTranslate(Gf.Vec3d(number % 150, 0, number // 150))
        place.SetRotate(Gf.Vec3f(0, float(chance.uniform(0, 90)), 0))
        primvars = UsdGeom.PrimvarsAPI(mesh)
        if number % 4 == 0:
            colours = Vt.Vec3fArray.FromNumpy(chance.random((6, 3)).astype("f4"))
            primvars.CreatePrimvar("displayColor", Sdf.ValueTypeNames.Color3fArray, "uniform").Set(colours)
        if number % 4 == 1:
            places = Vt.Vec2fArray.FromNumpy(chance.random((24, 2)).astype("f4"))
            primvars.CreatePrimvar("st", Sdf.ValueTypeNames.TexCoord2fArray, "faceVarying").Set(places)
        UsdShade.MaterialBindingAPI.Apply(mesh.GetPrim()).Bind(materials[number % material_count])


def placed_prototypes(stage, count, prototype_count=50):
    """Native instances of a few prototypes, each with a place."""
    unique_blocks(stage, prototype_count, prototype_count, "/Prototypes/P{number}")
    for number in range(count):
        prim = stage.DefinePrim(f"/Placed/Row{number // 100}/P{number}", "Xform")
        prim.GetReferences().AddInternalReference(f"/Prototypes/P{number % prototype_count}")
        prim.SetInstanceable(True)
        UsdGeom.XformCommonAPI(prim).SetTranslate(Gf.Vec3d(number % 150, 2, number // 150))


def processor_seconds(line):
    """What a process takes of the processors, and what it told."""
    process = subprocess.Popen([str(word) for word in line], stderr=subprocess.PIPE, text=True)
    with process.stderr:
        told = process.stderr.read()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    assert process.returncode == 0, told
    return usage.ru_utime + usage.ru_stime, told


OPENING = "import sys; from pxr import Usd, UsdGeom, UsdShade; stage = Usd.Stage.Open(sys.argv[1])"


@pytest.mark.parametrize("what", ["200 materials", "a material each", "instances"])
def test_20_thousand_prims_take_a_second_and_a_half_beyond_opening(command, tmp_path, what):
    """Of the processors, from the opened stage to the first ray: all that a tiny picture takes, less what an empty stage's takes, less what
    opening alone takes more than for an empty stage."""
    stage = lit(tmp_path / "many.usdc")
    if what == "instances":
        placed_prototypes(stage, 20_000)
    else:
        unique_blocks(stage, 20_000, 20_000 if what == "a material each" else 200)
    stage.Save()
    lit(tmp_path / "none.usdc").Save()

    def taken(name):
        stage = tmp_path / name
        rendered, told = processor_seconds([*command, "render", stage, "-o", tmp_path / "a.exr", "--res", 64, 64, "--spp", 1, "--verbose"])
        return rendered - processor_seconds([sys.executable, "-c", OPENING, stage])[0], told

    seconds = []
    for _ in range(3):
        (many, told), (none, _) = taken("many.usdc"), taken("none.usdc")
        assert ("1200 triangles in 20050" if what == "instances" else "240000 triangles in 20000") in told, told
        seconds.append(many - none)
    print(f"{what}: {seconds}")
    # A material is two prims more.
    assert min(seconds) < LONGEST_INGEST_S * (3 if what == "a material each" else 1), seconds


def test_20_thousand_prims_are_ready_to_render_in_a_second_and_a_half(run, tmp_path):
    """From the opened stage to the first ray."""
    stage = lit(tmp_path / "blocks.usdc")
    unique_blocks(stage, 20_000)
    stage.Save()
    seconds = []
    for _ in range(5):
        done = run("render", tmp_path / "blocks.usdc", "-o", tmp_path / "a.exr", "--res", 64, 64, "--spp", 1, "--verbose")
        assert done.returncode == 0 and "240000 triangles in 20000 instances" in done.stderr, done.stderr
        read, compiled = (float(re.search(pattern, done.stderr).group(1)) for pattern in (r"read in ([\d.]+) s", r"compiled in ([\d.]+) s"))
        seconds.append(read + compiled)
    print(f"20,000 prims: {seconds}")
    assert statistics.median(seconds) < LONGEST_INGEST_S, seconds

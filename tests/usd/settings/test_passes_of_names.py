"""Cryptomattes of stages, and passes by expressions and by primvars from the command line."""

import cryptomatte_reader as reader
import numpy as np
import pictures
import pytest
from failures import fails

# Two native instances of a chair, a third prim that shares its mesh's points, and stones on an instancer.
CHAIRS = """
class "_chair"
{
    def Cube "Seat"
    {
        double size = 0.8
    }
}
def Xform "Hall" (kind = "group")
{
    def Xform "Left" (
        instanceable = true
        kind = "component"
        inherits = </_chair>
    )
    {
        double3 xformOp:translate = (-1.5, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Xform "Right" (
        instanceable = true
        kind = "component"
        inherits = </_chair>
    )
    {
        double3 xformOp:translate = (0, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
    def Cube "Alone"
    {
        double size = 0.8
        double3 xformOp:translate = (1.5, 0, 0)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
def PointInstancer "Stones"
{
    rel prototypes = </Stones/Stone>
    int[] protoIndices = [0, 0]
    point3f[] positions = [(-1, 0, 1.2), (1, 0, 1.2)]
    def Sphere "Stone"
    {
        double radius = 0.3
    }
}
def DistantLight "Sun"
{
    float inputs:intensity = 10
}
def Camera "Camera"
{
    float focalLength = 30
    double3 xformOp:translate = (0, 5, 0.5)
    float3 xformOp:rotateXYZ = (-90, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
}
"""
VARIABLE = """
def Scope "Render"
{
    def RenderVar "names"
    {
        uniform string sourceName = "crypto_object"
    }
    def RenderVar "color"
    {
        uniform string sourceName = "Ci"
    }
    def RenderProduct "Picture"
    {
        rel orderedVars = [</Render/color>, </Render/names>]
    }
    def RenderSettings "Settings"
    {
        rel products = </Render/Picture>
    }
}
"""


def covered(layers, wanted):
    """The columns that an identifier covers, from 0 at the left to 1."""
    cover = reader.coverage(layers, wanted)
    assert cover.max() > 0.9
    return (cover.sum(axis=0) * (np.arange(cover.shape[1]) + 0.5) / cover.shape[1]).sum() / cover.sum()


def test_prims_have_their_paths_and_assets(picture, tmp_path):
    stage = tmp_path / "chairs.usda"
    stage.write_text("#usda 1.0\n" + CHAIRS)
    picture(stage, "--aov", "cryptomatte_object,cryptomatte_asset", "--cryptomatte-depth", 4, size=64, spp=16)
    manifests, layers = reader.read(tmp_path / "out.exr")
    objects, assets = manifests["CryptoObject"], manifests["CryptoAsset"]
    assert len(layers["CryptoObject"]) == 2
    assert set(objects) == {"/Hall/Left/Seat", "/Hall/Right/Seat", "/Hall/Alone", "/Stones/Stone"}
    assert set(assets) == {"/Hall/Left", "/Hall/Right", "/Hall/Alone", "/Stones/Stone"}
    places = [covered(layers["CryptoObject"], objects[name]) for name in ("/Hall/Left/Seat", "/Hall/Right/Seat", "/Hall/Alone")]
    assert places[0] < 0.3 < places[1] < 0.7 < places[2]
    for name, asset in (("/Hall/Left/Seat", "/Hall/Left"), ("/Stones/Stone", "/Stones/Stone")):
        mine, whole = reader.coverage(layers["CryptoObject"], objects[name]), reader.coverage(layers["CryptoAsset"], assets[asset])
        assert (mine == whole).all()


def test_a_render_variable_names_the_layers(run, tmp_path):
    stage = tmp_path / "chairs.usda"
    stage.write_text('#usda 1.0\n(\n    renderSettingsPrimPath = "/Render/Settings"\n)\n' + CHAIRS + VARIABLE)
    done = run("render", stage, "-o", tmp_path / "out.exr", "--spp", 4, "--res", 32, 32)
    assert done.returncode == 0, done.stderr
    manifests, layers = reader.read(tmp_path / "out.exr")
    assert set(manifests) == {"names"} and len(layers["names"]) == 3
    assert covered(layers["names"], manifests["names"]["/Hall/Alone"]) > 0.7


def test_parts_join_to_the_same_mattes(run, tmp_path):
    stage = tmp_path / "chairs.usda"
    stage.write_text("#usda 1.0\n" + CHAIRS)
    common = ("render", stage, "--spp", 300, "--res", 40, 40, "--aov", "color,cryptomatte_object")
    assert run(*common, "-o", tmp_path / "whole.exr", "--threads", 1).returncode == 0
    for number in (1, 2):
        done = run(*common, "-o", tmp_path / f"{number}.exr", "--part", f"{number}/2", "--checkpoint", tmp_path / f"{number}.part")
        assert done.returncode == 0, done.stderr
    done = run("merge", tmp_path / "1.part", tmp_path / "2.part", "-o", tmp_path / "joined.exr")
    assert done.returncode == 0, done.stderr
    one, other = (reader.read(tmp_path / f"{name}.exr") for name in ("whole", "joined"))
    assert one[0] == other[0]
    assert all(a.tobytes() == b.tobytes() for a, b in zip(one[1]["CryptoObject"], other[1]["CryptoObject"], strict=True))


def test_expressions_and_primvars_from_the_command_line(picture, room):
    image = picture(room, "--aov", "color,lpe:C<RD>.*L,lpe:C<R[GS]>.*L,lpe:C[LOB],Neye,primvars:st,ambient_occlusion,elementId", spp=8)
    parts = sum(image[f"lpe:{path}.G"] for path in ("C<RD>.*L", "C<R[GS]>.*L", "C[LOB]"))
    assert parts == pytest.approx(image["G"], rel=1e-4, abs=1e-4)
    assert {"Neye.B", "primvars:st.R", "ambient_occlusion", "elementId"} <= set(image.channels)


@pytest.mark.parametrize("name", ["lpe:C<RD>", "lpe:C<RD'skin'>L", "cryptomatte_thing"])
def test_unknown_passes_are_refused(run, room, tmp_path, name):
    assert "aov" in fails(run, "render", room, "-o", tmp_path / "out.exr", "--aov", name)

"""`gonio map`: textures, layers and views of a stage's light."""

import json
import math

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# A floor of 4 m by 4 m in four faces, in centimetres, 2 m under a sphere of 1 cm: I = π r² L.
STAGE = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "Room"
{
    def Mesh "Floor" {
        int[] faceVertexCounts = [4, 4, 4, 4]
        int[] faceVertexIndices = [0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7]
        point3f[] points = [
            (-200, -200, 0), (0, -200, 0), (200, -200, 0), (-200, 0, 0), (0, 0, 0), (200, 0, 0), (-200, 200, 0), (0, 200, 0), (200, 200, 0)
        ]
        texCoord2f[] primvars:st = [
            (0, 0), (0.5, 0), (1, 0), (0, 0.5), (0.5, 0.5), (1, 0.5), (0, 1), (0.5, 1), (1, 1)
        ] (
            interpolation = "vertex"
        )
        uniform token subdivisionScheme = "none"
    }
    def Cube "Block" {
        double size = 20
        double3 xformOp:translate = (150, 150, 10)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }
}
def SphereLight "Lamp" {
    float inputs:radius = 1
    float inputs:intensity = 1000000
    double3 xformOp:translate = (0, 0, 200)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
INTENSITY = math.pi * 0.01**2 * 1e6


@pytest.fixture
def stage(tmp_path):
    path = tmp_path / "stage.usda"
    path.write_text(STAGE)
    return path


def under_lamp(x, y):
    return INTENSITY * 2 / (x * x + y * y + 4) ** 1.5


def test_a_layer_of_primvars(run, stage, tmp_path):
    from pxr import Usd, UsdGeom

    layer, view = tmp_path / "lux.usda", tmp_path / "view.png"
    told = run("map", stage, "--texel", "0.1", "--error", "4%", "--paths", 1 << 20, "--divided", "-o", layer, "-o", view, "-w", 64)
    assert "1 of 2 surfaces" in told.stderr and "/Room/Floor front" in told.stdout
    assert view.read_bytes()[:4] == b"\x89PNG"
    over = Usd.Stage.CreateInMemory()
    over.GetRootLayer().subLayerPaths = [str(layer), str(stage)]
    primvar = UsdGeom.PrimvarsAPI(over.GetPrimAtPath("/Room/Floor")).GetPrimvar("gonio:illuminance")
    assert primvar.GetInterpolation() == "faceVarying"
    values = np.array(primvar.Get())
    assert values.shape == (16,)
    # The corner in the middle, from all four faces.
    assert values[[2, 7, 9, 12]] == pytest.approx([under_lamp(0, 0)] * 4, rel=0.08)
    # Of the part in the corner, which is as large as its error asks for.
    assert under_lamp(2, 2) < values[0] < under_lamp(1.5, 1.5)
    divided = UsdGeom.Mesh(over.GetPrimAtPath("/IlluminationMaps/_0_Floor_front"))
    corners = np.array(divided.GetPointsAttr().Get()).reshape(-1, 3, 3) / 100
    areas = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]), axis=1) / 2
    lux = np.array(UsdGeom.PrimvarsAPI(divided).GetPrimvar("gonio:illuminance").Get())
    assert areas.sum() == pytest.approx(16, rel=1e-5) and len(lux) == len(areas) > 64
    side = (np.arange(400) + 0.5) / 100 - 2
    assert (lux * areas).sum() == pytest.approx(16 * under_lamp(side[:, None], side).mean(), rel=0.02)


def test_a_width_that_is_asked_for_is_met_or_told(run, stage):
    arguments = ("--prim", "/Room/Floor", "--texel", "0.1", "--paths", "64k")
    said = run("map", stage, *arguments, "--error", "2%").stderr
    assert "% of it has parts wider than the 0.1 m asked for" in said and "more than 2 %" in said
    # Nothing is joined, or nothing is asked for.
    assert "wider than" not in run("map", stage, *arguments, "--error", "0%").stderr
    assert "wider than" not in run("map", stage, "--prim", "/Room/Floor", "--paths", "64k", "--error", "2%").stderr


def test_textures_and_figures(run, stage, tmp_path):
    texture, layer = tmp_path / "floor.exr", tmp_path / "floor.usda"
    arguments = ["--prim", "/Room/Floor", "--uv", "st", "--resolution", 8, 8, "--error", "0%", "--paths", 1 << 20, "--json", "--quiet"]
    told = json.loads(run("map", stage, *arguments, "-o", texture, "-o", layer).stdout)
    (floor,) = told["surfaces"]
    assert (floor["name"], floor["side"], floor["parts"], told["paths"]) == ("/Room/Floor", "front", 64, 1 << 20)
    assert floor["area_m2"] == pytest.approx(16) and told["emitted_lm"] == pytest.approx(4 * math.pi * INTENSITY, rel=2e-3)
    side = (np.arange(400) + 0.5) / 100 - 2
    mean = under_lamp(side[:, None], side).mean()
    assert floor["mean_lx"] == pytest.approx(mean, rel=0.01) and floor["direct_lm"] == pytest.approx(floor["flux_lm"], rel=0.01)
    assert f"@./{texture.name}@" in layer.read_text()


def test_what_cannot_be_written(run, stage, tmp_path):
    for arguments, message in [
        (["-o", tmp_path / "map.exr"], "--uv"),
        (["-o", tmp_path / "map.tif"], "exr"),
        (["--prim", "/Elsewhere"], "/Elsewhere"),
        (["--uv", "map9"], "map9"),
        (["--error", "lots"], "error"),
        (["--quantity", "heat"], "heat"),
    ]:
        assert message in run("map", stage, "--paths", 4096, *arguments).stderr


def test_figures_of_colour(run, stage, tmp_path):
    lit = STAGE.replace('inputs:radius = 1\n', 'inputs:radius = 1\n    string gonio:spectrum = "LED-B3"\n')
    stage.write_text(lit)
    lamp = gonio.illuminant("LED-B3")
    expected = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    texture = tmp_path / "floor.exr"
    options = ("--prim", "/Room/Floor", "--uv", "st", "--resolution", 4, 4, "--error", "0%", "--paths", 1 << 18, "--max-bounces", 0)
    told = json.loads(run("map", stage, *options, "--figures", "-o", texture, "--json").stdout)
    (front,) = (side for side in told["surfaces"] if side["side"] == "front")
    assert front["colour"]["cct"] == pytest.approx(expected["cct"], abs=0.6)
    openexr = pytest.importorskip("OpenEXR")

    channels = openexr.File(str(texture), separate_channels=True).channels()
    names = {"CCT": ("cct", 0.6), "Duv": ("duv", 3e-5), "Ra": ("ra", 0.05), "Rf": ("rf", 0.05), "Rg": ("rg", 0.05)}
    for name, (figure, off) in names.items():
        assert np.allclose(channels[name].pixels, expected[figure], atol=off), name
        assert channels[f"{name}.StandardError"].pixels.max() < off
    edi, lux = channels["MelanopicEDI"].pixels, channels["Illuminance"].pixels
    assert np.allclose(edi / lux, expected["melanopic_der"], atol=0.002)
    text = run("map", stage, *options).stdout
    assert "CCT" not in text
    picture = tmp_path / "ra.png"
    done = run("map", stage, *options, "--quantity", "ra", "-o", picture, "-w", 32)
    assert picture.read_bytes().startswith(b"\x89PNG") and "Ra 84." in done.stdout
    stage.write_text(STAGE)
    done = run("map", stage, *options, "--figures", check=False)
    assert done.returncode == 1 and "/Lamp" in done.stderr and "spectrum" in done.stderr
    done = run("map", stage, *options, "--quantity", "colour", check=False)
    assert done.returncode == 1 and "melanopic-edi" in done.stderr

"""Models drawn as cards, boxes or axes in place of their geometry."""

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")

MODEL = """
def Xform "Model" (kind = "KIND")
{
    uniform token model:drawMode = "MODE"
    EXTRA
    double3 xformOp:translate = (5, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
    def Sphere "Ball"
    {
        double radius = 1
        double3 xformOp:scale = (1, 2, 3)
        uniform token[] xformOpOrder = ["xformOp:scale"]
    }
}
"""


def load(tmp_path, mode, kind="component", extra=""):
    text = MODEL.replace("KIND", kind).replace("MODE", mode).replace("EXTRA", extra)
    return gonio.load_usd(str(pictures.stage(tmp_path / "stage.usda", text)), camera_light=False).to_dict()


def points(scene):
    return np.array(scene["meshes"][scene["instances"][0]["mesh"]]["points"]).reshape(-1, 3)


def origins(scene):
    return [instances["origin"]["name"] for instances in scene["instances"]]


@pytest.mark.parametrize(
    ("mode", "kind", "extra", "shown"),
    [
        ("bounds", "component", "", "/Model"),
        ("cards", "component", "", "/Model"),
        ("bounds", "assembly", "", "/Model/Ball"),
        ("bounds", "assembly", "uniform bool model:applyDrawMode = 1", "/Model"),
        ("default", "component", "", "/Model/Ball"),
        ("bounds", "subcomponent", "", "/Model/Ball"),
    ],
)
def test_modes_take_effect_at_models(tmp_path, mode, kind, extra, shown):
    assert origins(load(tmp_path, mode, kind, extra)) == [shown]


def test_a_mode_is_inherited(tmp_path):
    text = 'def Xform "World" (kind = "group")\n{\n    uniform token model:drawMode = "bounds"\n' + MODEL.replace("KIND", "component").replace('    uniform token model:drawMode = "MODE"\n', "").replace("EXTRA", "") + "}\n"
    scene = gonio.load_usd(str(pictures.stage(tmp_path / "stage.usda", text)), camera_light=False).to_dict()
    assert origins(scene) == ["/World/Model"]


def test_bounds_are_the_edges_of_the_box(tmp_path):
    scene = load(tmp_path, "bounds", extra="float3 model:drawModeColor = (1, 0, 0)")
    found = points(scene)
    width = 0.004 * np.linalg.norm([2, 4, 6])
    assert found.max(axis=0) == pytest.approx([1 + width / 2, 2 + width / 2, 3 + width / 2], rel=1e-4)
    assert found.min(axis=0) == pytest.approx([-1 - width / 2, -2 - width / 2, -3 - width / 2], rel=1e-4)
    assert len(scene["meshes"][0]["triangles"]) in (12 * 12, 12 * 12 * 3)
    (closure,) = scene["materials"][scene["instances"][0]["materials"][0]]["closures"]
    assert dict(closure["parameters"])["base_color"]["Constant"][:3] == [1, 0, 0]


def test_the_origin_is_three_axes(tmp_path):
    found = points(load(tmp_path, "origin"))
    assert found.max() == pytest.approx(1, abs=0.01) and found.min() == pytest.approx(0, abs=0.01)


RED, GREEN, BLUE, CLEAR = (255, 0, 0, 255), (0, 255, 0, 255), (0, 0, 255, 255), (255, 255, 255, 0)
CAMERA = """
def Camera "Cam"
{
    token projection = "orthographic"
    float horizontalAperture = 40
    float verticalAperture = 60
    matrix4d xformOp:transform = MATRIX
    uniform token[] xformOpOrder = ["xformOp:transform"]
}
def DomeLight "Sky" {
}
"""
# Looking along -y and along +x, z up.
ALONG = {
    "YPos": "((-1, 0, 0, 0), (0, 0, 1, 0), (0, 1, 0, 0), (5, 20, 0, 1))",
    "XNeg": "((0, -1, 0, 0), (0, 0, 1, 0), (-1, 0, 0, 0), (-20, 0, 0, 1))",
}


@pytest.mark.parametrize("face", ["YPos", "XNeg"])
@pytest.mark.parametrize("geometry", ["cross", "box"])
def test_cards_show_pictures_upright(picture, tmp_path, face, geometry):
    pictures.write_png(tmp_path / "card.png", [[RED, GREEN], [BLUE, CLEAR]])
    extra = f'asset model:cardTexture{face} = @card.png@\n    uniform token model:cardGeometry = "{geometry}"'
    text = MODEL.replace("KIND", "component").replace("MODE", "cards").replace("EXTRA", extra)
    stage = pictures.stage(tmp_path / "stage.usda", text, CAMERA.replace("MATRIX", ALONG[face]))
    seen = picture(stage, "--aov", "color,albedo", "--res", 40, 60, spp=16)
    wide = 10 if face == "YPos" else 20
    at = lambda x, y: [round(float(seen[f"albedo.{c}"][30 + y * 15, 20 + x * wide // 2]), 0) for c in "RGB"]
    assert at(-1, -1) == [1, 0, 0] and at(1, -1) == [0, 1, 0] and at(-1, 1) == [0, 0, 1]
    assert seen["A"][45, 20 + wide // 2] == pytest.approx(0, abs=0.05), "what the picture leaves out is not there"

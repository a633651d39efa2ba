"""Lamps that the camera does not see."""

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# A wall, and a lamp between it and the camera.
STAGE = """
def Mesh "Wall"
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-9, -9, -4), (9, -9, -4), (9, 9, -4), (-9, 9, -4)]
}
def SphereLight "Lamp"
{
    float inputs:intensity = 50
    float inputs:radius = 0.5
    BODY
}
def DomeLight "Sky"
{
    float inputs:intensity = 0.125
}
def Camera "Cam"
{
    token projection = "orthographic"
    float horizontalAperture = 4
    float verticalAperture = 4
    double3 xformOp:translate = (0, 0, 6)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
SETTINGS = 'def RenderSettings "S"\n{\n    bool gonio:hideLights = 1\n    uniform int2 resolution = (8, 8)\n}\n'


def stage(tmp_path, body="", settings=""):
    return pictures.stage(tmp_path / "lamp.usda", STAGE.replace("BODY", body), settings)


def seen(path, **options):
    scene = gonio.load_usd(str(path), **options)
    scene.set(width=8, height=8, samples=16, passes=["color"])
    with gonio.Render(scene) as render:
        assert render.wait()
        return np.asarray(render.film()["color"])[..., :3].mean()


def test_the_switch_hides_lamps_and_keeps_their_light(tmp_path):
    path = stage(tmp_path)
    shown, hidden = seen(path), seen(path, hide_lights=True)
    # What is behind a lamp is seen through it.
    assert shown - hidden == pytest.approx(50, rel=1e-3) and 0.1 < hidden < 0.3, (shown, hidden)
    light = gonio.load_usd(str(path), hide_lights=True).to_dict()["lights"]
    assert [each["visibility"]["camera"] for each in light] == [False, True]


def test_the_settings_hide_lamps(tmp_path):
    assert seen(stage(tmp_path, settings=SETTINGS)) < 0.3
    assert seen(stage(tmp_path, settings=SETTINGS.replace("= 1\n", "= 0\n"))) > 40


@pytest.mark.parametrize(
    "body", ["bool karma:light:renderlightgeo = 0", "float primvars:arnold:camera = 0", "int primvars:ri:attributes:visibility:camera = 0"]
)
def test_other_renderers_attributes_hide_one_lamp(tmp_path, body):
    assert seen(stage(tmp_path, body)) < 0.3
    assert seen(stage(tmp_path, body.replace("= 0", "= 1"))) > 40


def test_the_command_line_hides_lamps_and_info_names_them(run, picture, tmp_path):
    path = stage(tmp_path)
    assert picture(path, name="shown.exr").rgb.mean() > 40
    assert picture(path, "--hide-lights", name="hidden.exr").rgb.mean() < 0.3
    said = run("info", path).stdout
    assert "/Lamp" in said and "--hide-lights" in said, said
    assert "--hide-lights" not in run("info", path, "--hide-lights").stdout

"""Stages read from Python: the options, and what comes with the scene."""

import pathlib

import gonio
import numpy as np
import pytest

pytest.importorskip("pxr")

STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Y"
)
def Sphere "Ball"
{
    double3 xformOp:translate.timeSamples = { 1: (0, 0, 0), 3: (2, 0, 0) }
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Cube "Guide"
{
    uniform token purpose = "guide"
}
def SphereLight "Lamp"
{
    float inputs:intensity.timeSamples = { 1: 10, 3: 30 }
    double3 xformOp:translate = (0, 3, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "Left"
{
    double3 xformOp:translate = (0, 0, 9)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "Right"
{
    float focalLength = 25
    double3 xformOp:translate = (1, 0, 9)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Scope "Render"
{
    def RenderSettings "Small"
    {
        uniform int2 resolution = (48, 24)
        rel camera = </Right>
    }
}
"""


@pytest.fixture
def stage(tmp_path):
    path = tmp_path / "stage.usda"
    path.write_text(STAGE)
    return path


def names(scene):
    said = scene.to_dict()
    return {instances["origin"]["name"] for instances in said["instances"]}


def camera(scene):
    said = scene.to_dict()
    return said["cameras"][said["settings"]["camera"]]["origin"]["name"]


def test_paths_as_text_or_path(stage):
    assert gonio.load_usd(stage).to_dict() == gonio.load_usd(str(stage)).to_dict()
    with pytest.raises(TypeError):
        gonio.load_usd(3)


@pytest.mark.parametrize(("frame", "x", "nits"), [(1, 0, 10), (2.0, 1, 20), (3, 2, 30), (None, 0, 10)])
def test_frames(stage, frame, x, nits):
    said = gonio.load_usd(stage, frame=frame).to_dict()
    ball = next(instances for instances in said["instances"] if instances["origin"]["name"] == "/Ball")
    assert ball["transforms"][0]["columns"][3][0] == pytest.approx(x)
    assert said["lights"][0]["emission"]["radiance"] == pytest.approx([nits] * 3)


def test_purposes(stage):
    assert names(gonio.load_usd(stage)) == {"/Ball"}
    assert names(gonio.load_usd(stage, purposes=["guide"])) == {"/Ball", "/Guide"}
    with pytest.raises(gonio.SettingError, match="final"):
        gonio.load_usd(stage, purposes=["final"])


def test_cameras(stage):
    assert camera(gonio.load_usd(stage, camera="Right")) == "/Right"
    assert camera(gonio.load_usd(stage, camera="/Left")) == "/Left"
    with pytest.raises(gonio.Error, match="/Left.*/Right"):
        gonio.load_usd(stage, camera="Middle")


def test_render_settings(stage):
    scene = gonio.load_usd(stage, render_settings="/Render/Small")
    assert scene.to_dict()["settings"]["resolution"] == [48, 24] and camera(scene) == "/Right"
    with pytest.raises(gonio.Error, match="Nowhere"):
        gonio.load_usd(stage, render_settings="/Nowhere")


@pytest.mark.parametrize(("level", "triangles"), [("low", 12), ("medium", 48), ("high", 192), ("veryhigh", 768)])
def test_complexity(tmp_path, level, triangles):
    path = tmp_path / "cube.usda"
    path.write_text("""#usda 1.0
def Mesh "Cube"
{
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 1, 3, 2, 4, 6, 7, 5, 0, 4, 5, 1, 2, 3, 7, 6, 0, 2, 6, 4, 1, 5, 7, 3]
    point3f[] points = [(-1, -1, -1), (1, -1, -1), (-1, 1, -1), (1, 1, -1), (-1, -1, 1), (1, -1, 1), (-1, 1, 1), (1, 1, 1)]
}
""")
    assert len(gonio.load_usd(path, complexity=level).to_dict()["meshes"][0]["triangles"]) == triangles


def test_unknown_complexity(stage):
    with pytest.raises(gonio.SettingError, match="complexity"):
        gonio.load_usd(stage, complexity="extreme")


def test_the_camera_light_can_be_left_out(tmp_path):
    path = tmp_path / "dark.usda"
    path.write_text('#usda 1.0\ndef Sphere "Ball" {}\n')
    assert len(gonio.load_usd(path).to_dict()["lights"]) == 1
    assert gonio.load_usd(path, camera_light=False).to_dict()["lights"] == []


def test_diagnostics_are_pairs_of_texts(tmp_path):
    path = tmp_path / "odd.usda"
    path.write_text('#usda 1.0\ndef Sphere "Ball"\n{\n    double radius = nan\n}\ndef Mesh "Empty" {}\n')
    said = gonio.load_usd(path).diagnostics
    assert {origin.split(" ")[0] for origin, _ in said} >= {"/Ball", "/Empty"}
    assert all(isinstance(message, str) and message for _, message in said)


def test_python_and_the_command_line_make_the_same_picture(stage, run, tmp_path):
    exr = pytest.importorskip("OpenEXR")
    scene = gonio.load_usd(stage, camera="Right", frame=2)
    scene.set(samples=4)
    said = scene.to_dict()["settings"]
    with gonio.Render(scene) as render:
        assert render.wait()
        film = render.film()
    width, height = film.size
    out = pathlib.Path(tmp_path / "out.exr")
    done = run("render", stage, "-c", "Right", "-f", 2, "-o", out, "--spp", 4, "--res", *said["resolution"], "-q")
    assert done.returncode == 0, done.stderr
    channels = exr.File(str(out), separate_channels=True).channels()
    color = np.asarray(film["color"])
    assert channels["R"].pixels.shape == (height, width)
    for k, name in enumerate("RGB"):
        assert np.array_equal(channels[name].pixels, color[..., k])

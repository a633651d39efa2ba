"""Sun and sky of `gonio:daylight` attributes, and of `gonio render --sun`."""

import math
import pathlib

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HEAD = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "{up}"\n)\n'
PLACE = """
    double gonio:daylight:latitude = 48.21
    double gonio:daylight:longitude = 16.37
    string gonio:daylight:time = "2025-06-21T13:00:00+02:00"
"""
PLANE = """
def Mesh "Plane" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-5, -5, 0), (5, -5, 0), (5, 5, 0), (-5, 5, 0)]
}
def Camera "Above" {
    float horizontalAperture = 20
    float verticalAperture = 20
    double3 xformOp:translate = (0, 0, 8)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
VIENNA = (48.21, 16.37, "2025-06-21T13:00:00+02:00")


def stage(tmp_path: pathlib.Path, body: str = "", *, kind: str = "Xform", up: str = "Z", more: str = "") -> str:
    path = tmp_path / "stage.usda"
    path.write_text(HEAD.format(up=up) + f'def {kind} "Sky"\n{{\n{PLACE}\n{body}\n}}\n' + more)
    return str(path)


def lights(*arguments, **keywords) -> list[dict]:
    return gonio.load_usd(stage(*arguments, **keywords)).to_dict()["lights"]


def luminance(rgb) -> float:
    return float(np.dot(rgb, [0.2126, 0.7152, 0.0722]))


@pytest.mark.parametrize("kind", ["Xform", "Scope", "DomeLight"])
def test_a_prim_becomes_sky_and_sun(tmp_path, kind):
    sky, sun = lights(tmp_path, kind=kind)
    expected = gonio.daylight(*VIENNA)
    assert "Dome" in sky["shape"] and sky["texture"] == 0 and sky["origin"]["name"] == "/Sky"
    assert luminance(sun["emission"]["radiance"]) == pytest.approx(expected.direct_illuminance, rel=1e-5)
    assert sun["transform"]["columns"][2] == pytest.approx(expected.sun_direction)


def test_north_the_axis_and_the_prim_turn_the_sky(tmp_path):
    east, north, up = gonio.daylight(*VIENNA).sun_direction

    def towards(body="", axis="Z"):
        return lights(tmp_path, body, up=axis)[1]["transform"]["columns"][2]

    assert towards(axis="Y") == pytest.approx([east, up, -north])
    assert towards("double gonio:daylight:north = 90") == pytest.approx([north, -east, up])
    turned = 'float xformOp:rotateZ = 90\nuniform token[] xformOpOrder = ["xformOp:rotateZ"]'
    assert towards(turned) == pytest.approx([-north, east, up])


def test_the_hour_may_be_animated(tmp_path):
    path = stage(tmp_path, "double gonio:daylight:hour.timeSamples = { 1: 9, 11: 17 }")
    heights = [gonio.load_usd(path, frame=frame).to_dict()["lights"][1]["transform"]["columns"][2][2] for frame in (1, 6, 11)]
    expected = [
        math.sin(math.radians(gonio.daylight(48.21, 16.37, f"2025-06-21T{hour}:00+02:00").elevation)) for hour in ("09", "13", "17")
    ]
    assert heights == pytest.approx(expected)


def test_a_dome_s_strength_holds_for_both(tmp_path):
    sky, sun = lights(tmp_path, "float inputs:exposure = 1\nfloat inputs:intensity = 0.25", kind="DomeLight")
    assert sky["emission"]["radiance"] == pytest.approx([0.5] * 3)
    assert luminance(sun["emission"]["radiance"]) == pytest.approx(0.5 * gonio.daylight(*VIENNA).direct_illuminance, rel=1e-5)


def test_weather_and_model_are_taken(tmp_path):
    body = """
        double gonio:daylight:directNormalIrradiance = 0
        double gonio:daylight:diffuseHorizontalIrradiance = 100
        token gonio:daylight:sky = "cie5"
        bool gonio:daylight:coloured = false
        int gonio:daylight:rows = 32
    """
    loaded = gonio.load_usd(stage(tmp_path, body)).to_dict()
    assert len(loaded["lights"]) == 1
    assert (loaded["textures"][0]["source"]["Pixels"]["width"], loaded["textures"][0]["source"]["Pixels"]["height"]) == (64, 32)


@pytest.mark.parametrize(
    ("body", "words"),
    [
        ('token gonio:daylight:sky = "blue"', "sky: 'blue'"),
        ("double gonio:daylight:turbidity = 99", "turbidity: 99"),
        ("double gonio:daylight:hour = 25", "hour: 25"),
        ("double gonio:daylight:directNormalIrradiance = 500", "diffuse_horizontal: NaN"),
        ("int gonio:daylight:rows = -4", "rows: 0"),
    ],
)
def test_what_is_wrong_is_told_with_the_prim(tmp_path, body, words):
    scene = gonio.load_usd(stage(tmp_path, body), camera_light=False)
    assert not scene.to_dict()["lights"]
    assert any(origin == "/Sky" and words in message for origin, message in scene.diagnostics), scene.diagnostics


def test_a_place_without_latitude_is_told(tmp_path):
    path = tmp_path / "stage.usda"
    path.write_text(HEAD.format(up="Z") + 'def Xform "Sky"\n{\n    double gonio:daylight:longitude = 16\n}\n')
    scene = gonio.load_usd(str(path), camera_light=False)
    assert any("latitude: NaN" in message for _, message in scene.diagnostics), scene.diagnostics


@pytest.fixture
def plane(run, tmp_path):
    """Renders the plane with more arguments; gives the finished process and the mean illuminance in lx."""

    def render(*arguments):
        stage, out = tmp_path / "plane.usda", tmp_path / "out.exr"
        stage.write_text(HEAD.format(up="Z") + PLANE)
        done = run("render", stage, "-o", out, "--res", 16, 16, "--spp", 64, "--aov", "illuminance", "--max-bounces", 0, *arguments)
        return done, float(pictures.read(out)["Illuminance"].mean()) if done.returncode == 0 else None

    return render


SUN = "48.21,16.37,2025-06-21T13:00+02:00"


def test_the_command_adds_sun_and_sky(plane):
    done, found = plane("--sun", SUN, "--sky", "clear", "--turbidity", 4)
    expected = gonio.daylight(*VIENNA, sky="clear", turbidity=4.0)
    assert found == pytest.approx(expected.global_illuminance, rel=0.01)
    assert f"sun {expected.elevation:.2f}° high" in done.stderr and f"{expected.direct_illuminance:.0f} lx" in done.stderr


def test_the_command_takes_weather(plane, tmp_path):
    weather = tmp_path / "here.wea"
    head = "place Here\nlatitude 48\nlongitude -16\ntime_zone -15\nsite_elevation 0\nweather_data_file_units 1\n"
    weather.write_text(head + "6 21 11.5 0 300\n6 21 12.5 500 200\n")
    # 13:00 in summer is 12:00 on the file's clock: the first of the two nearest records.
    _, found = plane("--sun", SUN, "--weather", weather)
    assert found == pytest.approx(gonio.daylight(*VIENNA, direct_normal=0.0, diffuse_horizontal=300.0).global_illuminance, rel=0.01)


def test_help_tells_of_daylight(run):
    text = run("render", "--help").stdout
    for option in ("--sun", "--sky", "--turbidity", "--irradiance", "--weather", "--north", "--ground", "--elevation", "--white-daylight"):
        assert option in text
    assert "Daylight:" in text


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--sun", "48,16"], "latitude, longitude and time"),
        (["--sun", "48,x,2025-06-21T13:00Z"], "expected a number"),
        (["--sun", "99,16,2025-06-21T13:00Z"], "latitude: 99"),
        (["--sun", "48,16,2025-06-21T13:00"], "no offset"),
        (["--sun", SUN, "--sky", "blue"], "sky: 'blue'"),
        (["--sun", SUN, "--irradiance", "500"], "separated by a comma"),
        (["--sun", SUN, "--weather", "missing.epw"], "missing.epw"),
    ],
)
def test_the_command_says_what_is_wrong(plane, arguments, words):
    done, _ = plane(*arguments)
    assert done.returncode == 1 and words in done.stderr

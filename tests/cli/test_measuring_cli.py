"""`gonio measure`, `gonio falsecolor` and `gonio glare`, and `gonio:grid` and `gonio:meter` attributes, against closed forms."""

import csv
import json
import math

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# A floor of 4 m by 4 m in centimetres, 2 m under a sphere of 1 cm: I = π r² L.
STAGE = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "{up}"
)
def Mesh "Floor" {{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = {points}
    {floor}
}}
def SphereLight "Lamp" {{
    float inputs:radius = 1
    float inputs:intensity = 1000000
    double3 xformOp:translate = {lamp}
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
{more}
"""
INTENSITY = math.pi * 0.01**2 * 1e6
FLOORS = {
    "Z": "[(-200, -200, 0), (200, -200, 0), (200, 200, 0), (-200, 200, 0)]",
    "Y": "[(-200, 0, 200), (200, 0, 200), (200, 0, -200), (-200, 0, -200)]",
}
LAMPS = {"Z": "(0, 0, 200)", "Y": "(0, 200, 0)"}


@pytest.fixture
def stage(tmp_path):
    def write(floor="", more="", up="Z"):
        path = tmp_path / f"stage_{up}.usda"
        path.write_text(STAGE.format(up=up, points=FLOORS[up], lamp=LAMPS[up], floor=floor, more=more))
        return path

    return write


def measured(run, path, *arguments):
    return json.loads(run("measure", path, "--json", "--quiet", *arguments).stdout)


def under_lamp(x, y, height=2.0):
    """E = I h / d³."""
    return INTENSITY * height / (x * x + y * y + height * height) ** 1.5


@pytest.mark.parametrize("purpose", ["guide", "proxy"])
def test_what_is_not_shown_is_measured_on(run, stage, purpose):
    path = stage(f'uniform token purpose = "{purpose}"\n    double gonio:grid:spacing = 200')
    (grid,) = measured(run, path, "--spp", "256")["grids"]
    assert grid["average"]["value"] == pytest.approx(under_lamp(1, 1), rel=0.01)


def test_a_grid_on_a_prim_of_the_command_line(run, stage, tmp_path):
    table, picture = tmp_path / "plane.csv", tmp_path / "plane.png"
    arguments = ("--grid", "/Floor", "--spacing", 0.5, "--margin", 0.5, "--height", 1.0, "--integrator", "direct", "--spp", 256)
    found = measured(run, stage(), *arguments, "--csv", table, "-o", picture)["grids"][0]
    assert (found["name"], found["columns"], found["rows"], found["points"], found["unit"]) == ("/Floor", 6, 6, 36, "lx")
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert len(rows) == 36
    for row in rows:
        expected = under_lamp(float(row["x_m"]), float(row["y_m"]), height=1.0)
        assert float(row["z_m"]) == pytest.approx(1.0)
        assert float(row["value"]) == pytest.approx(expected, rel=1e-3)
    values = [float(row["value"]) for row in rows]
    assert found["average"]["value"] == pytest.approx(np.mean(values))
    assert found["uniformity_u0"] == pytest.approx(min(values) / np.mean(values))
    assert found["diversity_ud"] == pytest.approx(min(values) / max(values))
    assert picture.read_bytes().startswith(b"\x89PNG")


def test_a_grid_keeps_what_its_prim_says(run, stage):
    own = 'double gonio:grid:spacing = 100\n    double gonio:grid:margin = 50\n    token gonio:grid:quantity = "cylindrical"'
    quick = ("--grid", "/Floor", "--integrator", "direct", "--spp", 16)
    points = lambda floor, *arguments: (
        lambda grid: (grid["quantity"], grid["columns"], grid["rows"])
    )(measured(run, stage(floor), *quick, *arguments)["grids"][0])
    assert points(own) == ("cylindrical", 3, 3)
    assert points(own, "--spacing", 0.5) == ("cylindrical", 6, 6)
    assert points(own, "--margin", 0, "--quantity", "illuminance") == ("illuminance", 4, 4)
    # A prim that says nothing of a quantity is a grid by the option alone.
    assert points("double gonio:grid:spacing = 200") == ("illuminance", 2, 2)
    assert points("", "--spacing", 1) == ("illuminance", 4, 4)


@pytest.mark.parametrize("spacing", ["nan", "inf"])
def test_attributes_that_are_no_numbers_are_told(run, stage, spacing):
    path = stage(f"double gonio:grid:spacing = {spacing}", 'def Xform "Meter" {\n    vector3d gonio:meter:normal = (nan, 0, 1)\n}')
    done = run("measure", path, "--integrator", "direct", "--spp", 16)
    assert done.returncode == 0 and "gonio:grid:spacing is" in done.stderr and "gonio:meter:normal is" in done.stderr


@pytest.mark.parametrize("arguments", [("--spp", "4k"), ("--spp", "4e3"), ("-p", "4000"), ("--max-bounces", "1k", "--spp", "0.004M")])
def test_counts_are_written_in_the_same_ways(run, stage, arguments):
    assert measured(run, stage(), "--at", "0,0,0", "--integrator", "direct", *arguments)["meters"]


@pytest.mark.parametrize("name", ["spacing", "margin", "height", "turbidity", "north", "ground", "elevation"])
@pytest.mark.parametrize("number", ["nan", "inf"])
def test_numbers_that_are_none_are_refused(run, stage, name, number):
    ended = run("measure", stage(), "--grid", "/Floor", f"--{name}", number, check=False)
    assert ended.returncode == 2 and f"'--{name} <" in ended.stderr and f"'{number}' was found" in ended.stderr


@pytest.mark.parametrize("count", ["2T", "1.5", "4M", "nan"])
def test_counts_that_are_none_are_refused(run, stage, count):
    ended = run("measure", stage(), "--grid", "/Floor", "--spp", count, check=False)
    assert ended.returncode == 2 and "'--spp <COUNT>'" in ended.stderr


@pytest.mark.parametrize("up", ["Y", "Z"])
def test_attributes_of_surfaces_and_rectangles(run, stage, up):
    plane = """
def Xform "Plane" {
    double2 gonio:grid:size = (100, 200)
    double gonio:grid:spacing = 25
    token gonio:grid:quantity = "cylindrical"
    double3 xformOp:translate = %s
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Xform "Meter" {
    token gonio:meter:quantity = "illuminance"
}
"""
    more = plane % ("(0, 0, 50)" if up == "Z" else "(0, 50, 0)")
    found = measured(run, stage("double gonio:grid:spacing = 100", more, up), "--integrator", "direct", "--spp", 4096)
    floor, plane = found["grids"]
    assert (floor["name"], floor["quantity"], floor["points"]) == ("/Floor", "illuminance", 16)
    corner = under_lamp(1.5, 1.5)
    assert floor["min"]["value"] == pytest.approx(corner, rel=2e-3)
    assert (plane["quantity"], plane["columns"], plane["rows"]) == ("cylindrical", 4, 8)
    # E_z = I sin θ / π d²: the farthest cells lie 0.375 m and 0.875 m from the lamp's foot.
    across, height = math.hypot(0.375, 0.875), 1.5
    expected = INTENSITY * across / (math.pi * math.hypot(across, height) ** 3)
    assert max(plane["values"]) == pytest.approx(expected, rel=0.02)
    assert found["meters"][0]["name"] == "/Meter"
    assert found["meters"][0]["value"] == pytest.approx(under_lamp(0, 0), rel=1e-3)


def test_daylight_factors_leave_lamp_and_sun_out(run, stage):
    day = ("--sun", "48.21,16.37,2025-06-21T13:00+02:00", "--at", "0,0,1", "--quantity", "daylight-factor")
    found = measured(run, stage(), *day)["meters"][0]
    assert (found["unit"], found["value"]) == ("%", pytest.approx(100, abs=0.5))


def test_what_cannot_be_measured_is_one_line(run, stage):
    for arguments, words in (
        ((), "--grid"),
        (("--grid", "/Nothing"), "/Nothing"),
        (("--at", "1,2"), "three numbers"),
        (("--at", "1,2,3,foo"), "'foo'"),
        (("--at", "1,,2,3"), "expected a number"),
        (("--at", "1,2,nan,3"), "'nan'"),
        (("--at", "0,0,1", "--quantity", "loudness"), "semicylindrical"),
        (("--at", "0,0,1", "--quantity", "daylight-factor"), "dome"),
        (("--at", "0,0,1", "--facing", "0,0,0", "--quantity", "luminance"), "direction"),
        (("--at", "0,0,1", "--facing", "0,0,1", "--quantity", "ugr"), "line of sight"),
        (("--grid", "/Floor", "--spacing", "0.001"), "wider spacing"),
        (("--at", "0,0,1", "-o", "x.jpg"), "png"),
    ):
        ended = run("measure", stage(), "--quiet", *arguments, check=False)
        assert ended.returncode == 1 and words in ended.stderr and len(ended.stderr.splitlines()) == 1, (arguments, ended.stderr)


VIEW = """
def Camera "Eye" {
    float horizontalAperture = 20
    float verticalAperture = 20
    float focalLength = 10
    double3 xformOp:translate = (0, 0, 100)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def test_false_colour_of_a_picture(run, stage, tmp_path):
    image = tmp_path / "a.exr"
    run("render", stage(more=VIEW), "-o", image, "--res", 64, 48, "--spp", 4, "--aov", "color,luminance,illuminance,normal", "--quiet")
    for number, arguments in enumerate(
        (("--quantity", "illuminance", "--max", 100, "--steps", 5, "--contours"), ("--log", 3), ("--lines",), ("--no-legend",))
    ):
        picture = tmp_path / f"{number}.png"
        run("falsecolor", image, "-o", picture, *arguments)
        assert picture.read_bytes().startswith(b"\x89PNG")
    ended = run("falsecolor", image, "-o", tmp_path / "x.png", "--quantity", "depth", check=False)
    assert ended.returncode == 1 and "--aov depth" in ended.stderr
    ended = run("falsecolor", image, "-o", tmp_path / "x.png", "--quantity", "normal", check=False)
    assert ended.returncode == 1 and "normal.X, normal.Y, normal.Z" in ended.stderr


def test_colour_tells_luminances_where_no_pass_does(run, stage, tmp_path):
    found = {}
    for image, passes in ((tmp_path / "both.exr", "color,luminance"), (tmp_path / "colour.exr", "color")):
        run("render", stage(more=VIEW), "-o", image, "--res", 64, 48, "--spp", 4, "--aov", passes, "--exposure", 1.5, "--quiet")
        run("falsecolor", image, "-o", image.with_suffix(".png"), "--max", 100, "--no-legend")
        found[passes] = json.loads(run("glare", image, "--json").stdout)["mean_luminance_cd_m2"]
    # Colours are half floats.
    assert found["color"] == pytest.approx(found["color,luminance"], rel=1e-3) and found["color"] > 1
    openexr = pytest.importorskip("OpenEXR")
    foreign = tmp_path / "foreign.exr"
    pixels = {name: np.ones((4, 4), "f4") for name in "RGB"}
    with openexr.File({"compression": openexr.ZIP_COMPRESSION, "type": openexr.scanlineimage}, pixels) as out:
        out.write(str(foreign))
    # What 1 amounts to is not guessed.
    assert "no channel 'luminance'" in run("falsecolor", foreign, "-o", tmp_path / "f.png", check=False).stderr


def test_glare_of_a_disk(run, tmp_path):
    """A disk of 5° half angle straight ahead: ω = 2π (1 − cos 5°), position index 1."""
    openexr = pytest.importorskip("OpenEXR")
    side, inside, around = 600, 10_000.0, 40.0
    y, x = np.mgrid[0:side, 0:side]
    angle = np.hypot((x + 0.5) / side * 2 - 1, (y + 0.5) / side * 2 - 1) * 90
    luminance = np.where(angle < 5, inside, np.where(angle <= 90, around, 0)).astype("f4")
    path = tmp_path / "disk.exr"
    with openexr.File({"compression": openexr.ZIP_COMPRESSION, "type": openexr.scanlineimage}, {"Luminance": luminance}) as out:
        out.write(str(path))
    # Nothing is guessed: the file does not say how it was taken.
    unknown = run("glare", path, check=False)
    assert unknown.returncode == 1 and "does not say how it was taken" in unknown.stderr and "--projection" in unknown.stderr
    found = json.loads(run("glare", path, "--projection", "equidistant", "--json", "-o", tmp_path / "sources.png").stdout)
    half = math.radians(5)
    solid_angle = 2 * math.pi * (1 - math.cos(half))
    of_disk = math.pi * math.sin(half) ** 2
    background = around * (1 - of_disk / math.pi)
    eye = of_disk * inside + math.pi * background
    ugr = 8 * math.log10(0.25 / background * inside**2 * solid_angle)
    dgp = 5.87e-5 * eye + 0.0918 * math.log10(1 + inside**2 * solid_angle / eye**1.87) + 0.16
    assert found["ugr"] == pytest.approx(ugr, abs=0.05)
    assert found["dgp"] == pytest.approx(dgp, abs=1e-3)
    assert found["eye_illuminance_lx"] == pytest.approx(eye, rel=3e-3)
    assert len(found["sources"]) == 1
    from_python = gonio.glare(luminance, projection="equidistant")
    assert from_python.ugr == pytest.approx(found["ugr"]) and from_python.dgp == pytest.approx(found["dgp"])
    assert run("glare", path, "--fov", 120, check=False).returncode == 2
    assert run("glare", path, "--projection", "perspective", check=False).returncode == 1
    narrow = json.loads(run("glare", path, "--projection", "equidistant", "--fov", 120, "--json").stdout)
    assert narrow["dgp"] is None and narrow["eye_illuminance_lx"] is None
    # sin² 60° of what lights the eye.
    assert narrow["share_seen"] == pytest.approx(0.75, abs=2e-3)
    said = run("glare", path, "--projection", "equidistant", "--fov", 120).stdout
    assert "of the 75 % of what lights the eye" in said and "DGP: not known" in said
    assert json.loads(run("glare", path, "--projection", "equidistant", "--fov", 120, "--illuminance", 500, "--json").stdout)["dgp"] > 0.16


def test_observers_rate_luminaires(run, stage):
    """UGR of a sphere of 1 cm by hand: below 0.005 m² it counts as that many; before a sky of 20 cd/m² alone, since the floor is black."""
    black = "color3f[] primvars:displayColor = [(0, 0, 0)]"
    dome = 'def DomeLight "Sky" {\n    float inputs:intensity = 20\n}'
    arguments = ("--at", "0,-2,2", "--facing", "0,1,0", "--quantity", "ugr")
    found = measured(run, stage(black, dome), *arguments)["meters"][0]
    # Straight ahead the position index is 1; what the floor takes of the sky the illuminance at the eye tells.
    eye = measured(run, stage(black, dome), "--at", "0,-2,2", "--normal", "0,1,0")["meters"][0]["value"]
    background = (eye - INTENSITY / 4) / math.pi
    expected = 8 * math.log10(0.25 / background * 200 * INTENSITY**2 / 4)
    assert (found["quantity"], found["unit"]) == ("ugr", "")
    assert found["value"] == pytest.approx(expected, abs=0.05)


EYE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Camera "Eye" {
    double gonio:fisheye = 180
    float2 clippingRange = (0.01, 100)
    double3 xformOp:rotateXYZ = (90, 0, 0)
    uniform token[] xformOpOrder = ["xformOp:rotateXYZ"]
}
def SphereLight "Lamp" {
    float inputs:radius = 0.1
    float inputs:intensity = 5000
    double3 xformOp:translate = (0, 1, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DomeLight "Surroundings" {
    float inputs:intensity = 30
}
"""


def test_glare_of_a_stage(run, tmp_path):
    """A sphere of 0.1 m straight ahead at 1 m: sin of the half angle 0.1."""
    stage, image = tmp_path / "eye.usda", tmp_path / "eye.exr"
    stage.write_text(EYE)
    arguments = ("--res", 400, 400, "--spp", 16, "--filter", "box", "--filter-width", 1, "--aov", "luminance")
    assert run("render", stage, "-o", image, *arguments, "--quiet").returncode == 0
    # The file says that it is a fisheye of 180°.
    found = json.loads(run("glare", image, "--json").stdout)
    half = math.asin(0.1)
    of_disk = math.pi * math.sin(half) ** 2
    background = 30 * (1 - of_disk / math.pi)
    ugr = 8 * math.log10(0.25 / background * 5000**2 * 2 * math.pi * (1 - math.cos(half)))
    # The rim's pixels are darker than the disk and counted with it: a pixel of 26 across is 0.3 in 8 log10.
    assert found["ugr"] == pytest.approx(ugr, abs=0.3)
    assert found["eye_illuminance_lx"] == pytest.approx(of_disk * 5000 + math.pi * background, rel=0.01)


def test_glare_of_perspectives_and_of_parts_of_pictures(run, tmp_path):
    """A sphere of 0.1 m at 1 m, 20° above the line of sight: a perspective and a fisheye show the same source, and their files say what they are."""
    sources = {}
    stage = EYE.replace("(0, 1, 0)", f"(0, {math.cos(math.radians(20))}, {math.sin(math.radians(20))})")
    for name, lens, arguments in (
        ("round", "double gonio:fisheye = 180", ("--res", 600, 600)),
        ("flat", "float focalLength = 10\n float horizontalAperture = 20\n float verticalAperture = 11.25", ("--res", 640, 360)),
    ):
        (tmp_path / "eye.usda").write_text(stage.replace("double gonio:fisheye = 180", lens))
        image = tmp_path / f"{name}.exr"
        done = run("render", tmp_path / "eye.usda", "-o", image, *arguments, "--spp", 4, "--filter", "box", "--filter-width", 1, "--aov", "luminance", "--quiet")
        assert done.returncode == 0, done.stderr
        sources[name] = json.loads(run("glare", image, "--json").stdout)
    flat, whole = sources["flat"], sources["round"]
    assert flat["dgp"] is None and whole["dgp"] == pytest.approx(0.2, abs=0.1)
    for key in ("solid_angle_sr", "position_index", "luminance_cd_m2"):
        assert flat["sources"][0][key] == pytest.approx(whole["sources"][0][key], rel=0.03), key
    assert flat["sources"][0]["direction_deg"] == pytest.approx([0, 20], abs=0.2)
    assert flat["ugr"] == pytest.approx(whole["ugr"], abs=0.3)
    # 45° to each side and 9/16 of that up, and their projected solid angle.
    side = lambda x, y: x / math.hypot(1, x) * math.atan(y / math.hypot(1, x))
    assert flat["share_seen"] == pytest.approx(2 * (side(1, 0.5625) + side(0.5625, 1)) / math.pi, abs=1e-3)

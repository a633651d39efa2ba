"""`gonio sunlight` and `gonio.sunlight`: hours of sun against the sun's way and the shadows of simple walls."""

import json

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# A flat piece of ground, and a wall to the south of the origin: 10 m off, 2 m high, very long.
STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "{up}"
)
def Mesh "Lawn" {{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = {lawn}
}}
{more}
"""
LAWN = "[(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]"
WALL = """def Mesh "Wall" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-5000, -10, -10), (5000, -10, -10), (5000, -10, 2), (-5000, -10, 2)]
}
"""
VIENNA = "48.21,16.37,2026-03-21T12:00+01:00"
# The disc's radius in degrees: who sees a part of it sees the sun.
RADIUS = 0.27


@pytest.fixture
def stage(tmp_path):
    def write(more="", lawn=LAWN, up="Z"):
        path = tmp_path / f"place_{up}.usda"
        path.write_text(STAGE.format(up=up, lawn=lawn, more=more))
        return path

    return write


def found(run, *arguments):
    return json.loads(run("sunlight", *arguments, "--json", "--quiet").stdout)


def test_an_open_place_has_the_whole_day(run, stage):
    """At the equinox 12 hours, and some minutes by refraction and the disc."""
    of_day = found(run, stage(), "--sun", VIENNA, "--at", "0,0,1")
    meter = of_day["meters"][0]
    assert meter["hours"] == pytest.approx(12.15, abs=0.1) and meter["hours"] == pytest.approx(of_day["possible_h"], abs=0.04)
    # A level wants the sun's least height, which the place has.
    assert meter["en17037_level"] is None and len(meter["spans_h"]) == 1
    high = found(run, stage(), "--sun", VIENNA, "--at", "0,0,1", "--least-elevation", 13)["meters"][0]
    assert high["en17037_level"] == "high" and high["hours"] == pytest.approx(9.4, abs=0.1)
    # The middle of the day is when the sun passes the meridian: 12 h + (15° - 16.37°) / 15° h and 7.5 min of the equation of time.
    assert sum(meter["spans_h"][0]) / 2 == pytest.approx(12 + (15 - 16.37) / 15 + 7.4 / 60, abs=0.03)


@pytest.mark.parametrize("step", [25, 59])
def test_steps_that_do_not_divide_the_day(run, stage, step):
    of_day = found(run, stage(), "--sun", VIENNA, "--at", "0,0,1", "--step", step)
    count = round(24 * 60 / step)
    assert of_day["meters"][0]["hours"] == pytest.approx(len(of_day["sun"]) * 24 / count)


def test_a_window_sees_its_side_alone(run, stage):
    """A wall that looks south has sun while the azimuth is within 90° and 270°, one that looks north on summer's mornings and evenings."""
    day = "48.21,16.37,2026-06-21T12:00+02:00"
    for normal, is_before in (("0,-1,0", lambda azimuth: np.cos(np.radians(azimuth)) < 0), ("0,1,0", lambda azimuth: np.cos(np.radians(azimuth)) > 0)):
        of_day = found(run, stage(), "--sun", day, "--at", "0,0,1", f"--normal={normal}")
        sun = np.array(of_day["sun"])
        assert of_day["meters"][0]["hours"] == pytest.approx(is_before(sun[:, 1]).mean() * of_day["possible_h"], abs=0.1)
        assert of_day["meters"][0]["en17037_level"] is None
    assert len(of_day["meters"][0]["spans_h"]) == 2


def behind_a_wall(sun, y, height=2.0):
    """Whether the sun stands above the wall, as seen from the ground `y` metres north of the origin."""
    azimuth, elevation = np.radians(sun[:, 1]), sun[:, 2]
    to_south = -np.cos(azimuth)
    top = np.degrees(np.arctan2(height * np.maximum(to_south, 0), 10.0 + y))
    return (to_south <= 0) | (elevation + RADIUS > top)


@pytest.mark.parametrize(("up", "at"), [("Z", "0,0,0"), ("Y", "0,0,0")])
def test_a_wall_hides_the_low_sun(run, stage, up, at):
    more = WALL
    if up == "Y":
        more = WALL.replace("(-5000, -10, -10), (5000, -10, -10), (5000, -10, 2), (-5000, -10, 2)", "(-5000, -10, 10), (5000, -10, 10), (5000, 2, 10), (-5000, 2, 10)")
    lawn = LAWN if up == "Z" else "[(-2, -1, 2), (2, -1, 2), (2, -1, -2), (-2, -1, -2)]"
    day = "48.21,16.37,2026-12-21T12:00+01:00"
    of_day = found(run, stage(more, lawn, up), "--sun", day, "--at", at)
    expected = behind_a_wall(np.array(of_day["sun"]), 0.0)
    assert of_day["meters"][0]["hours"] == pytest.approx(expected.sum() / 60, abs=4 / 60)
    assert 0 < expected.mean() < 1


def test_north_turns_and_least_elevations_count(run, stage):
    """With north to the scene's left its -X is north, and -Y looks to the west."""
    path = stage()
    of_day = found(run, path, "--sun", VIENNA, "--at", "0,0,1", "--normal=0,-1,0", "--north=-90", "--least-elevation", "13")
    sun = np.array(of_day["sun"])
    assert sun[:, 2].min() > 13
    west = np.sin(np.radians(sun[:, 1])) < 0
    east = ~west
    hours = of_day["meters"][0]["hours"]
    assert min(abs(hours - side.sum() / 60) for side in (west, east)) < 0.1
    turned = found(run, path, "--sun", VIENNA, "--at", "0,0,1", "--normal=0,-1,0", "--north=90", "--least-elevation", "13")["meters"][0]["hours"]
    assert hours + turned == pytest.approx(of_day["possible_h"], abs=0.1)


def test_thin_panes_let_the_sun_through_and_solid_glass_is_told(run, stage):
    pane = """def Mesh "Pane" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-500, -1, -10), (500, -1, -10), (500, -1, 300), (-500, -1, 300)]
    rel material:binding = </Glass>
}
def Material "Glass" {
    token outputs:mtlx:surface.connect = </Glass/Surface.outputs:surface>
    def Shader "Surface" {
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
        float inputs:transmission_weight = 1
        bool inputs:geometry_thin_walled = THIN
        float inputs:specular_roughness = 0
        token outputs:surface
    }
}
"""
    south = ("--sun", VIENNA, "--at", "0,0,1", "--normal=0,-1,0")
    open_air = found(run, stage(), *south)["meters"][0]["hours"]
    assert found(run, stage(pane.replace("THIN", "1")), *south)["meters"][0]["hours"] == pytest.approx(open_air, abs=0.05)
    solid = run("sunlight", stage(pane.replace("THIN", "0")), *south, "--least-elevation", 13)
    assert "thin panes" in solid.stderr and "below the minimum" in solid.stdout


def test_grids_and_their_picture(run, stage, tmp_path):
    picture = tmp_path / "lawn.png"
    path = stage(WALL)
    of_day = found(run, path, "--sun", "48.21,16.37,2026-12-21T12:00+01:00", "--grid", "/Lawn", "--spacing", "2", "-o", picture)
    grid = of_day["grids"][0]
    assert (grid["columns"], grid["rows"]) == (2, 2) and len(grid["hours"]) == 4
    expected = sorted(behind_a_wall(np.array(of_day["sun"]), y).sum() / 60 for y in (-1.0, 1.0))
    assert sorted(set(np.round(grid["hours"], 6))) == pytest.approx(expected, abs=4 / 60)
    assert picture.stat().st_size > 1000
    text = run("sunlight", path, "--sun", VIENNA, "--grid", "/Lawn", "--spacing", "2", "--quiet").stdout
    assert "2026-03-21: the sun is up for" in text and "hours of sun, 2 × 2 points" in text


def test_python_says_the_same(run, stage):
    made = gonio.Scene()
    made.add_instance(made.add_mesh(np.array([[-2, -2, 0], [2, -2, 0], [2, 2, 0]], np.float32), np.array([[0, 1, 2]], np.int32)), [made.add_material()])
    day = gonio.sunlight(made, 48.21, 16.37, "2026-03-21T12:00+01:00", [((0, 0, 1), (0, 0, 1)), ((0, 0, 1), (0, -1, 0))])
    of_day = found(run, stage(), "--sun", VIENNA, "--at", "0,0,1")
    assert day["hours"][0] == of_day["meters"][0]["hours"] and day["possible"] == of_day["possible_h"]
    assert day["spans"][0] == [tuple(span) for span in of_day["meters"][0]["spans_h"]] or day["spans"][0] == of_day["meters"][0]["spans_h"]
    assert len(day["hours"]) == 2 and len(day["sun"]) == len(of_day["sun"])


def test_polar_night_and_southern_places(run, stage):
    night = found(run, stage(), "--sun", "78.2,15.6,2026-12-21T12:00+01:00", "--at", "0,0,1")
    assert night["possible_h"] == 0 and night["meters"][0]["spans_h"] == []
    south = found(run, stage(), "--sun=-33.9,151.2,2026-06-21T12:00+10:00", "--at", "0,0,1", "--normal=0,1,0")
    assert south["meters"][0]["hours"] > 8


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (("--sun", "48,16"), "latitude, longitude and time"),
        (("--sun", "48,16,2026-02-30T12:00Z"), "day"),
        (("--sun", "98,16,2026-02-20T12:00Z"), "latitude"),
        (("--sun", VIENNA, "--step", "0.01"), "expected 0.25 to 60"),
        (("--sun", VIENNA, "--least-elevation", "95"), "less than 90"),
        (("--sun", VIENNA, "--normal", "0,0,0"), "normal"),
    ],
)
def test_bad_input_is_told(run, stage, arguments, what):
    told = run("sunlight", stage(), "--at", "0,0,1", *arguments)
    assert told.returncode != 0 and what in told.stderr


def test_who_asks_for_nothing_is_told(run, stage):
    told = run("sunlight", stage(), "--sun", VIENNA)
    assert told.returncode != 0 and "--at X,Y,Z" in told.stderr

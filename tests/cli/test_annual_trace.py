"""`gonio annual`: coefficients traced in stages, against closed forms and the weather file's own light."""

import json
import math

import almanac
import numpy as np
import pytest
from wea_years import HOUR, write_wea

STAGE = '#usda 1.0\n(\n    upAxis = "{up}"\n    metersPerUnit = 1\n)\n'
MESH = """def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    point3f[] points = {points}
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    rel material:binding = </{material}>
}}
"""
MATTE = """def Material "Matte"
{
    token outputs:surface.connect = </Matte/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0.5, 0.5, 0.5)
        float inputs:roughness = 1
        int inputs:useSpecularWorkflow = 1
        color3f inputs:specularColor = (0, 0, 0)
        token outputs:surface
    }
}
"""
PANE = """def Material "Pane"
{
    token outputs:mtlx:surface.connect = </Pane/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
        float inputs:base_weight = 0
        float inputs:transmission_weight = 1
        color3f inputs:transmission_color = (0.5, 0.5, 0.5)
        float inputs:specular_ior = 1.52
        float inputs:specular_roughness = 0
        bool inputs:geometry_thin_walled = %d
        token outputs:surface
    }
}
"""


def level(name, height, half, material="Matte", up="Z"):
    corners = [(-half, -half), (half, -half), (half, half), (-half, half)]
    points = [(x, y, height) if up == "Z" else (x, height, -y) for x, y in corners]
    return MESH.format(name=name, points=points, material=material)


def wall(name, y, half, height, material="Matte"):
    return MESH.format(name=name, points=[(-half, y, 0), (half, y, 0), (half, y, height), (-half, y, height)], material=material)


@pytest.fixture(scope="module")
def weather(tmp_path_factory):
    """A file in lux: sun and sky from 6 to 18 o'clock, in other steps than the hours' alone."""
    light = (HOUR > 6) & (HOUR < 18)
    steps = np.arange(8760)
    direct, diffuse = np.where(light, steps * 37 % 13 * 6000, 0), np.where(light, 6000 + steps * 53 % 11 * 3500, 0)
    path = tmp_path_factory.mktemp("weather") / "year.wea"
    write_wea(path, direct, diffuse)
    return path, direct.astype(float), diffuse.astype(float)


def sun():
    """Sine of the sun's height."""
    return almanac.directions()[:, 2]


def year(run, tmp_path, weather, stage, *options, grid="/Floor"):
    path = tmp_path / "stage.usda"
    path.write_text(stage)
    out = tmp_path / "out"
    words = ("--weather", weather, "--grid", grid, "--height", 0.1, "--spacing", 0.5, "--json", "-q", "-o", out, *options)
    done = run("annual", path, *words)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)["grids"]
    name = found[0]["name"]
    return found[0], np.load(out / f"{name}_total.npy"), np.load(out / f"{name}_direct.npy")


@pytest.mark.parametrize(("up", "position"), [("Z", "true"), ("Y", "true"), ("Z", "radiance")])
def test_a_level_plane_has_the_weathers_light(run, tmp_path, weather, up, position):
    path, direct, diffuse = weather
    stage = STAGE.format(up=up) + MATTE + level("Floor", 0, 0.5, up=up)
    grid, total, straight = year(run, tmp_path, path, stage, "-m", 4, "-p", 256, "--sun-position", position)
    sine = sun() if position == "true" else almanac.of_radiance()[:, 2]
    high = sine > math.sin(math.radians(1))
    assert straight[:, high] == pytest.approx(np.tile(direct[high] * sine[high], (4, 1)), rel=2e-3, abs=1)
    assert straight[:, sine < -0.01].max() == 0
    expected = np.tile(diffuse + direct * np.maximum(sine, 0), (4, 1))
    # Bright patches by the sun have sixteen shadow rays each.
    assert total[:, high] == pytest.approx(expected[:, high], rel=0.015, abs=1)
    assert total[:, high].mean() == pytest.approx(expected[:, high].mean(), rel=1e-3)
    assert [point["daylight_factor"] for point in grid["points"]] == pytest.approx([100] * 4, abs=0.3)
    heights = [point["position_m"]["ZY".index(up) and 1 or 2] for point in grid["points"]]
    assert heights == pytest.approx([0.1] * 4) and (grid["columns"], grid["rows"]) == (2, 2)
    assert (tmp_path / "out" / "Floor_year.png").stat().st_size > 1000


def test_suns_stand_where_they_stand(run, tmp_path, weather):
    """A wall to the south shades the floor at noon in winter alone; north turned by 180° has it in the north."""
    path, direct, _ = weather
    stage = STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5) + wall("Wall", -1, 50, 1.0)
    _, _, straight = year(run, tmp_path, path, stage, "-p", 64)
    _, _, turned = year(run, tmp_path, path, stage, "-p", 64, "--north", 180)
    sine, noon = sun(), np.abs(HOUR - 12.5) < 0.1
    up = noon & (direct > 0)
    # From the far points the wall's edge, 0.9 m higher and 1.25 m off, stands 35.8° high; from the near ones, 0.75 m off, 50.2°.
    height = np.degrees(np.arcsin(sine))
    assert straight[2:, up & (height < 33)].max() == 0 and straight[2:, up & (height > 38)].min() > 100
    assert straight[:2, up & (height < 48)].max() == 0 and straight[:2, up & (height > 53)].min() > 100
    assert turned[:, up & (height > 5)].min() > 100


def test_panes_let_sun_and_sky_through_once(run, tmp_path, weather):
    path, direct, _ = weather
    bare = STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5)
    _, without, straight_without = year(run, tmp_path, path, bare, "-p", 4096)
    _, total, straight = year(run, tmp_path, path, bare + PANE % 1 + level("Roof", 0.5, 500, "Pane"), "-p", 4096, "--max-bounces", 8)
    high = (sun() > math.sin(math.radians(50))) & (direct > 0)
    ratio = straight[:, high] / straight_without[:, high]
    assert 0.40 < ratio.min() and ratio.max() < 0.5
    # What is behind the pane is that and the sky, dimmed alike: nothing is counted twice.
    assert (total[:, high] / without[:, high]).mean() == pytest.approx(ratio.mean(), rel=0.03)


def test_solid_glass_is_told(run, tmp_path, weather):
    stage = STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5) + PANE % 0 + level("Roof", 0.5, 5, "Pane")
    (tmp_path / "stage.usda").write_text(stage)
    done = run("annual", tmp_path / "stage.usda", "--weather", weather[0], "--grid", "/Floor", "--height", 0.1, "-p", 16)
    words = "clear solid glass is spread over patches"
    assert done.returncode == 0 and words in done.stderr
    # Machines, Python and eyes are told too.
    quiet = run("annual", tmp_path / "stage.usda", "--weather", weather[0], "--grid", "/Floor", "--height", 0.1, "-p", 16, "-q", "--json")
    assert any(words in found["message"] for found in json.loads(quiet.stdout)["diagnostics"])
    import gonio

    scene = gonio.load_usd(tmp_path / "stage.usda")
    scene.add_meter((0.0, 0.0, 0.1))
    (reading,) = gonio.annual(scene, weather[0].read_bytes(), samples=16)
    (eye,) = gonio.annual_glare(scene, weather[0].read_bytes(), [((0, 0, 0.1), (0, 1, 0))], samples=16)
    for told in (reading.diagnostics, eye.diagnostics):
        assert any(words in message for _, message in told)


def test_python_takes_whole_steps_and_no_preview(tmp_path, weather):
    import gonio

    (tmp_path / "stage.usda").write_text(STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5))
    scene, bytes_of = gonio.load_usd(tmp_path / "stage.usda"), weather[0].read_bytes()
    scene.add_meter((0.0, 0.0, 0.1), normal=(0.0, 0.0, -1.0))
    with pytest.raises(gonio.SettingError, match="0.05 was found at step 4, expected 0 or 1"):
        gonio.annual(scene, bytes_of, schedule=[1.0, 0.0, 1.0, 0.05] + [1.0] * 8756)
    scene.set(integrator="direct")
    # What faces the floor alone has light by bounces.
    assert gonio.annual(scene, bytes_of, samples=64)[0].figures["mean_lx"] > 100


HOUSE = """def Xform "House" (
    variants = {
        string blinds = "open"
    }
    prepend variantSets = "blinds"
)
{
    variantSet "blinds" = {
        "open" {
        }
        "closed" {
            %s
        }
    }
}
""" % level("Roof", 0.5, 500)


def test_blinds_and_variants(run, tmp_path, weather):
    path, direct, _ = weather
    stage = STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5)
    _, open_, straight = year(run, tmp_path, path, stage, "-p", 1024)
    _, shared, _ = year(run, tmp_path, path, stage, "-p", 1024, "--blinds", 0.25)
    closed = (straight >= 1000).mean(0) > 0.02
    assert 1000 < closed.sum() < 6000
    assert shared == pytest.approx(np.where(closed, 0.25 * open_, open_), rel=1e-5)
    _, dark, _ = year(run, tmp_path, path, stage + HOUSE, "-p", 1024, "--closed-variant", "/House{blinds=closed}")
    assert dark[:, ~closed] == pytest.approx(open_[:, ~closed], rel=1e-5)
    # The ground shines on the roof's underside.
    assert (dark[:, closed] / open_[:, closed]).max() < 0.25


def test_any_number_of_threads_gives_the_same_bits(run, tmp_path, weather):
    stage = STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5) + wall("Wall", -1, 50, 1.0)
    found = [year(run, tmp_path, weather[0], stage, "-p", 512, "-j", threads) for threads in (1, 3)]
    assert found[0][0] == found[1][0]
    assert np.array_equal(found[0][1], found[1][1]) and np.array_equal(found[0][2], found[1][2])


def test_daylight_factors_are_those_of_measure(run, tmp_path, weather):
    stage = STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5) + wall("Wall", -0.7, 5, 1.0) + wall("Other", 0.8, 5, 2.0)
    grid, _, _ = year(run, tmp_path, weather[0], stage, "-p", 16384, "-m", 4)
    measured = run(
        "measure", tmp_path / "stage.usda", "--grid", "/Floor", "--height", 0.1, "--spacing", 0.5, "--quantity", "daylight-factor", "--json",
        "-q", "--sun", "49.52,8.55,2026-06-21T12:00+01:00", "--sky", "overcast", "--ground", 0.2, "-p", 16384,
    )  # fmt: skip
    expected = json.loads(measured.stdout)["grids"][0]["values"]
    assert [point["daylight_factor"] for point in grid["points"]] == pytest.approx(expected, rel=0.01)


def test_errors_are_true(run, tmp_path, weather):
    """Four seeds differ by what their standard errors say."""
    stage = STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5) + wall("Wall", -0.7, 5, 1.0) + wall("Other", 0.8, 5, 2.0)
    found = [year(run, tmp_path, weather[0], stage, "-p", 256, "-m", 1, "--seed", seed)[0] for seed in range(4)]
    means = np.array([[point["mean_lx"] for point in grid["points"]] for grid in found])
    told = np.array([[point["mean_lx"] for point in grid["standard_errors"]["points"]] for grid in found])
    assert 0.3 < means.std(0, ddof=1).mean() / told.mean() < 2


BAD = [
    ((), "there is no grid and no meter that measures illuminance"),
    (("--grid", "/Nothing"), "/Nothing"),
    (("--grid", "/Floor", "--closed-variant", "blinds"), "'blinds' was found, expected /Prim{set=variant}"),
    (("--grid", "/Floor", "--blinds", "1.5"), "blinds: 1.5 was found, expected 0 to 1"),
    (("--grid", "/Floor", "--schedule", "noon"), "'noon' was found, expected hours such as 8-18, or a file"),
    (("--grid", "/Floor", "--spacing", "0.001", "-m", "6"), "points"),
]


@pytest.mark.parametrize(("words", "expected"), BAD)
def test_bad_input_is_told(run, tmp_path, weather, words, expected):
    (tmp_path / "stage.usda").write_text(STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5))
    done = run("annual", tmp_path / "stage.usda", "--weather", weather[0], *words)
    assert done.returncode == 1 and expected in done.stderr and done.stdout == ""


def test_python_has_the_same_year(tmp_path, run, weather):
    import gonio

    stage = STAGE.format(up="Z") + MATTE + level("Floor", 0, 0.5)
    grid, total, direct = year(run, tmp_path, weather[0], stage, "-p", 256)
    scene = gonio.Scene()
    corners = [(-0.5, -0.5, 0), (0.5, -0.5, 0), (0.5, 0.5, 0), (-0.5, 0.5, 0)]
    matte = scene.add_material(base_color=(0.5, 0.5, 0.5), specular_weight=0)
    floor = scene.add_mesh(np.array(corners, np.float32), np.array([(0, 1, 2), (0, 2, 3)], np.int32))
    scene.add_instance(floor, [matte])
    scene.add_grid(mesh=floor, height=0.1, spacing=0.5, name="Floor")
    (found,) = gonio.annual(scene, weather[0].read_bytes(), samples=256)
    assert np.asarray(found.total) == pytest.approx(total, rel=5e-3, abs=2)
    assert np.asarray(found.direct) == pytest.approx(direct, rel=1e-4, abs=0.1)
    assert found.figures["sda_300_50"] == grid["sda_300_50"] and found.size == (2, 2)
    lamps = {"power_w_m2": 8, "target_lx": 2e4, "control": "dimming", "sensor": "points", "least": 0.25}
    (found,) = gonio.annual(scene, weather[0].read_bytes(), samples=256, lighting=lamps)
    used, values = (HOUR > 8) & (HOUR < 18), np.asarray(found.total)
    hours = np.clip(1 - values[:, used] / 2e4, 0.25, 1).mean(0).sum()
    electric = found.figures["electric"]
    assert electric["full_load_hours"] == pytest.approx(hours, rel=1e-5) and electric["leni_kwh_m2"] == pytest.approx(0.008 * hours, rel=1e-5)
    assert 0 < found.figures["standard_errors"]["electric"]["leni_kwh_m2"] < 0.1 * electric["leni_kwh_m2"]
    with pytest.raises(gonio.SettingError, match="unknown field `watts`"):
        gonio.annual(scene, weather[0].read_bytes(), lighting={"watts": 8})

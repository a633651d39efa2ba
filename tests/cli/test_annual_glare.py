"""`gonio annual-glare`: the glare of even skies and of the sun in closed form, through panes and behind walls, shares of the year, and what is written."""

import json

import almanac
import numpy as np
import pytest
from wea_years import HOUR, write_wea

SQUARE = """def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    point3f[] points = {points}
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    {binding}
}}
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
        float inputs:specular_ior = 1
        float inputs:specular_weight = 0
        float inputs:specular_roughness = 0
        bool inputs:geometry_thin_walled = 1
        token outputs:surface
    }
}
"""
DISC = 2 * np.pi * (1 - np.cos(np.radians(0.533 / 2)))


def stage(tmp_path, more=""):
    """A speck far below, and what else there is."""
    speck = SQUARE.format(name="Speck", points="[(0, 0, -900), (0.1, 0, -900), (0.1, 0.1, -900), (0, 0.1, -900)]", binding="")
    path = tmp_path / "stage.usda"
    path.write_text('#usda 1.0\n(\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n' + speck + more)
    return path


def weather(tmp_path, diffuse=12000.0, direct=0.0):
    """A file in lux, the same from 8 to 16 o'clock of every day, dark otherwise."""
    light = (HOUR > 8) & (HOUR < 16)
    path = tmp_path / "year.wea"
    write_wea(path, np.where(light, direct, 0.0), np.where(light, diffuse, 0.0))
    return path, light


def index(right, up, ahead):
    """Guth's position index above the line of sight, Iwata and Tokura's below it."""
    across = np.hypot(right, up)
    tau, sigma = np.degrees(np.arctan2(np.abs(right), up)), np.degrees(np.arctan2(across, ahead))
    above = (35.2 - 0.31889 * tau - 1.22 * np.exp(-2 * tau / 9)) * 1e-3 * sigma + (21 + 0.26667 * tau - 0.002963 * tau**2) * 1e-5 * sigma**2
    return np.minimum(np.exp(above), 16.0)


def dgp(light, sources):
    plain = np.minimum(5.87e-5 * light + 0.0918 * np.log10(1 + sources / light**1.87) + 0.16, 1.0)
    low = np.exp(0.024 * np.minimum(light, 1000) - 4)
    return np.where(light < 1000, plain * low / (1 + low), plain)


def even_sky(luminance, share=lambda ahead: np.ones_like(ahead)):
    """The sum over sources of half an even sky before the eye, and its light there, by a fine grid of directions; a share of it is seen."""
    azimuth, height = np.meshgrid(np.radians(np.arange(-89.75, 90, 0.5)), np.radians(np.arange(0.25, 90, 0.5)))
    right, up, ahead = np.cos(height) * np.sin(azimuth), np.sin(height), np.cos(height) * np.cos(azimuth)
    solid_angle = np.cos(height) * np.radians(0.5) ** 2
    seen = luminance * share(ahead)
    return np.sum(np.where(seen >= 2000, seen, 0) ** 2 * solid_angle / index(right, up, ahead) ** 2), np.sum(seen * ahead * solid_angle)


def year(run, tmp_path, path, file, *options):
    done = run(
        "annual-glare", path, "--weather", file, "--sky", "cie5", "--eye", "0,0,1.2", "-p", "4096", "-q", "--json", "-o", tmp_path / "out", *options, timeout=120
    )
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout), np.load(tmp_path / "out" / "glare.npy")


def test_an_even_sky(tmp_path, run):
    file, light = weather(tmp_path)
    found, values = year(run, tmp_path, stage(tmp_path), file, "--facing", "0,1,0")
    luminance = 12000 / np.pi
    # Half of the sky, and ground that sends back a fifth.
    sources, light_of_sky = even_sky(luminance)
    assert light_of_sky == pytest.approx(6000, rel=1e-3)
    expected = dgp(0.5 * 12000 + 0.5 * 0.2 * 12000, sources)
    hour = 12 + 24 * 170
    assert values.shape == (1, 8760)
    assert values[0, hour] == pytest.approx(expected, abs=0.003)
    assert not values[0][~light].any()
    (view,) = found["views"]
    # All hours are alike: eight of ten used ones.
    assert view["glare"]["dgp_5_percent"] == pytest.approx(expected, abs=0.004)
    assert view["glare"]["above_045"] == pytest.approx(0.8, abs=1e-9) and view["en17037"] == "below the minimum"
    assert (tmp_path / "out" / "glare_1.png").exists() and (tmp_path / "out" / "glare.csv").read_text().count("\n") == 2


def test_closed_blinds_dim_what_is_seen(tmp_path, run):
    """A share of the light of an even sky: of its luminance, of the light at the eye and of the ground's."""
    file, _ = weather(tmp_path, diffuse=20000.0)
    _, values = year(run, tmp_path, stage(tmp_path), file, "--facing", "0,1,0", "--blinds", "0.5", "--closed-hours", "12-24")
    for hour, share in ((10, 1.0), (13, 0.5)):
        sources, _ = even_sky(20000 / np.pi, lambda ahead, share=share: share * np.ones_like(ahead))
        assert values[0, hour + 24 * 170] == pytest.approx(dgp(share * 0.5 * 20000 * 1.2, sources), abs=0.003)


def test_skies_below_the_threshold_are_no_sources(tmp_path, run):
    file, _ = weather(tmp_path, diffuse=6000.0)
    _, values = year(run, tmp_path, stage(tmp_path), file, "--facing", "0,1,0")
    assert values[0, 12 + 24 * 170] == pytest.approx(dgp(0.5 * 6000 * 1.2, 0.0), abs=0.002)


@pytest.mark.parametrize("position", ["true", "radiance"])
def test_the_sun_stands_at_its_place(tmp_path, run, position):
    file, light = weather(tmp_path, diffuse=6000.0, direct=40000.0)
    _, values = year(run, tmp_path, stage(tmp_path), file, "--facing", "0,-1,0", "-m", "1", "--sun-position", position)
    sun = almanac.directions() if position == "true" else almanac.of_radiance()
    cosine, height = -sun[:, 1], sun[:, 2]
    at_eye = np.maximum(cosine, 0) * 40000
    ground = 0.2 * (6000 + 40000 * np.maximum(height, 0))
    total = 0.5 * (6000 + ground) + at_eye
    sources = (40000 / DISC) ** 2 * DISC / index(sun[:, 0], height, cosine) ** 2
    hours = np.flatnonzero(light & (cosine > 0.1) & (height > 0.1))
    expected = dgp(total[hours], sources[hours])
    # The sun's own light stands in one of Tregenza's patches, less than a tenth of the light at the eye differs by that.
    assert np.abs(values[0, hours] - expected).mean() < 0.01


def test_a_pane_dims_what_is_seen_and_a_wall_takes_all(tmp_path, run):
    file, _ = weather(tmp_path, diffuse=20000.0)
    corners = "[(-500, 1, -500), (500, 1, -500), (500, 1, 500), (-500, 1, 500)]"
    pane = PANE + SQUARE.format(name="Window", points=corners, binding="rel material:binding = </Pane>")
    found, values = year(run, tmp_path, stage(tmp_path, pane), file, "--facing", "0,1,0")
    luminance = 20000 / np.pi
    sources, light_of_sky = even_sky(luminance, lambda ahead: 0.5 ** (1 / ahead))
    expected = dgp(1.2 * light_of_sky, sources)
    assert values[0, 12 + 24 * 170] == pytest.approx(expected, abs=0.004)
    wall = SQUARE.format(name="Wall", points=corners, binding="")
    found, values = year(run, tmp_path, stage(tmp_path, wall), file, "--directions", "2")
    ahead, behind = found["views"]
    assert ahead["facing"] == [0, 1, 0] and behind["facing"] == pytest.approx([0, -1, 0], abs=1e-9)
    assert values[1, 12 + 24 * 170] > values[0, 12 + 24 * 170] + 0.1
    assert set(found["views_within_5_percent"]) == {"0.35", "0.40", "0.45"}


def test_eyes_over_a_grid(tmp_path, run):
    file, _ = weather(tmp_path)
    floor = SQUARE.format(name="Floor", points="[(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]", binding="")
    done = run("annual-glare", stage(tmp_path, floor), "--weather", file, "--grid", "/Floor", "--spacing", "1", "-p", "64", "-m", "1", "-q", "--json", timeout=120)
    assert done.returncode == 0, done.stderr
    views = json.loads(done.stdout)["views"]
    assert len(views) == 4 * 4 and all(view["position_m"][2] == pytest.approx(1.2) for view in views)


@pytest.mark.parametrize(
    ("options", "message"),
    [([], "nobody who looks"), (["--eye", "0,0,1", "--facing", "0,0,0"], "looks nowhere"), (["--eye", "0,0"], "three numbers")],
)
def test_bad_eyes_are_told(tmp_path, run, options, message):
    file, _ = weather(tmp_path)
    done = run("annual-glare", stage(tmp_path), "--weather", file, "-q", *options)
    assert done.returncode == 1 and message in done.stderr


def test_python_rates_the_same(tmp_path, run):
    gonio = pytest.importorskip("gonio")
    file, _ = weather(tmp_path)
    _, values = year(run, tmp_path, stage(tmp_path), file, "--facing", "0,1,0", "-m", "1")
    scene = gonio.load_usd(stage(tmp_path))
    (reading,) = gonio.annual_glare(scene, file.read_bytes(), [((0, 0, 1.2), (0, 1, 0))], samples=4096, division=1, sky="cie5")
    np.testing.assert_array_equal(np.asarray(reading.values, np.float32), values[0])
    assert reading.en17037 == "below the minimum" and reading.figures["above_045"] == pytest.approx(0.8)
    assert reading.standard_errors["dgp_5_percent"] < 0.01

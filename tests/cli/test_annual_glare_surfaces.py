"""`gonio annual-glare --surfaces`: a bright wall in closed form, and hours in a room with sunlit screens against pictures that are rated by themselves."""

import json

import facade_room
import numpy as np
import pytest
from test_annual_glare import dgp, even_sky, stage, weather, year
from test_annual_trace import MATTE
from wea_years import HOUR, write_wea

WALL = """def Mesh "Wall" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    point3f[] points = [(-5000, 1, -5000), (5000, 1, -5000), (5000, 1, 5000), (-5000, 1, 5000)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    rel material:binding = </Matte>
}
"""
NOON = 12 + 24 * 170


def index_below(right, up, ahead):
    """Iwata and Tokura's position index in Kikuchi's coordinates."""
    across = np.hypot(right, up)
    beta = np.degrees(np.arctan2(np.hypot(across, np.sqrt(0.3225) * up), ahead))
    return np.minimum(np.exp(6.49e-3 * beta + 21e-5 * beta**2), 16.0)


def even_below(luminance):
    """The sum over sources of the lower half before the eye."""
    azimuth, height = np.meshgrid(np.radians(np.arange(-89.75, 90, 0.5)), np.radians(np.arange(-89.75, 0, 0.5)))
    right, up, ahead = np.cos(height) * np.sin(azimuth), np.sin(height), np.cos(height) * np.cos(azimuth)
    return np.sum(luminance**2 * np.cos(height) * np.radians(0.5) ** 2 / index_below(right, up, ahead) ** 2)


@pytest.mark.parametrize(("diffuse", "glares"), [(26000.0, True), (18000.0, False)])
def test_a_bright_wall_before_the_eye(tmp_path, run, diffuse, glares):
    """It fills what is seen, and half of an even sky and of its ground shine on it."""
    file, light = weather(tmp_path, diffuse=diffuse)
    path = stage(tmp_path, MATTE + WALL)
    luminance = 0.5 * 0.6 * diffuse / np.pi
    found, values = year(run, tmp_path, path, file, "--facing", "0,1,0", "--surfaces", "-m", "2")
    assert (luminance >= 2000) == glares and found["surfaces"]
    sources = even_sky(luminance)[0] + even_below(luminance) if glares else 0.0
    expected = dgp(np.pi * luminance, sources)
    assert values[0, NOON] == pytest.approx(expected, abs=0.004)
    assert not values[0][~light].any()
    # Without surfaces a wall counts in the light at the eye alone.
    _, plain = year(run, tmp_path, path, file, "--facing", "0,1,0", "-m", "2")
    assert plain[0, NOON] == pytest.approx(dgp(np.pi * luminance, 0.0), abs=0.002)
    if glares:
        assert values[0, NOON] > plain[0, NOON] + 0.006


def eye(facing):
    """A picture of what an eye in the middle of the room sees, a fisheye of half of all directions."""
    across = {"south": "(-1, 0, 0, 0), (0, 0, 1, 0), (0, 1, 0, 0)", "west": "(0, 1, 0, 0), (0, 0, 1, 0), (1, 0, 0, 0)"}[facing]
    return f"""def Camera "Eye"
{{
    double gonio:fisheye = 180
    float horizontalAperture = 20
    float verticalAperture = 20
    matrix4d xformOp:transform = ( {across}, (2, 3, 1.2, 1) )
    uniform token[] xformOpOrder = ["xformOp:transform"]
}}
"""


@pytest.mark.parametrize(("facing", "hour", "state"), [("south", 12, "closed"), ("west", 15, "closed"), ("south", 10, "open")])
def test_hours_are_those_of_pictures(tmp_path, run, facing, hour, state):
    """The same sun and an even sky on floor and walls, and a strip of sun past the screen, narrower than directions. Pictures rate clusters by their means."""
    write_wea(tmp_path / "year.wea", np.where(np.abs(HOUR - 12) < 5, 50000, 0), np.where(np.abs(HOUR - 12) < 6, 9000, 0))
    (tmp_path / "room.usda").write_text(facade_room.stage() + eye(facing))
    states = ("--variant", f"/Room/South{{blinds={state}}}", "--variant", f"/Room/West{{blinds={state}}}")
    towards = {"south": "0,-1,0", "west": "-1,0,0"}[facing]
    options = ("--sky", "cie5", "--eye", "2,3,1.2", "--facing", towards, "--surfaces", "-p", 262144, "-q", "--json", "-o", tmp_path / "out")
    done = run("annual-glare", tmp_path / "room.usda", "--weather", tmp_path / "year.wea", *states, *options, timeout=300)
    assert done.returncode == 0, done.stderr
    ours = np.load(tmp_path / "out" / "glare.npy")[0, 24 * 171 + hour]
    when = f"49.52,8.55,2025-06-21T{hour}:30+01:00"
    sun = ("--sun", when, "--sky", "cie5", "--weather", tmp_path / "year.wea", "--ground", 0.2)
    picture = ("-o", tmp_path / "eye.exr", "--camera", "/Eye", "--res", 400, 400, "--spp", 256, "--aov", "luminance", "-q")
    done = run("render", tmp_path / "room.usda", *states, *sun, *picture, timeout=300)
    assert done.returncode == 0, done.stderr
    theirs = json.loads(run("glare", tmp_path / "eye.exr", "--json").stdout)
    print(f"{facing} at {hour}:30, {state}: {ours:.3f}, a picture {theirs['dgp']:.3f}")
    assert ours == pytest.approx(theirs["dgp"], abs=0.02)


def test_blinds_and_surfaces_go_together(tmp_path, run):
    """Closed hours have the surfaces of the closed state."""
    write_wea(tmp_path / "year.wea", np.where(np.abs(HOUR - 12) < 4, 50000, 0), np.where(np.abs(HOUR - 12) < 6, 9000, 0))
    (tmp_path / "room.usda").write_text(facade_room.stage())

    def values(*options):
        words = ("--eye", "2,3,1.2", "--facing", "0,-1,0", "--surfaces", "-m", 1, "-p", 1024, "-q", "-o", tmp_path / "out")
        done = run("annual-glare", tmp_path / "room.usda", "--weather", tmp_path / "year.wea", *words, *options, timeout=300)
        assert done.returncode == 0, done.stderr
        return np.load(tmp_path / "out" / "glare.npy")[0]

    state = "/Room/South{blinds=closed}"
    open_, closed = values(), values("--variant", state)
    midday = values("--closed-variant", state, "--closed-hours", "11-13")
    np.testing.assert_allclose(midday, np.where(np.abs(HOUR - 12) < 1, closed, open_), atol=1e-5)
    assert np.abs(open_ - closed).max() > 0.1


def test_python_has_them_too(tmp_path, run):
    import gonio

    file, _ = weather(tmp_path, diffuse=26000.0)
    path = stage(tmp_path, MATTE + WALL)
    _, values = year(run, tmp_path, path, file, "--facing", "0,1,0", "--surfaces", "-m", "1")
    eyes = [((0, 0, 1.2), (0, 1, 0))]
    (found,) = gonio.annual_glare(gonio.load_usd(path), file.read_bytes(), eyes, samples=4096, division=1, sky="cie5", surfaces=True)
    np.testing.assert_array_equal(np.asarray(found.values, np.float32), values[0])
    assert 0 < found.standard_errors["dgp_5_percent"] < 0.01

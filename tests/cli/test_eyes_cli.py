"""Eyes at the points of grids: `gonio measure --eyes`, shares that reach a value, verdicts and dimming by them, against closed forms."""

import csv
import json
import math

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# A floor of 4 m by 4 m in centimetres, 3 m under a sphere of 1 cm, in an empty room: I = π r² L.
STAGE = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Mesh "Floor" {{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-200, -200, 0), (200, -200, 0), (200, 200, 0), (-200, 200, 0)]
    {floor}
}}
def SphereLight "Lamp" {{
    float inputs:radius = 1
    float inputs:intensity = 20000000
    string gonio:spectrum = "LED-B3"
    token gonio:lightGroup = "Lamps"
    double3 xformOp:translate = (30, 0, 300)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
INTENSITY = math.pi * 0.01**2 * 2e7
DER = 0.6326
ROUND = [(0, 1, 0), (1, 0, 0), (0, -1, 0), (-1, 0, 0)]
PLACE = ("--grid", "/Floor", "--integrator", "direct", "--spp", 1024)
GRID = (*PLACE, "--spacing", 1)


@pytest.fixture
def stage(tmp_path):
    def write(floor=""):
        path = tmp_path / "room.usda"
        path.write_text(STAGE.format(floor=floor))
        return path

    return write


def measured(run, path, *arguments):
    return json.loads(run("measure", path, "--json", "--quiet", *arguments).stdout)


def lux(height, facings=ROUND):
    """E = I cos θ / d² of each eye of the grid, points × directions."""
    places = [(x, y, height) for y in (-1.5, -0.5, 0.5, 1.5) for x in (-1.5, -0.5, 0.5, 1.5)]
    way = np.array([0.3, 0.0, 3.0]) - np.array(places)
    return INTENSITY * np.maximum(way @ np.array(facings, float).T, 0.0) / np.linalg.norm(way, axis=1)[:, None] ** 3


@pytest.mark.parametrize("eyes, height", [("sitting", 1.2), ("standing", 1.6), ("0.9", 0.9)])
@pytest.mark.parametrize("quantity, ratio", [("illuminance", 1.0), ("melanopic-edi", DER)])
def test_eyes_look_around(run, stage, eyes, height, quantity, ratio):
    found = measured(run, stage(), *GRID, "--eyes", eyes, "--quantity", quantity)["grids"][0]
    expected = ratio * lux(height)
    rel = 0.003 if ratio != 1.0 else 1e-3
    assert np.allclose(found["eyes"]["facings"], ROUND)
    np.testing.assert_allclose(found["eyes"]["values"], expected, rtol=rel, atol=rel * expected.max())
    np.testing.assert_allclose(found["values"], expected.mean(axis=1), rtol=rel)
    np.testing.assert_allclose(found["eyes"]["leasts"], expected.min(axis=1), rtol=rel, atol=rel)
    assert found["average"]["value"] == pytest.approx(expected.mean(), rel=rel)
    assert found["eyes"]["least"]["value"] == pytest.approx(expected.min(), abs=rel)
    towards = [reading["value"] for reading in found["eyes"]["by_facing"]]
    assert towards == pytest.approx(expected.mean(axis=0), rel=rel)
    errors = np.array(found["eyes"]["standard_errors"])
    np.testing.assert_allclose(found["standard_errors"], np.sqrt((errors**2).sum(axis=1)) / 4)


def test_directions_of_ones_own(run, stage):
    ways = [(0.0, 1.0, 0.0), (math.sqrt(0.5), 0.0, math.sqrt(0.5))]
    options = ("--facing", "0,3,0", "--facing", "1,0,1", "--eyes", "sitting")
    found = measured(run, stage(), *GRID, *options)["grids"][0]
    np.testing.assert_allclose(found["eyes"]["values"], lux(1.2, ways), rtol=1e-3, atol=1e-3)
    eight = measured(run, stage(), *GRID, "--eyes", "sitting", "--directions", 8)["grids"][0]
    angles = np.arange(8) * math.pi / 4
    np.testing.assert_allclose(eight["eyes"]["facings"], np.stack([np.sin(angles), np.cos(angles), 0 * angles], -1), atol=1e-12)


def test_the_share_that_reaches_a_value(run, stage, tmp_path):
    table = tmp_path / "eyes.csv"
    options = (*GRID, "--eyes", "sitting", "--quantity", "melanopic-edi", "--target", 250)
    found = measured(run, stage(), *options, "--csv", table)["grids"][0]
    expected = DER * lux(1.2)
    target = found["target"]
    for name, values in (("points", expected.mean(axis=1)), ("points_all_ways", expected.min(axis=1)), ("eyes", expected.ravel())):
        # No closed form is near 250 lx: noise leaves none open.
        assert np.abs(values / 250 - 1).min() > 0.01
        assert target[name] == {
            "count": values.size,
            "share": pytest.approx(np.mean(values >= 250)),
            "standard_error": 0,
            "share_within_error": 0,
        }
    assert 0 < target["eyes"]["share"] < 1 and target["value"] == 250
    rows = list(csv.DictReader(table.read_text().splitlines()))
    assert len(rows) == expected.size
    assert [float(row["value"]) for row in rows] == pytest.approx(expected.ravel(), rel=0.003, abs=1.0)
    assert [(float(row["facing_x"]), float(row["facing_y"])) for row in rows[:4]] == [(x, y) for x, y, _ in ROUND]
    text = run("measure", stage(), *options, "--quiet").stdout
    share = 100 * np.mean(expected >= 250)
    assert f"250 lx reached at {100 * np.mean(expected.mean(axis=1) >= 250):.1f} %" in text and f"by {share:.1f} % (0.0 %" in text
    assert "mean of 4 directions of eyes" in text and "towards 1.00,0.00,0.00: average" in text and "U0" not in text


def test_a_prim_of_the_stage_has_eyes(run, stage):
    floor = "double gonio:grid:spacing = 100\n    double gonio:grid:height = 120\n    int gonio:grid:eyes = 4"
    found = measured(run, stage(floor), "--integrator", "direct", "--spp", 1024)["grids"][0]
    np.testing.assert_allclose(found["values"], lux(1.2).mean(axis=1), rtol=1e-3)
    turned = floor + "\n    vector3d gonio:grid:facing = (1, 0, 0)"
    found = measured(run, stage(turned), "--integrator", "direct", "--spp", 64)["grids"][0]
    assert np.allclose(found["eyes"]["facings"], [*ROUND[1:], ROUND[0]])
    done = run("measure", stage(floor.replace("= 4", "= 65")), "--integrator", "direct", "--spp", 16)
    assert done.returncode == 0 and "gonio:grid:eyes is 65" in done.stderr
    done = run("sunlight", stage(floor), "--place", "48,16", "--day", "2025-03-21", "--json", "--quiet", check=False)
    assert done.returncode != 0 or len(json.loads(done.stdout)["grids"][0]["hours"]) == 16


def test_colours_of_eyes(run, stage, tmp_path):
    table = tmp_path / "colours.csv"
    options = ("--eyes", "standing", "--facing", "0,0,1", "--quantity", "cct")
    found = measured(run, stage(), *PLACE, *options, "--spacing", 2, "--csv", table)["grids"][0]
    assert len(found["colours"]) == 4
    for row, colour in zip(csv.DictReader(table.read_text().splitlines()), found["colours"], strict=True):
        assert float(row["cct"]) == pytest.approx(colour["cct"], abs=1e-3)
        assert float(row["melanopic_edi_lx"]) == pytest.approx(colour["melanopic_edi_lx"], abs=1e-3)
        assert float(row["rf"]) == pytest.approx(colour["rf"], abs=1e-3)
        assert colour["melanopic_edi_lx"] / colour["illuminance_lx"] == pytest.approx(DER, abs=0.002)


def test_verdicts_on_eyes(run, stage, tmp_path):
    options = (*GRID, "--eyes", "sitting", "--quantity", "melanopic-edi", "--target", 150, "--json", "--quiet")
    file, wanted = tmp_path / "eyes.json", tmp_path / "wanted.toml"
    file.write_text(run("measure", stage(), *options).stdout)
    expected = DER * lux(1.2)
    require = '[[require]]\narea = "Floor"\nquantity = "{}"\nat_least = {}\n{}\n'
    lines = (("share_of_eyes", 40, 'unit = "%"'), ("share_all_ways", 0.5, ""), ("least_eye", 0, ""), ("melanopic_edi", 1e5, 'unit = "lx"'))
    wanted.write_text("".join(require.format(*line) for line in lines))
    sheet = json.loads(run("verdict", wanted, file, "--json", check=False).stdout)
    reached = [row["reached"]["value"] for row in sheet["requirements"]]
    shares = [100 * np.mean(expected >= 150), np.mean(expected.min(axis=1) >= 150), expected.min(), expected.mean()]
    assert reached == pytest.approx(shares, rel=0.003, abs=0.5)
    assert [row["verdict"] for row in sheet["requirements"]][1] == "not_met"
    assert any("150 lx" in note for note in sheet["requirements"][0]["notes"])


def test_dimming_by_eyes(run, stage):
    options = (*GRID, "--eyes", "sitting", "--quantity", "melanopic-edi", "--watts", "Lamps=100", "--json", "--quiet")
    found = json.loads(run("dim", stage(), *options, "--target", "Floor.mean>=50", check=False).stdout)
    assert found["groups"][0]["level"] == pytest.approx(50 / (DER * lux(1.2).mean()), rel=0.005)
    # The least eye counts.
    up = ("--facing", "0,0,1", "--facing", "1,0,1")
    found = json.loads(run("dim", stage(), *options, *up, "--target", "Floor.min>=20", check=False).stdout)
    least = lux(1.2, [(0, 0, 1), (0.5**0.5, 0, 0.5**0.5)]).min()
    assert found["groups"][0]["level"] == pytest.approx(20 / (DER * least), rel=0.005)


@pytest.mark.parametrize(
    "arguments, words",
    [
        (("--eyes", "sitting"), "--grid"),
        (("--grid", "/Floor", "--eyes", "lying"), "sitting, standing or a height"),
        (("--grid", "/Floor", "--eyes", "1.2", "--height", 1), "cannot be used with"),
        (("--grid", "/Floor", "--facing", "0,1,0"), "--facing"),
        (("--grid", "/Floor", "--eyes", "1.2", "--directions", 0), "from 1 to 64"),
        (("--grid", "/Floor", "--eyes", "1.2", "--facing", "0,0,0"), "eyes look nowhere"),
        (("--grid", "/Floor", "--eyes", "1.2", "--quantity", "ugr"), "a grid of ugr has none"),
        (("--at", "0,0,1", "--facing", "0,1,0", "--facing", "1,0,0"), "several are for --eyes"),
    ],
)
def test_what_makes_no_eyes_is_told(run, stage, arguments, words):
    done = run("measure", stage(), "--quiet", *arguments, check=False)
    assert done.returncode != 0 and words in done.stderr, done.stderr

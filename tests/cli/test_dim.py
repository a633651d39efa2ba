"""`gonio dim`: levels against scipy's linear programs, and what `gonio measure` finds of the layer that it writes."""

import json
import math

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# A floor of 8 m by 4 m of half reflectance, under eight lamps in two rows, two metres above it; each is a group, and stronger than the last.
LAMPS = [(x, y, 5000 + 400 * number) for number, (y, x) in enumerate((y, x) for y in (-1.0, 1.0) for x in (-3.0, -1.0, 1.0, 3.0))]
HEAD = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Floor" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-4, -2, 0), (4, -2, 0), (4, 2, 0), (-4, 2, 0)]
    double gonio:grid:spacing = 0.8
}
"""
LAMP = """def SphereLight "{name}" {{
    float inputs:radius = 0.05
    double gonio:photometry:quantity = {lumens}
    token gonio:lightGroup = "{group}"
    {more}
    double3 xformOp:translate = ({x}, {y}, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""
QUICK = ("--grid", "/Floor", "--spp", 256, "--quiet")
WATTS = [5.0, 5.5, 4.5, 6.0, 5.2, 4.8, 6.3, 5.7]


def lamp(name, x, y, lumens, group, more=""):
    return LAMP.format(name=name, x=x, y=y, lumens=lumens, group=group, more=more)


@pytest.fixture
def stage(tmp_path):
    path = tmp_path / "stage.usda"
    path.write_text(HEAD + "".join(lamp(f"Lamp{k}", x, y, lumens, f"g{k}") for k, (x, y, lumens) in enumerate(LAMPS)))
    return path


def options(*targets):
    watts = [word for k, watts in enumerate(WATTS) for word in ("--watts", f"g{k}={watts}")]
    return (*QUICK, *watts, *(word for target in targets for word in ("--target", target)))


def dimmed(run, *arguments, status=0):
    done = run("dim", *arguments, "--json")
    assert done.returncode == status, done.stderr
    return json.loads(done.stdout)


def contributions(found):
    """Points x groups, and the fixed part."""
    points = found["areas"][0]["points"]
    groups = np.array([[group["value"] for group in point["groups"]] for point in points])
    return groups, np.array([point["fixed"]["value"] for point in points])


def test_the_optimum_is_that_of_scipy(run, stage):
    optimize = pytest.importorskip("scipy.optimize", reason="scipy is not there to compare with")
    found = dimmed(run, stage, *options("Floor.mean>=120", "Floor.uo>=0.6", "Floor.max<=260"))
    light, fixed = contributions(found)
    assert np.all(fixed == 0)
    mean = light.mean(axis=0)
    rows = np.vstack([-mean, 0.6 * mean - light, light])
    limits = np.concatenate([[-120.0], np.zeros(len(light)), np.full(len(light), 260.0)])
    best = optimize.linprog(WATTS, A_ub=rows, b_ub=limits, bounds=(0, 1))
    assert best.status == 0 and found["watts"] == pytest.approx(best.fun, rel=1e-5)
    levels = np.array([group["level"] for group in found["groups"]])
    assert np.all(rows @ levels <= limits + 1e-3) and levels @ WATTS == pytest.approx(found["watts"])
    assert {target["verdict"] for target in found["targets"]} <= {"met", "within_error"}


def test_contributions_are_those_of_the_lamps_alone(run, stage):
    found = dimmed(run, stage, *options("/Floor.mean>=50"), "--integrator", "direct")
    light, _ = contributions(found)
    # E = I h / d³ of a lamp that is seen as a point, I = Φ / 4π. Grid cells are 10 × 5, the middles of cells of 0.8 m.
    columns = np.array([-3.6 + 0.8 * k for k in range(10)])
    rows = np.array([-1.6 + 0.8 * k for k in range(5)])
    for k, (x, y, lumens) in enumerate(LAMPS):
        away = (columns[None, :] - x) ** 2 + (rows[:, None] - y) ** 2 + 4
        expected = np.sort((lumens / (4 * math.pi) * 2 / away**1.5).ravel())
        assert np.sort(light[:, k]) == pytest.approx(expected, rel=0.01)


def test_the_layer_meets_the_targets_when_it_is_measured(run, stage, tmp_path):
    layer = tmp_path / "layers" / "dimmed.usda"
    found = dimmed(run, stage, *options("Floor.mean>=120", "Floor.min>=60"), "--errors", 2, "-o", layer)
    assert [target["verdict"] for target in found["targets"]] == ["met", "met"]
    grid = json.loads(run("measure", layer, *QUICK, "--json").stdout)["grids"][0]
    mean, least = grid["average"], grid["min"]
    errors = [math.hypot(reading["standard_error"], target["error"]) for reading, target in zip((mean, least), found["targets"], strict=True)]
    assert mean["value"] >= 120 - 3 * errors[0] and least["value"] >= 60 - 3 * errors[1]
    assert mean["value"] == pytest.approx(found["targets"][0]["reached"], abs=5 * math.hypot(mean["standard_error"], found["targets"][0]["error"]))
    # The same again is the same.
    text = layer.read_text()
    dimmed(run, stage, *options("Floor.mean>=120", "Floor.min>=60"), "--errors", 2, "-o", layer)
    assert layer.read_text() == text and "./../stage.usda" in text


def test_a_dimming_of_the_stage_is_multiplied(run, tmp_path):
    path, layer = tmp_path / "stage.usda", tmp_path / "dimmed.usda"
    path.write_text(HEAD + lamp("Lamp", 0, 0, 1000, "only", "float gonio:photometry:dimming = 0.8"))
    found = dimmed(run, path, "--at", "0,0,0", "--integrator", "direct", "--spp", 16, "--quiet", "--target", "0,0,0=10+-0", "-o", layer)
    level = found["groups"][0]["level"]
    assert level == pytest.approx(10 / (0.8 * 1000 / (4 * math.pi) / 4), rel=0.01)
    assert found["groups"][0]["watts_from"] == "flux" and found["groups"][0]["watts_full"] == pytest.approx(8, rel=0.01)
    meter = json.loads(run("measure", layer, "--at", "0,0,0", "--integrator", "direct", "--spp", 16, "--json", "--quiet").stdout)
    assert meter["meters"][0]["value"] == pytest.approx(10, rel=2e-3)


def test_lamps_in_no_group_stay_as_they_are(run, tmp_path):
    path = tmp_path / "stage.usda"
    path.write_text(HEAD + lamp("Lamp", 0, 0, 1000, "only") + lamp("Other", 2, 0, 1000, "").replace('    token gonio:lightGroup = ""\n', ""))
    found = dimmed(run, path, "--at", "0,0,0", "--integrator", "direct", "--spp", 64, "--quiet", "--target", "0,0,0=15+-0")
    point = found["areas"][0]["points"][0]
    candela = 1000 / (4 * math.pi)
    assert point["fixed"]["value"] == pytest.approx(candela * 2 / 8**1.5, rel=0.01)
    assert point["groups"][0]["value"] == pytest.approx(candela / 4, rel=0.01)
    assert found["groups"][0]["level"] == pytest.approx((15 - point["fixed"]["value"]) / point["groups"][0]["value"])


def test_what_cannot_be_met_says_by_how_much(run, stage):
    found = dimmed(run, stage, *options("Floor.mean>=5000"), "--fixed", "g0=0.5", status=1)
    levels = [group["level"] for group in found["groups"]]
    assert levels == pytest.approx([0.5] + [1.0] * 7, abs=1e-5)
    target = found["targets"][0]
    assert target["verdict"] == "not_met" and target["margin"] == pytest.approx(target["reached"] - 5000)
    done = run("dim", stage, *options("Floor.mean>=5000"))
    assert done.returncode == 1 and "Floor.mean>=5000: " in done.stdout and "not met by " in done.stdout and not done.stderr


def test_least_levels_and_equal_ones(run, stage):
    found = dimmed(run, stage, *options("Floor.mean>=80"), "--min-level", 0.25)
    assert min(group["level"] for group in found["groups"]) == pytest.approx(0.25, abs=1e-6)
    found = dimmed(run, stage, *options("Floor.mean>=80"), "--near", "equal")
    levels = [group["level"] for group in found["groups"]]
    assert max(levels) - min(levels) < 1e-5
    found = dimmed(run, stage, *options("Floor.mean>=10"), "--near", "g3=0.7")
    assert found["groups"][3]["level"] == pytest.approx(0.7, abs=1e-5)


@pytest.mark.parametrize(
    ("arguments", "told"),
    [
        (("--target", "Floor.mean>500"), "expected NAME.mean>="),
        (("--target", "Floor.mean>=nan"), "'nan' in it is no number"),
        (("--target", "Floor.max>=5"), "expected NAME.mean>="),
        (("--target", "Wall.mean>=5"), "nothing measured is called 'Wall', expected one of /Floor"),
        (("--target", "Floor.mean>=5", "--watts", "x=5"), "there is no light group 'x', expected one of g0, g1"),
        (("--target", "Floor.mean>=5", "--watts", "g0"), "expected GROUP=NUMBER"),
        (("--target", "Floor.mean>=5", "--fixed", "g0=1.5"), "expected a level from 0 to 1"),
        (("--target", "Floor.mean>=5", "--near", "equal", "--near", "g0=1"), "'equal' stands alone"),
        (("--target", "Floor.mean>=5", "-o", "dimmed.png"), "expected usda"),
        (("--target", "Floor.mean>=5", "--quantity", "daylight-factor"), "which no dimming changes"),
    ],
)
def test_what_is_wrong_is_told_in_one_line(run, stage, arguments, told):
    done = run("dim", stage, *QUICK, *arguments)
    assert done.returncode == 1 and told in done.stderr and len(done.stderr.splitlines()) == 1


def test_a_stage_without_groups_is_told(run, tmp_path):
    path = tmp_path / "stage.usda"
    path.write_text(HEAD)
    done = run("dim", path, *QUICK, "--target", "Floor.mean>=5")
    assert done.returncode == 1 and "gonio:lightGroup" in done.stderr


@pytest.mark.parametrize("arguments", [("--min-level", "2"), ("--min-level", "nan"), ("--errors", "-1"), ("--errors", "inf")])
def test_numbers_that_are_none_are_refused(run, stage, arguments):
    done = run("dim", stage, *QUICK, "--target", "Floor.mean>=5", *arguments)
    assert done.returncode == 2 and arguments[0] in done.stderr


def test_python_finds_the_same_levels(run, stage):
    targets = ("Floor.mean>=120", "Floor.uo>=0.5")
    watts = {f"g{k}": value for k, value in enumerate(WATTS)}
    command = dimmed(run, stage, *options(*targets))
    scene = gonio.load_usd(str(stage))
    found = gonio.dim(scene, targets, watts=watts, samples=256)
    assert found["met"] and found["watts"] == pytest.approx(command["watts"], rel=1e-6)
    assert [group["level"] for group in found["groups"]] == pytest.approx([group["level"] for group in command["groups"]], abs=1e-6)
    assert [target["verdict"] for target in found["targets"]] == [target["verdict"] for target in command["targets"]]
    near = gonio.dim(scene, targets[:1], watts=watts, near="equal", fixed={"g0": 0.5}, samples=256)
    levels = [group["level"] for group in near["groups"]]
    assert levels[0] == 0.5 and levels[1:] == pytest.approx([levels[1]] * 7, abs=1e-6)
    assert any("100 lm/W" in note for note in gonio.dim(scene, targets[:1], samples=64)["notes"])
    for more, words in (({"near": "alike"}, "expected 'equal'"), ({"fixed": {"g9": 1}}, "no light group 'g9'"), ({"min_level": 2}, "expected 0 to 1")):
        with pytest.raises(gonio.SettingError, match=words):
            gonio.dim(scene, targets, samples=64, **more)


def test_power_is_the_files_as_far_as_a_lamp_is_dimmed(run, tmp_path):
    """A file's watts times the dimmer's factor; flux of new lamps at 100 lm/W; a picture over a lamp counts by its mean. Python alike."""
    from pictures import write_png

    (tmp_path / "lamp.ies").write_text("IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 40\n0 90\n0\n100 100\n")
    write_png(tmp_path / "half.png", np.tile(np.array([[[255] * 3, [0] * 3]], "u1"), (4, 4, 1)))
    filed = '''asset gonio:photometry:file = @lamp.ies@
    float gonio:photometry:dimming = 0.5
    float gonio:photometry:maintenanceFactor = 0.8'''
    maintained = "float gonio:photometry:maintenanceFactor = 0.8"
    lamps = lamp("A", 0, 0, 2000, "filed", filed).replace("    double gonio:photometry:quantity = 2000\n", "") + lamp("B", 1, 0, 2000, "bare", maintained)
    panel = lamp("C", 2, 0, 2000, "panel").replace("SphereLight", "RectLight").replace("float inputs:radius = 0.05", "asset inputs:texture:file = @half.png@")
    path = tmp_path / "lamps.usda"
    path.write_text(HEAD + lamps + panel)
    watts = {"filed": 20.0, "bare": pytest.approx(20.0), "panel": pytest.approx(10.0, rel=1e-3)}
    found = dimmed(run, path, *QUICK, "--target", "Floor.mean>=1")
    assert {group["name"]: group["watts_full"] for group in found["groups"]} == watts
    assert {group["name"]: group["watts_from"] for group in found["groups"]} == {"filed": "files", "bare": "flux", "panel": "flux"}
    assert found["diagnostics"] == []
    by_python = gonio.dim(gonio.load_usd(path), ["Floor.mean>=1"], samples=64)
    assert {group["name"]: group["watts_full"] for group in by_python["groups"]} == watts


@pytest.fixture
def tunable(tmp_path):
    """A warm and a cool lamp at one place, so that the colour is the same all over the floor."""
    path = tmp_path / "tunable.usda"
    spectra = (("Warm", "2700K"), ("Cool", "D65"))
    path.write_text(HEAD + "".join(lamp(name, 0, 0, 6000, name, f'string gonio:spectrum = "{spectrum}"') for name, spectrum in spectra))
    return path


def test_two_spectra_are_mixed_to_a_colour_temperature(run, tunable, tmp_path):
    layer = tmp_path / "dimmed.usda"
    targets = ("--target", "Floor.mean=60+-1", "--target", "Floor.cct=4000+-20")
    found = dimmed(run, tunable, "--grid", "/Floor", "--spp", 64, "--quiet", *targets, "-o", layer)
    mean, cct = found["targets"]
    assert cct["verdict"] != "not_met" and abs(cct["reached"] - 4000) < 21 and abs(mean["reached"] - 60) < 1.5
    # The mixture of both spectra, by the levels that were found: each brings as many lumens at level 1.
    nm, mixed = np.arange(380.0, 781.0), 0.0
    for name, spectrum in (("Warm", "2700K"), ("Cool", "D65")):
        lamp_spectrum = gonio.illuminant(spectrum)
        power = np.interp(nm, lamp_spectrum["wavelengths_nm"], lamp_spectrum["power"])
        lumens = power.sum() * gonio.spectrum_figures(nm, power)["ler"]
        mixed = mixed + next(group["level"] for group in found["groups"] if group["name"] == name) * power / lumens
    assert gonio.spectrum_figures(nm, mixed)["cct"] == pytest.approx(cct["reached"], abs=3)
    # What is measured of the layer afterwards.
    measured = json.loads(run("measure", layer, "--grid", "/Floor", "--spp", 64, "--quantity", "cct", "--quiet", "--json").stdout)["grids"][0]
    assert measured["average"]["value"] == pytest.approx(cct["reached"], abs=3)
    assert "colours" in found["areas"][0] and len(found["areas"][0]["colours"]) == len(found["areas"][0]["points"])


def test_python_mixes_the_same(run, tunable):
    scene = gonio.load_usd(tunable)
    scene.add_meter((0, 0, 0.01), name="Desk")
    found = gonio.dim(scene, ["Desk.mean>=50", "Desk.cct>=5000"], samples=64)
    assert found["met"] and found["targets"][1]["reached"] >= 4999
    with pytest.raises(gonio.Error, match="colour alone say nothing"):
        gonio.dim(scene, ["Desk.cct>=5000"], samples=64)


@pytest.mark.parametrize(
    ("target", "more", "told"),
    [
        ("Floor.cct=4000", (), "a tolerance is missing, as in NAME.cct=4000+-100"),
        ("Floor.cct>=100", (), "expected a temperature from 1000 to 25000 K"),
        ("Floor.cct>=4000", (), "colour alone say nothing of how much light there is"),
        ("Floor.cct>=4000", ("--quantity", "cylindrical", "--target", "Floor.mean>=1"), "measures cylindrical, expected illuminance or cct"),
    ],
)
def test_colours_that_cannot_be_asked_for(run, tunable, target, more, told):
    done = run("dim", tunable, *QUICK, "--target", target, *more)
    assert done.returncode == 1 and told in done.stderr and done.stderr.count("\n") == 1, done.stderr


def test_a_grid_of_temperatures_has_colours_alone(run, tunable):
    words = ("--grid", "/Floor", "--spp", 64, "--quiet", "--quantity", "cct", "--at", "0,0,0.01")
    done = run("dim", tunable, *words, "--target", "Floor.mean>=3000")
    assert done.returncode == 1 and "measures a colour: name NAME.cct" in done.stderr

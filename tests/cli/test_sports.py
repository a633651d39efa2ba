"""`gonio sports`: closed forms of bare lamps, planes towards cameras, glare by CIE 112, shadows, glass, plans that are none, and the verdict."""

import json
import math

import pytest

CANDELA, HEIGHT = 50_000.0, 15.0
MASTS = ((-5.0, -10.0), (45.0, -10.0), (-5.0, 30.0), (45.0, 30.0))
STAGE = """#usda 1.0
(
    upAxis = "Z"
    metersPerUnit = 1
)
def Mesh "Far"
{
    uniform bool doubleSided = 1
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-90, -90, -40), (90, -90, -40), (90, 90, -40), (-90, 90, -40)]
    color3f[] primvars:displayColor = [(0, 0, 0)]
}
def DomeLight "Sky"
{
    float inputs:intensity = 1000
}
LAMPS
MORE
"""
LAMP = """def SphereLight "MastNUMBER"
{
    float inputs:radius = 0.05
    double gonio:photometry:quantity = LUMENS
    token gonio:photometry:unit = "lm"
    double3 xformOp:translate = (X, Y, 15)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
FIELD = '[[field]]\nname = "Court"\ncorner = [0, 0, 0]\nalong = [40, 0, 0]\nacross = [0, 20, 0]\npoints = [5, 3]\n'
OBSERVER = '[[observer]]\nname = "Keeper"\nposition = [0, 10, 1.5]\n'


def lamp(number, x, y):
    lumens = 4 * math.pi * CANDELA
    return LAMP.replace("NUMBER", str(number)).replace("LUMENS", str(lumens)).replace("(X, Y,", f"({x}, {y},")


def written(tmp_path, plan, more="", masts=MASTS):
    lamps = "".join(lamp(number, *mast) for number, mast in enumerate(masts))
    (tmp_path / "stage.usda").write_text(STAGE.replace("LAMPS", lamps).replace("MORE", more))
    (tmp_path / "plan.toml").write_text(plan)
    return ["sports", str(tmp_path / "stage.usda"), "--plan", str(tmp_path / "plan.toml")]


def figures(run, command):
    done = run(*command, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def straight(point, normal, masts=MASTS):
    """E = I cos / d² of bare lamps, lx."""
    found = 0.0
    for x, y in masts:
        way = [x - point[0], y - point[1], HEIGHT - point[2]]
        square = sum(part * part for part in way)
        found += CANDELA * max(0.0, sum(a * b for a, b in zip(way, normal, strict=True))) / square**1.5
    return found


def points(height):
    return [((column + 0.5) * 8, (row + 0.5) * 20 / 3, height) for row in range(3) for column in range(5)]


def test_ground_and_cameras(tmp_path, run):
    cameras = '[[camera]]\nname = "Main"\nposition = [20, -50, 12]\n[[camera]]\nname = "Up"\nposition = [20, -50, 12]\ninclined = true\nheight = 0\n'
    found = figures(run, written(tmp_path, "maintenance_factor = 0.8\n" + FIELD + cameras))
    (field,) = found["fields"]
    level = [0.8 * straight(point, (0, 0, 1)) for point in points(0)]
    assert [point["lx"] for point in field["horizontal"]["points"]] == pytest.approx(level, rel=3e-3)
    mean = sum(level) / len(level)
    assert field["horizontal"]["average_lx"] == pytest.approx(mean, rel=2e-3)
    assert field["horizontal"]["u1"] == pytest.approx(min(level) / max(level), rel=5e-3)
    assert field["horizontal"]["u2"] == pytest.approx(min(level) / mean, rel=5e-3)
    for camera, height in zip(field["cameras"], (1.5, 0.0), strict=True):
        expected = []
        for point in points(height):
            way = [20 - point[0], -50 - point[1], 12 - point[2] if camera["name"] == "Up" else 0.0]
            expected.append(0.8 * straight(point, [part / math.hypot(*way) for part in way]))
        assert [point["lx"] for point in camera["points"]] == pytest.approx(expected, rel=4e-3), camera["name"]


def rated(eye, mean, masts=MASTS, reflectance=0.25):
    """GR, the worst of all directions 15° apart."""
    ratings = []
    for step in range(24):
        turn, tilt = math.radians(15 * step), math.radians(-2)
        look = (math.cos(tilt) * math.cos(turn), math.cos(tilt) * math.sin(turn), math.sin(tilt))
        veil = 0.0
        for x, y in masts:
            way = [x - eye[0], y - eye[1], HEIGHT - eye[2]]
            length = math.hypot(*way)
            cosine = sum(a * b for a, b in zip(way, look, strict=True)) / length
            angle = math.degrees(math.acos(cosine))
            veil += 10 * CANDELA / length**2 * cosine / angle**2 if angle <= 60 else 0.0
        if veil > 0:
            ratings.append((27 + 24 * math.log10(veil / (0.035 * reflectance * mean / math.pi) ** 0.9), 15.0 * step))
    return max(ratings)


def test_glare_is_that_of_new_lamps_in_the_worst_direction(tmp_path, run):
    plan = "maintenance_factor = 0.5\n" + FIELD + "glare = true\n" + OBSERVER
    found = figures(run, written(tmp_path, plan))
    mean = sum(straight(point, (0, 0, 1)) for point in points(0)) / 15
    (observer,) = found["observers"]
    gr, look = rated((0, 10, 1.5), mean)
    assert observer["gr"] == pytest.approx(gr, abs=0.05) and observer["look_deg"] in (look, 360 - look)
    glare = found["fields"][0]["glare"]
    expected = [rated(point, mean)[0] for point in points(1.5)]
    assert [point["gr"] for point in glare["points"]] == pytest.approx(expected, abs=0.05)
    assert glare["gr"] == pytest.approx(max(expected), abs=0.05)


WALL = """def Mesh "Wall"
{
    uniform bool doubleSided = 1
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-20, -5, -1), (60, -5, -1), (60, -5, 40), (-20, -5, 40)]
    color3f[] primvars:displayColor = [(0, 0, 0)]
}
"""


def test_what_is_hidden_does_not_dazzle(tmp_path, run):
    found = figures(run, written(tmp_path, FIELD + OBSERVER, WALL))
    seen = MASTS[2:]
    mean = sum(straight(point, (0, 0, 1), seen) for point in points(0)) / 15
    assert found["observers"][0]["gr"] == pytest.approx(rated((0, 10, 1.5), mean, seen)[0], abs=0.05)


PANE = """def Mesh "Pane" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-20, -5, -1), (60, -5, -1), (60, -5, 40), (-20, -5, 40)]
    rel material:binding = </Glass>
}
def Material "Glass"
{
    token outputs:mtlx:surface.connect = </Glass/S.outputs:out>
    def Shader "S"
    {
        uniform token info:id = "ND_standard_surface_surfaceshader"
        float inputs:base = 0
        float inputs:transmission = 1
        float inputs:specular_IOR = 1.5
        bool inputs:thin_walled = THIN
        token outputs:out
    }
}
"""


def test_lamps_behind_glass_are_told(tmp_path, run):
    done = run(*written(tmp_path, FIELD + OBSERVER, PANE.replace("THIN", "0")), "--spp", "64")
    assert done.returncode == 0 and "1 of 1 eyes see luminaires through glass or covers" in done.stderr
    assert "field Court, 5 by 3 points" in done.stdout and "observer Keeper: GR " in done.stdout


def test_lamps_behind_thin_panes_dazzle(tmp_path, run):
    bare, behind = (figures(run, written(tmp_path, FIELD + OBSERVER, more)) for more in ("", PANE.replace("THIN", "1")))
    assert not behind["notes"]
    # A pane of 1.5 lets 92 % and less through of two masts.
    assert bare["observers"][0]["gr"] - 1 < behind["observers"][0]["gr"] < bare["observers"][0]["gr"] + 0.5


def test_the_verdict_reads_it(tmp_path, run):
    camera = '[[camera]]\nname = "Main"\nposition = [20, -50, 12]\n'
    command = written(tmp_path, FIELD + OBSERVER + camera)
    (tmp_path / "pitch.json").write_text(run(*command, "--json").stdout)
    lines = (
        ("Court", "average", 'of = "horizontal"\nat_least = 80'),
        ("Court", "u2", 'of = "Main"\nat_least = 0.99'),
        ("Keeper", "gr", "at_most = 90"),
    )
    text = "".join(f'[[require]]\narea = "{area}"\nquantity = "{quantity}"\n{rest}\n' for area, quantity, rest in lines)
    (tmp_path / "required.toml").write_text(text)
    done = run("verdict", str(tmp_path / "required.toml"), str(tmp_path / "pitch.json"), "--json")
    verdicts = [line["verdict"] for line in json.loads(done.stdout)["requirements"]]
    assert verdicts == ["met", "not_met", "met"], done.stderr


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        ("", "missing field `field`"),
        (FIELD + "point = 3\n", "plan.toml:7: unknown field `point`"),
        ('groups = ["Night"]\n' + FIELD, "there is no light group 'Night'"),
        (FIELD + '[[camera]]\nname = "c"\n', "camera 'c': expected a position"),
    ],
)
def test_what_is_no_plan_is_told(tmp_path, run, plan, message):
    done = run(*written(tmp_path, plan))
    assert done.returncode == 1 and message in done.stderr

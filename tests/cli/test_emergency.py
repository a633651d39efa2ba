"""`gonio emergency`: closed forms of bare lamps, shadows, groups, glare, plans that are none, and the verdict on its figures."""

import json
import math

import pytest

LUMENS = 200.0
HEIGHT = 2.5
STAGE = """#usda 1.0
(
    upAxis = "Z"
    metersPerUnit = 1
)
def Mesh "Floor"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-2, -5, 0), (22, -5, 0), (22, 5, 0), (-2, 5, 0)]
}
LAMPS
MORE
"""
LAMP = """def SphereLight "NAME"
{
    float inputs:radius = 0.01
    double gonio:photometry:quantity = LUMENS
    token gonio:photometry:unit = "lm"
    token gonio:lightGroup = "GROUP"
    double3 xformOp:translate = (X, 0, 2.5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
ROUTE = '[[route]]\nname = "Corridor"\nline = [[0, 0, 0], [8, 0, 0]]\nwidth = 2\nspacing = 1\n'


def lamp(name, x, group="Emergency", lumens=LUMENS):
    return LAMP.replace("NAME", name).replace("GROUP", group).replace("LUMENS", str(lumens)).replace("(X,", f"({x},")


def written(tmp_path, lamps, more="", plan=ROUTE):
    (tmp_path / "stage.usda").write_text(STAGE.replace("LAMPS", lamps).replace("MORE", more))
    (tmp_path / "plan.toml").write_text('groups = ["Emergency"]\nheight = 0\n' + plan)
    return ["emergency", str(tmp_path / "stage.usda"), "--plan", str(tmp_path / "plan.toml"), "-q"]


def figures(run, command):
    done = run(*command, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def straight(x, y=0.0, lamps=((0.0, LUMENS), (8.0, LUMENS))):
    """E = I h / d³ of bare lamps."""
    return sum(lumens / (4 * math.pi) * HEIGHT / ((x - at) ** 2 + y**2 + HEIGHT**2) ** 1.5 for at, lumens in lamps)


def test_a_corridor_between_two_lamps(tmp_path, run):
    command = written(tmp_path, lamp("A", 0) + lamp("B", 8) + lamp("Day", 4, "Mains", 9000))
    found = figures(run, command)
    (route,) = found["routes"]
    centre = [straight(x) for x in range(9)]
    assert [point["lx"] for point in route["centre"]["points"]] == pytest.approx(centre, rel=2e-3)
    assert route["centre"]["min_lx"] == pytest.approx(min(centre), rel=2e-3)
    assert route["centre"]["max_lx"] == pytest.approx(max(centre), rel=2e-3)
    assert route["centre"]["max_to_min"] == pytest.approx(max(centre) / min(centre), rel=4e-3)
    band = [straight(x, y) for x in range(9) for y in (0, 0.25, 0.5)]
    assert route["band"]["min_lx"] == pytest.approx(min(band), rel=2e-3)
    assert [lit["name"] for lit in found["luminaires"]] == ["/A", "/B"]
    for lit in found["luminaires"]:
        assert lit["peak_cd"] == pytest.approx(LUMENS / (4 * math.pi), rel=1e-3) and lit["height_m"] == pytest.approx(HEIGHT)


def test_flux_and_maintenance_are_of_the_light_and_not_of_glare(tmp_path, run):
    command = written(tmp_path, lamp("A", 0) + lamp("B", 8), plan="flux = 0.5\nmaintenance_factor = 0.8\n" + ROUTE)
    found = figures(run, command)
    assert found["factor"] == pytest.approx(0.4)
    assert found["routes"][0]["centre"]["max_lx"] == pytest.approx(0.4 * straight(0), rel=2e-3)
    assert found["luminaires"][0]["peak_cd"] == pytest.approx(LUMENS / (4 * math.pi), rel=1e-3)


WALL = """def Mesh "Wall"
{
    uniform bool doubleSided = 1
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(4, -5, 0), (4, 5, 0), (4, 5, 4), (4, -5, 4)]
}
"""


def test_walls_throw_shadows_and_give_nothing_back(tmp_path, run):
    plan = '[[place]]\nname = "Before"\nposition = [2, 0, 0]\nfacing = [0, 0, 1]\n[[place]]\nname = "Behind"\nposition = [6, 0, 0]\nfacing = [0, 0, 1]\n'
    command = written(tmp_path, lamp("A", 0), WALL, plan)
    before, behind = figures(run, command)["places"]
    assert before["lx"] == pytest.approx(straight(2, lamps=((0, LUMENS),)), rel=2e-3)
    assert behind["lx"] == 0.0


GLASS = """def Material "Glass"
{
    token outputs:mtlx:surface.connect = </Glass/S.outputs:out>
    def Shader "S"
    {
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
        float inputs:transmission_weight = 1
        float inputs:specular_roughness = 0
        token outputs:out
    }
}
"""
BALL = """def Sphere "NAME" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    double radius = RADIUS
    uniform token orientation = "SIDE"
    rel material:binding = </Glass>
    double3 xformOp:translate = (0, 0, 2.5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
SHELL = "".join(
    BALL.replace("NAME", name).replace("RADIUS", radius).replace("SIDE", side)
    for name, radius, side in (("Outside", "0.1", "rightHanded"), ("Inside", "0.09", "leftHanded"))
)
PANE = """def Mesh "Pane" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 7, 6, 5, 4]
    point3f[] points = [(-2, -2, 2.1), (2, -2, 2.1), (2, 2, 2.1), (-2, 2, 2.1), (-2, -2, 2), (2, -2, 2), (2, 2, 2), (-2, 2, 2)]
    rel material:binding = </Glass>
}
"""


@pytest.mark.parametrize("glass", ["", SHELL, PANE], ids=["bare", "in a shell", "behind a pane"])
def test_light_by_glass_is_left_out_and_told(tmp_path, run, glass):
    plan = '[[place]]\nname = "Below"\nposition = [0, 0, 0]\nfacing = [0, 0, 1]\n'
    command = written(tmp_path, lamp("A", 0), GLASS + glass, plan)
    command.remove("-q")
    done = run(*command, "--json")
    found = json.loads(done.stdout)
    (place,) = found["places"]
    # All there is may be what does not count: that is no zero.
    assert place["lx"] is None if glass else place["lx"] == pytest.approx(straight(0, lamps=((0, LUMENS),)), rel=2e-3)
    assert ("1 of 1 points see luminaires through glass or covers" in done.stderr) == bool(glass) and "integrator" not in done.stderr
    assert len(found["notes"]) == bool(glass)
    (tmp_path / "escape.json").write_text(done.stdout)
    (tmp_path / "required.toml").write_text('[[require]]\narea = "Below"\nquantity = "illuminance"\nat_least = 1\n')
    done = run("verdict", str(tmp_path / "required.toml"), str(tmp_path / "escape.json"), "--json")
    assert [line["verdict"] for line in json.loads(done.stdout)["requirements"]] == ["not_measured" if glass else "met"]


def test_an_area_and_its_words(tmp_path, run):
    plan = '[[area]]\nname = "Hall"\noutline = [[0, -2, 0], [8, -2, 0], [8, 2, 0], [0, 2, 0]]\nspacing = 1\n'
    command = written(tmp_path, lamp("A", 0) + lamp("B", 8), plan=plan)
    (area,) = figures(run, command)["areas"]
    points = [point["position_m"] for point in area["points"]]
    assert len(points) == 8 * 4 and min(x for x, _, _ in points) == 0.5 and max(y for _, y, _ in points) == 1.5
    assert area["min_lx"] == pytest.approx(min(straight(x, y) for x, y, _ in points), rel=3e-3)
    text = run(*command).stdout
    assert "open area Hall" in text and "greatest to least" in text and "/A: 16 cd, 2.50 m above the floor" in text


def test_the_verdict_reads_it(tmp_path, run):
    command = written(tmp_path, lamp("A", 0) + lamp("B", 8))
    (tmp_path / "escape.json").write_text(run(*command, "--json").stdout)
    required = '[[require]]\narea = "Corridor"\nquantity = "{}"\nof = "centre"\n{}\n'
    texts = required.format("min", "at_least = 0.5") + required.format("max_to_min", "at_most = 40") + required.format("min", "at_least = 5")
    (tmp_path / "required.toml").write_text(texts + '[[require]]\narea = "/A"\nquantity = "peak_cd"\nat_most = 500\n')
    done = run("verdict", str(tmp_path / "required.toml"), str(tmp_path / "escape.json"), "--json")
    assert done.returncode == 1
    verdicts = [line["verdict"] for line in json.loads(done.stdout)["requirements"]]
    assert verdicts == ["met", "met", "not_met", "met"]


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        ("", "nothing to measure"),
        ('[[route]]\nname = "r"\nlin = [[0, 0, 0]]\n', "plan.toml:5: unknown field `lin`"),
        ('lights = ["/Nowhere"]\n' + ROUTE, "no light of the stage is at or under '/Nowhere'"),
    ],
)
def test_what_is_no_plan_is_told(tmp_path, run, plan, message):
    command = written(tmp_path, lamp("A", 0), plan=plan)
    done = run(*command)
    assert done.returncode == 1 and message in done.stderr


def wing(tmp_path, cell=(2, 5), peak=600.0):
    """A file of planes 22.5° apart, 300 cd all around but for one place between whole degrees."""
    planes, angles = [22.5 * k for k in range(5)], [2.5 * k for k in range(37)]
    tables = [[peak if (c, v) == cell else 300.0 for v in range(len(angles))] for c in range(len(planes))]
    text = f"IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 {len(angles)} {len(planes)} 1 2 0 0 0\n1 1 10\n{' '.join(map(str, angles))}\n{' '.join(map(str, planes))}\n"
    (tmp_path / "wing.ies").write_text(text + "\n".join(" ".join(map(str, table)) for table in tables) + "\n")


FILED = """def SphereLight "Wing"
{
    asset gonio:photometry:file = @./wing.ies@
    token gonio:lightGroup = "Emergency"
    double3 xformOp:translate = (0, 0, 2.5)
    double xformOp:rotateZ = 13
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]
}
"""


def test_the_greatest_intensity_is_the_files(tmp_path, run):
    """It stands at one of the file's angles, which no even steps meet."""
    wing(tmp_path, cell=(1, 27))
    assert figures(run, written(tmp_path, FILED))["luminaires"][0]["peak_cd"] == pytest.approx(600, rel=1e-4)
    # At the end of the angles that count, between two of the file's.
    wing(tmp_path, cell=(1, 27))
    (lit,) = figures(run, written(tmp_path, FILED, plan="glare_deg = [66, 67]\n" + ROUTE))["luminaires"]
    assert lit["peak_cd"] == pytest.approx(300 + 300 * (1 - 0.5 / 2.5), rel=1e-4)


def test_lamps_of_an_instancer_are_told_apart(tmp_path, run):
    instancer = """def PointInstancer "Row"
{
    rel prototypes = </Row/Lamp>
    int[] protoIndices = [0, 0, 0]
    point3f[] positions = [(0, 0, 2), (1, 0, 3), (2, 0, 4)]
    def SphereLight "Lamp"
    {
        float inputs:radius = 0.02
        double gonio:photometry:quantity = 100
        token gonio:photometry:unit = "cd"
        token gonio:lightGroup = "Emergency"
    }
}
"""
    found = figures(run, written(tmp_path, instancer))["luminaires"]
    assert [lit["height_m"] for lit in found] == pytest.approx([2, 3, 4])
    assert [lit["name"].partition("[")[2] for lit in found] == ["0]", "1]", "2]"]
    assert [lit["peak_cd"] for lit in found] == pytest.approx([100] * 3, rel=1e-3)


PANEL = """def Mesh "Panel" (prepend apiSchemas = ["MeshLightAPI"])
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(3, -1, 2.4), (3, 1, 2.4), (4, 1, 2.4), (4, -1, 2.4)]
    float inputs:intensity = 1000
}
"""


def test_surfaces_that_shine_are_told(tmp_path, run):
    command = written(tmp_path, lamp("A", 0), PANEL)
    (note,) = figures(run, command)["notes"]
    assert "'/Panel'" in note and "left out" in note
    done = run(*[word for word in command if word != "-q"])
    assert "left out" in done.stderr + done.stdout


def test_stairs_are_looked_at_from_all_angles(tmp_path, run):
    stairs = ROUTE.replace("[8, 0, 0]", "[8, 0, 1.5]")
    assert figures(run, written(tmp_path, lamp("A", 0), plan=ROUTE))["glare_deg"] == [60, 90]
    assert figures(run, written(tmp_path, lamp("A", 0), plan=stairs))["glare_deg"] == [0, 180]
    assert figures(run, written(tmp_path, lamp("A", 0), plan="glare_deg = [60, 90]\n" + stairs))["glare_deg"] == [60, 90]


def test_lamps_hang_over_the_floor_below_them(tmp_path, run):
    """Two floors one above the other, and a lamp beside which no floor lies lower."""
    upper = lamp("Upper", 4).replace("2.5)", "5.8)")
    under = lamp("Under", 4).replace("2.5)", "-1.0)")
    plan = ROUTE + '[[route]]\nname = "Above"\nline = [[0, 0, 3.2], [8, 0, 3.2]]\nwidth = 2\nspacing = 1\n'
    lit = {lit["name"]: lit["height_m"] for lit in figures(run, written(tmp_path, lamp("Low", 0) + upper + under, plan=plan))["luminaires"]}
    assert lit == {"/Low": pytest.approx(2.5), "/Upper": pytest.approx(2.6), "/Under": None}
    text = run(*written(tmp_path, lamp("Low", 0) + under, plan=ROUTE)).stdout
    assert "no route or area of the plan lies below it" in text


def test_the_plans_maintenance_stands_in_for_the_lights_own(tmp_path, run):
    own = lamp("A", 0).replace('token gonio:photometry:unit', 'float gonio:photometry:maintenanceFactor = 0.7\n    token gonio:photometry:unit')
    for plan, factor in ((ROUTE, 0.7), ("maintenance_factor = 0.8\n" + ROUTE, 0.8)):
        found = figures(run, written(tmp_path, own, plan=plan))
        assert found["routes"][0]["centre"]["max_lx"] == pytest.approx(factor * straight(0, lamps=((0.0, LUMENS),)), rel=2e-3)
        # Nobody may be dazzled by new lamps either.
        assert found["luminaires"][0]["peak_cd"] == pytest.approx(LUMENS / (4 * math.pi), rel=1e-3)

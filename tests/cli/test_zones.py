"""`gonio zones`: closed forms of bare lamps on tasks, walls and the ceiling, cylinders, stages of other units, plans that are none, and the verdict."""

import json
import math

import pytest

CANDELA = 400.0
# A lamp over the middle of a room of 6 by 4 by 3 m.
LAMP = (3.0, 2.0, 2.5)
HEAD = """#usda 1.0
(
    upAxis = "AXIS"
    metersPerUnit = UNIT
)
def Mesh "Far"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-9000, -9000, -9000), (9000, -9000, -9000), (9000, -9000, 9000), (-9000, -9000, 9000)]
    color3f[] primvars:displayColor = [(0, 0, 0)]
}
def DomeLight "Sky"
{
    float inputs:intensity = 1000
}
def SphereLight "Lamp"
{
    float inputs:radius = 0.01
    double gonio:photometry:quantity = LUMENS
    token gonio:photometry:unit = "lm"
    token gonio:lightGroup = "Ceiling"
    double3 xformOp:translate = (PLACE)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
MORE
"""
ROOM = """[[room]]
name = "Office"
floor = [[0, 0, 0], [6, 0, 0], [6, 4, 0], [0, 4, 0]]
height = 3
"""
DESK = """[[task]]
name = "Desk"
outline = [[1, 1, 0.75], [2.6, 1, 0.75], [2.6, 1.8, 0.75], [1, 1.8, 0.75]]
"""


def written(tmp_path, plan, axis="Z", unit=1.0, more=""):
    x, y, z = (part / unit for part in LAMP)
    place = f"{x}, {y}, {z}" if axis == "Z" else f"{x}, {z}, {-y}"
    lumens = 4 * math.pi * CANDELA
    stage = HEAD.replace("AXIS", axis).replace("UNIT", str(unit)).replace("LUMENS", str(lumens)).replace("PLACE", place).replace("MORE", more)
    (tmp_path / "stage.usda").write_text(stage)
    (tmp_path / "plan.toml").write_text(plan)
    return ["zones", str(tmp_path / "stage.usda"), "--plan", str(tmp_path / "plan.toml"), "--spp", "64"]


def figures(run, command):
    done = run(*command, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def straight(point, normal=(0, 0, 1)):
    """E = I cos / d² of the bare lamp, lx."""
    way = [a - b for a, b in zip(LAMP, point, strict=True)]
    square = sum(part * part for part in way)
    return CANDELA * max(0.0, sum(a * b for a, b in zip(way, normal, strict=True))) / square**1.5


def round_about(point):
    """The mean over the side of a small upright cylinder: I sin / (π d²)."""
    x, y, z = (a - b for a, b in zip(LAMP, point, strict=True))
    return CANDELA * math.hypot(x, y) / math.pi / (x * x + y * y + z * z) ** 1.5


def mean(values):
    values = list(values)
    return sum(values) / len(values)


def places(zone):
    return [tuple(point["position_m"]) for point in zone["points"]]


def test_each_zone_has_the_lamps_light(tmp_path, run):
    found = figures(run, written(tmp_path, "maintenance_factor = 0.8\n" + ROOM + DESK))
    desk, office = found["tasks"][0], found["rooms"][0]
    assert desk["room"] == "Office" and found["maintenance_factor"] == 0.8
    for zone in (desk["task"], desk["surround"], office["background"]):
        for point in zone["points"]:
            assert point["lx"] == pytest.approx(0.8 * straight(point["position_m"]), rel=1e-3)
    assert desk["task"]["average_lx"] == pytest.approx(0.8 * mean(map(straight, places(desk["task"]))), rel=1e-3)
    inwards = ((0, 1, 0), (-1, 0, 0), (0, -1, 0), (1, 0, 0))
    walls = [mean(straight(place, normal) for place in places(wall)) for wall, normal in zip(office["each_wall"], inwards, strict=True)]
    assert [wall["average_lx"] for wall in office["each_wall"]] == pytest.approx([0.8 * lx for lx in walls], rel=1e-3)
    # All walls together by their sizes.
    assert office["walls"]["average_lx"] == pytest.approx(0.8 * (6 * (walls[0] + walls[2]) + 4 * (walls[1] + walls[3])) / 20, rel=1e-3)
    # The lamp hangs half a metre below the ceiling.
    assert office["ceiling"]["average_lx"] == pytest.approx(0.8 * mean(straight(p, (0, 0, -1)) for p in places(office["ceiling"])), rel=1e-3)
    cylinders = places(office["cylindrical"])
    # A meter draws a side of the cylinder for each sample.
    within = 5 * office["cylindrical"]["average_error_lx"]
    assert 0 < within < 1 and office["cylindrical"]["average_lx"] == pytest.approx(0.8 * mean(map(round_about, cylinders)), abs=within)
    ratio = mean(map(round_about, cylinders)) / mean(map(straight, cylinders))
    assert office["modelling"] == pytest.approx(ratio, abs=5 * office["modelling_error"])
    least, average = (desk["surround"][f"{key}_lx"] for key in ("min", "average"))
    assert desk["surround"]["u0"] == pytest.approx(least / average)


def test_centimetres_and_y_up_are_the_same_room(tmp_path, run):
    # Where Y is up the plan's second coordinate is height, and its third grows to the other side.
    turned = "[[room]]\nname = 'Office'\nfloor = [[0, 0, 0], [6, 0, 0], [6, 0, -4], [0, 0, -4]]\nheight = 3\n"
    level = figures(run, written(tmp_path, ROOM))["rooms"][0]
    upright = figures(run, written(tmp_path, turned, "Y", 0.01))["rooms"][0]
    for zone in ("background", "walls", "ceiling", "cylindrical"):
        within = 5 * level[zone]["average_error_lx"] + 1e-3 * level[zone]["average_lx"]
        assert upright[zone]["average_lx"] == pytest.approx(level[zone]["average_lx"], abs=within), zone


SLAB = """def Mesh "Floor"
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 1, 2, 3, 1, 8, 9, 2, 7, 6, 5, 4, 0, 4, 5, 1, 8, 1, 5, 6, 2, 9, 6, 7, 3, 2, 7, 4]
    point3f[] points = [(0, 0, 0), (2, 0, 0), (2, 4, 0), (0, 4, 0), (0, 0, -1), (2, 0, -1), (6, 4, -1), (0, 4, -1), (6, 0, 0), (6, 4, 0)]
}
def Xform "Area"
{
    double2 gonio:grid:size = (6, 4)
    double gonio:grid:height = 0.75
    double3 xformOp:translate = (3, 2, 0)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def test_floors_are_surfaces_and_grids_of_the_stage(tmp_path, run):
    typed = figures(run, written(tmp_path, ROOM, more=SLAB))["rooms"][0]
    for name in ("/Floor", "Floor", "Area"):
        room = ROOM.replace("floor = [[0, 0, 0], [6, 0, 0], [6, 4, 0], [0, 4, 0]]", f'surface = "{name}"')
        found = figures(run, written(tmp_path, room, more=SLAB))["rooms"][0]
        for zone in ("background", "walls", "ceiling"):
            assert len(found[zone]["points"]) == len(typed[zone]["points"])
            assert found[zone]["average_lx"] == pytest.approx(typed[zone]["average_lx"], rel=1e-3)


@pytest.mark.parametrize(
    ("name", "told"),
    [("Roof", "surface 'Roof' is no grid and no surface of the stage"), ("Upright", "surface 'Upright' is level nowhere"), ("Desk", "may be any of /A/Desk, /B/Desk")],
)
def test_surfaces_that_are_no_floor_are_told(tmp_path, run, name, told):
    quad = """def Mesh "{name}"
{{
    int[] faceVertexCounts = [3]
    int[] faceVertexIndices = [0, 1, 2]
    point3f[] points = [(0, 0, 0), (1, 0, 0), (0, {y}, {z})]
}}
"""
    two = "".join(f'def Xform "{parent}"\n{{\n{quad.format(name="Desk", y=1, z=0)}}}\n' for parent in "AB")
    room = ROOM.replace("floor = [[0, 0, 0], [6, 0, 0], [6, 4, 0], [0, 4, 0]]", f'surface = "{name}"')
    done = run(*written(tmp_path, room, more=two + quad.format(name="Upright", y=0, z=1)))
    assert done.returncode == 1 and told in done.stderr, done.stderr


def test_lights_are_chosen_and_told(tmp_path, run):
    glow = """def Mesh "Panel"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(0, 0, 2.9), (0, 1, 2.9), (1, 1, 2.9), (1, 0, 2.9)]
    rel material:binding = </Glow>
}
def Material "Glow"
{
    token outputs:surface.connect = </Glow/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:emissiveColor = (9, 9, 9)
        token outputs:surface
    }
}
"""
    done = run(*written(tmp_path, 'groups = ["Ceiling"]\n' + DESK, more=glow))
    assert done.returncode == 0 and "task Desk" in done.stdout and "U0" in done.stdout
    assert "surfaces that shine are left out" in done.stderr and "'Desk' lies in no room" in done.stderr
    wrong = run(*written(tmp_path, 'groups = ["Wall"]\n' + DESK))
    assert wrong.returncode == 1 and "no light group 'Wall', expected one of Ceiling" in wrong.stderr


def test_the_verdict_reads_it(tmp_path, run):
    done = run(*written(tmp_path, ROOM + DESK), "--json")
    (tmp_path / "rooms.json").write_text(done.stdout)
    rows = (
        ("Desk", "mean", "task", "at_least = 1", "met"),
        ("Desk", "u0", "surround", "at_least = 0.99", "not_met"),
        ("Office", "mean", "walls", "at_least = 1", "met"),
        ("Office", "min", "wall 2", "at_least = 1", "met"),
        ("Office", "average", "ceiling", "at_least = 5000", "not_met"),
        ("Office", "mean", "cylindrical", "at_least = 1", "met"),
        ("Desk", "modelling", None, "at_most = 9", "met"),
    )
    lines = [
        f'[[require]]\narea = "{area}"\nquantity = "{quantity}"\n' + (f'of = "{of}"\n' if of else "") + f"{bound}\n" for area, quantity, of, bound, _ in rows
    ]
    (tmp_path / "required.toml").write_text('title = "Rooms"\n' + "".join(lines))
    judged = run("verdict", str(tmp_path / "required.toml"), str(tmp_path / "rooms.json"), "--json")
    assert judged.returncode == 1, judged.stderr
    assert [row["verdict"] for row in json.loads(judged.stdout)["requirements"]] == [verdict for *_, verdict in rows]


@pytest.mark.parametrize(
    ("plan", "message"),
    [
        ("", "nothing to measure, expected [[room]] or [[task]]"),
        (ROOM.replace("height", "hight"), "plan.toml:4: unknown field `hight`"),
        (ROOM + DESK.replace("1.8, 0.75]]", "1.8, 0.9]]"), "task 'Desk': outline wants three corners at least that lie in one plane"),
        (ROOM + DESK + "room = 'Hall'\n", "task 'Desk' is of room 'Hall', expected one of Office"),
    ],
)
def test_what_is_no_plan_is_told(tmp_path, run, plan, message):
    done = run(*written(tmp_path, plan))
    assert done.returncode == 1 and message in done.stderr and done.stderr.count("\n") == 1, done.stderr

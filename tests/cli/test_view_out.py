"""`gonio view-out` and `gonio.view_out`: sight angles, distances and layers of made rooms against closed forms."""

import json
from math import atan, atan2, degrees, radians, sqrt, tan

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

# A room from x = -4 to 4, y = 0 to 8, z = 0 to 3, windows in the wall y = 0, which looks to -Y.
WIDE, DEEP, HIGH = 4.0, 8.0, 3.0
EYE = 1.2
# Degrees from ray to ray, and what two edges of an opening may lack or have too much.
STEP = 0.5
MATERIALS = """def Material "Glass" {
    token outputs:mtlx:surface.connect = </Glass/Surface.outputs:surface>
    def Shader "Surface" {
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
        float inputs:transmission_weight = 1
        bool inputs:geometry_thin_walled = THIN
        float inputs:specular_roughness = ROUGH
        token outputs:surface
    }
}
"""


def quad(name, points, material=None):
    binding = f"    rel material:binding = </{material}>\n" if material else ""
    return mesh(name, [points], binding)


def mesh(name, faces, binding=""):
    points = ", ".join(str(tuple(float(x) for x in point)) for face in faces for point in face)
    return f"""def Mesh "{name}" {{
    int[] faceVertexCounts = {[4] * len(faces)}
    int[] faceVertexIndices = {list(range(4 * len(faces)))}
    point3f[] points = [{points}]
{binding}}}
"""


def upright(y, x0, x1, z0, z1):
    return [(x0, y, z0), (x1, y, z0), (x1, y, z1), (x0, y, z1)]


def level(z, x0, x1, y0, y1):
    return [(x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z)]


def side(x, y0, y1, z0, z1):
    return [(x, y0, z0), (x, y1, z0), (x, y1, z1), (x, y0, z1)]


def holed(y, windows, x0=-WIDE, x1=WIDE, z1=HIGH):
    """A wall with windows (left, right, sill, head), which are all as high."""
    if not windows:
        return [upright(y, x0, x1, 0, z1)]
    sill, head = windows[0][2:]
    faces = [upright(y, x0, x1, 0, sill), upright(y, x0, x1, head, z1)]
    edges = [x0, *(edge for window in sorted(windows) for edge in window[:2]), x1]
    return faces + [upright(y, left, right, sill, head) for left, right in zip(edges[::2], edges[1::2])]


def room(windows, pane="Glass", more="", thin=1, rough=0):
    shell = [
        *holed(0, windows), upright(DEEP, -WIDE, WIDE, 0, HIGH), side(-WIDE, 0, DEEP, 0, HIGH), side(WIDE, 0, DEEP, 0, HIGH),
        level(HIGH, -WIDE, WIDE, 0, DEEP),
    ]
    panes = "".join(quad(f"Window{n}", upright(0, *window), pane) for n, window in enumerate(windows)) if pane else ""
    floor = quad("Floor", level(0, -WIDE, WIDE, 0, DEEP))
    glass = MATERIALS.replace("THIN", str(thin)).replace("ROUGH", str(rough))
    return mesh("Shell", shell) + floor + panes + more + glass


def facade(distance, height=500.0, half=20000.0):
    return quad("Facade", upright(-distance, -half, half, -10, height))


LAWN = quad("Lawn", level(-0.01, -20000, 20000, -20000, -0.3))


@pytest.fixture
def stage(tmp_path):
    def write(prims, up="Z"):
        path = tmp_path / "room.usda"
        path.write_text(f'#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "{up}"\n)\n{prims}')
        return path

    return write


def found(run, *arguments):
    told = run("view-out", *arguments, "--json", "--quiet")
    assert told.returncode == 0, told.stderr
    return json.loads(told.stdout)


def seen(run, path, *arguments, at=(0, 4, EYE)):
    return found(run, path, "--at", ",".join(map(str, at)), *arguments)["meters"][0]


def window(width, sill=0.9, head=2.1):
    return (-width / 2, width / 2, sill, head)


@pytest.mark.parametrize(("width", "distance"), [(1.0, 4.0), (2.0, 4.0), (2.0, 1.0), (5.0, 2.5), (0.6, 7.5)])
def test_a_window_before_the_eye(run, stage, width, distance):
    view = seen(run, stage(room([window(width)])), at=(0, distance, EYE))
    expected = 2 * degrees(atan(width / 2 / distance))
    assert view["sight_angle_deg"] == pytest.approx(expected, abs=STEP) and view["widest_deg"] == view["sight_angle_deg"]


def test_a_finer_step_is_nearer_to_the_closed_form(run, stage):
    view = seen(run, stage(room([window(2.0)])), "--step", 0.1)
    assert view["sight_angle_deg"] == pytest.approx(2 * degrees(atan(0.25)), abs=0.1)


def test_windows_aside_add_up(run, stage):
    windows = [(-3.0, -2.0, 0.9, 2.1), (0.5, 2.5, 0.9, 2.1)]
    eye = (-1.0, 3.0, EYE)
    view = seen(run, stage(room(windows)), at=eye)
    parts = [degrees(atan2(right - eye[0], eye[1]) - atan2(left - eye[0], eye[1])) for left, right, *_ in windows]
    assert view["sight_angle_deg"] == pytest.approx(sum(parts), abs=2 * STEP)
    assert view["widest_deg"] == pytest.approx(max(parts), abs=STEP)


@pytest.mark.parametrize(("sill", "head", "layers"), [(1.6, 2.6, ["sky"]), (0.2, 0.9, ["ground"]), (0.6, 2.0, ["sky", "ground"])])
def test_sills_above_the_eye_and_heads_below_it(run, stage, sill, head, layers):
    """The width on the plan counts, wherever the window is; without surroundings there is no landscape."""
    view = seen(run, stage(room([window(3.0, sill, head)], more=LAWN)), at=(0, 2, EYE))
    assert view["sight_angle_deg"] == pytest.approx(2 * degrees(atan(0.75)), abs=STEP)
    assert view["layers"] == layers and view["en17037_level"] == "below the minimum"
    assert view["distance_m"] == 5000


@pytest.mark.parametrize(
    ("distance", "expected"),
    [(5.9, "below the minimum"), (6.0, "minimum"), (19.9, "minimum"), (20.0, "medium"), (49.9, "medium"), (50.0, "high")],
)
def test_distances_to_a_facade(run, stage, distance, expected):
    """Across the window it is the same in all directions."""
    view = seen(run, stage(room([window(4.0)], more=facade(distance))), at=(0, 2, EYE))
    assert view["distances_m"] == pytest.approx([distance] * 5, rel=1e-4) and view["distance_m"] == view["distances_m"][2]
    assert view["en17037_levels"]["distance"] == expected and view["en17037_levels"]["layers"] == "minimum"


def test_distances_to_a_wing(run, stage):
    """A wall across the window's, 3 m to the right of the eye and 30 m long: a ray at φ meets it 3 / tan φ - 4 m from the window, beyond its end a facade at 60 m."""
    wing = quad("Wing", side(3, -30, -0.5, -10, 500))
    view = seen(run, stage(room([window(6.0)], more=wing + facade(60.0))), "--step", 0.1, at=(0, 4, EYE))
    azimuths = np.radians(np.arange(-degrees(atan(0.75)), degrees(atan(0.75)), 0.1))
    at_wing = np.where(azimuths > 0, 3 / np.tan(azimuths) - 4, 60.0)
    # Before the wing there is a gap of half a metre. What is nearer along the ray than a metre is the building's own.
    there = np.sort(np.minimum(at_wing, 60.0)[(at_wing / np.cos(azimuths) >= 1) | (at_wing < 0.5)])
    there[(there >= 30) | (there < 0.5)] = 60.0
    there.sort()
    expected = [there[quarter * (len(there) - 1) // 4] for quarter in range(5)]
    assert view["distances_m"] == pytest.approx(expected, rel=0.03)
    assert view["sight_angle_deg"] == pytest.approx(0.1 * len(there), abs=0.2)


def rectangle(width, low, high, distance):
    """The solid angle of a rectangle that the eye looks straight at, from heights below and above it."""
    corner = lambda a, b: atan(a * b / (distance * sqrt(a * a + b * b + distance * distance)))
    return 2 * (corner(width / 2, high) - corner(width / 2, low))


@pytest.mark.parametrize(("roof", "sky"), [(-0.2, True), (0.2, False)])
@pytest.mark.parametrize(("sill", "ground"), [(-0.06, True), (0.06, False)])
def test_layers_by_their_elevations(run, stage, roof, sky, sill, ground):
    """A facade of 30 m: sky is seen where its roof is below the ray by the window's head, ground where its foot is above that by the sill."""
    eye, length, head = 3.0, 30.0, 2.2
    whole = eye + length
    edge = EYE - EYE * eye / whole
    top = EYE + (head - EYE) * whole / eye
    width = 2.0
    prims = room([window(width, edge + sill, head)], more=facade(length, top + roof) + quad("Lawn", level(0.0, -20000, 20000, -length, -0.3)))
    view = seen(run, stage(prims), "--step", 0.1, at=(0, eye, EYE))
    assert view["layers"] == [name for name, there in (("sky", sky), ("landscape", True), ("ground", ground)) if there]
    assert view["en17037_levels"]["layers"] == ("minimum", "medium", "high")[sky + ground]
    expected = rectangle(width, edge + sill - EYE, head - EYE, eye)
    assert sum(view["layers_sr"].values()) == pytest.approx(expected, rel=0.01)
    if sky:
        above = rectangle(width, (top + roof - EYE) * eye / whole, head - EYE, eye)
        assert view["layers_sr"]["sky"] == pytest.approx(above, rel=0.15)


def test_an_open_hole_is_a_view_and_a_doorway_is_none(run, stage):
    """Behind the door lies a room without windows; the facade counts from the wall's inner face on."""
    windows = [window(2.0)]
    plain = seen(run, stage(room(windows, more=facade(20.0))), at=(0, 4, EYE))
    hole = seen(run, stage(room(windows, pane=None, more=facade(20.0))), at=(0, 4, EYE))
    assert hole["sight_angle_deg"] == plain["sight_angle_deg"] == pytest.approx(2 * degrees(atan(0.25)), abs=STEP)
    assert hole["distance_m"] == pytest.approx(plain["distance_m"], abs=0.15) and hole["layers"] == plain["layers"]
    beyond = [
        *holed(-5, []), side(-WIDE, -5, 0, 0, HIGH), side(WIDE, -5, 0, 0, HIGH), level(HIGH, -WIDE, WIDE, -5, 0), level(0, -WIDE, WIDE, -5, 0),
    ]
    inner = seen(run, stage(room(windows, pane=None, more=mesh("Beyond", beyond))), at=(0, 4, EYE))
    assert inner["sight_angle_deg"] == 0 and inner["distances_m"] is None and inner["layers"] == []


def test_partitions_of_glass_are_no_openings_and_are_seen_through(run, stage):
    """A corridor 3 m wide before the glazed wall: without a window there is no view, with one it is that window's."""
    corridor = [side(-WIDE, -3, 0, 0, HIGH), side(WIDE, -3, 0, 0, HIGH), level(HIGH, -WIDE, WIDE, -3, 0), level(0, -WIDE, WIDE, -3, 0)]
    partition = [window(6.0, 0.5, 2.5)]
    outer = [window(2.0)]
    dark = room(partition, more=mesh("Corridor", corridor + holed(-3, [])) + facade(20))
    assert seen(run, stage(dark), at=(0, 4, EYE))["sight_angle_deg"] == 0
    glazed = mesh("Corridor", corridor + holed(-3, outer)) + quad("Outer", upright(-3, *outer[0]), "Glass")
    view = seen(run, stage(room(partition, more=glazed + facade(23.0))), at=(0, 4, EYE))
    assert view["sight_angle_deg"] == pytest.approx(2 * degrees(atan(1 / 7)), abs=STEP)
    assert view["distances_m"][0] == pytest.approx(20.0, rel=1e-3)


def test_glazing_that_is_clear_and_that_is_not(run, stage):
    windows = [window(2.0)]
    angle = 2 * degrees(atan(0.25))
    panes = "".join(quad(f"Sheet{n}", upright(-0.016 * n, *windows[0]), "Glass") for n in (1, 2))
    far = {"more": facade(20.0)}
    triple = seen(run, stage(room(windows, more=panes + facade(20.0))))
    assert triple["sight_angle_deg"] == pytest.approx(angle, abs=STEP)
    assert triple["distances_m"][0] == pytest.approx(20.0, abs=0.05)
    assert seen(run, stage(room(windows, rough=0.5, **far)))["sight_angle_deg"] == 0
    # A solid of 6 mm, faces all around.
    x0, x1, z0, z1 = windows[0]
    back = [upright(-0.006, x0, x1, z0, z1)[::-1], upright(0, x0, x1, z0, z1)]
    rim = [level(z0, x0, x1, -0.006, 0)[::-1], level(z1, x0, x1, -0.006, 0), side(x0, -0.006, 0, z0, z1), side(x1, -0.006, 0, z0, z1)[::-1]]
    solid = mesh("Pane", back + rim, "    rel material:binding = </Glass>\n")
    view = seen(run, stage(room(windows, pane=None, thin=0, more=solid + facade(20.0))))
    assert view["sight_angle_deg"] == pytest.approx(angle, abs=STEP) and view["distances_m"][0] == pytest.approx(20.0, abs=0.05)


def test_the_glass_of_the_house_across_ends_the_view(run, stage):
    """Behind it is a room whose rear wall is 8 m further."""
    across = [upright(-18, -50, 50, -1, 60), side(-50, -18, -10, -1, 60), side(50, -18, -10, -1, 60), level(60, -50, 50, -18, -10), level(-1, -50, 50, -18, -10)]
    prims = mesh("Across", across) + quad("Glazing", upright(-10, -50, 50, -1, 60), "Glass")
    for pane in ("Glass", None):
        view = seen(run, stage(room([window(2.0)], pane=pane, more=prims)))
        assert view["distances_m"][0] == pytest.approx(10.0, abs=0.15) and view["layers"] == ["landscape"]


def test_the_buildings_own_parts_are_no_view(run, stage):
    """A blind 0.4 m before the window hides it; 1.5 m off it is landscape, unless --nearest says that it is the building's."""
    blind = lambda y: quad("Blind", upright(-y, -30, 30, -10, 30))
    assert seen(run, stage(room([window(2.0)], more=blind(0.4))))["sight_angle_deg"] == 0
    path = stage(room([window(2.0)], more=blind(1.5)))
    assert seen(run, path)["layers"] == ["landscape"]
    assert seen(run, path, "--nearest", 2)["sight_angle_deg"] == 0


def test_openings_that_are_named(run, stage):
    windows = [(-3.0, -2.0, 0.9, 2.1), (1.0, 3.0, 0.9, 2.1)]
    path = stage(room(windows, more=facade(20.0)))
    view = seen(run, path, "--openings", "/Window1")
    assert view["sight_angle_deg"] == pytest.approx(degrees(atan(3 / 4) - atan(1 / 4)), abs=STEP)
    both = seen(run, path, "--openings", "/Window0", "--openings", "/Window1")
    assert both["sight_angle_deg"] == seen(run, path)["sight_angle_deg"]


def test_ground_by_its_slope_or_by_name(run, stage):
    """A slope that falls away by 40° is landscape below the horizon, one by 20° ground, and whichever is named."""
    def slope(angle):
        far, fall = 200.0, 200.0 * tan(radians(angle))
        return quad("Slope", [(-400, -2, -0.5), (400, -2, -0.5), (400, -2 - far, -0.5 - fall), (-400, -2 - far, -0.5 - fall)])

    low = [window(2.0, 0.1, 1.1)]
    at = (0, 1, EYE)
    assert seen(run, stage(room(low, more=slope(20))), at=at)["layers"] == ["ground"]
    path = stage(room(low, more=slope(40)))
    assert "landscape" in seen(run, path, at=at)["layers"]
    assert seen(run, path, "--ground", "/Slope", at=at)["layers"] == ["ground"]


def test_an_open_horizon_is_landscape_where_somebody_says_so(run, stage):
    path = stage(room([window(2.0, 0.6, 2.2)]))
    told = run("view-out", path, "--at", f"0,3,{EYE}")
    assert "see an open horizon and no landscape" in told.stderr and "below the minimum" in told.stdout
    assert seen(run, path)["layers"] == ["sky", "ground"]
    view = seen(run, path, "--horizon", 3)
    assert view["layers"] == ["sky", "landscape", "ground"] and view["en17037_level"] == "medium"


def test_y_up_is_the_same_room(run, stage):
    room_up = room([window(2.0)], more=facade(20.0))
    view = seen(run, stage(room_up))
    turned = stage('def Xform "All" {\n    double xformOp:rotateX = -90\n    uniform token[] xformOpOrder = ["xformOp:rotateX"]\n' + room_up.replace("</Glass", "</All/Glass") + "}\n", up="Y")
    other = seen(run, turned, at=(0, EYE, -4))
    assert other["sight_angle_deg"] == pytest.approx(view["sight_angle_deg"], abs=STEP) and other["layers"] == view["layers"]
    assert other["distance_m"] == pytest.approx(view["distance_m"], rel=0.01)


def test_rooms_by_three_quarters_of_their_points(run, stage, tmp_path):
    """The level by hand: all points' sight angles by closed form, a facade 25 m off."""
    path = stage(room([window(4.0)], more=facade(25.0)))
    folder = tmp_path / "out"
    of_room = found(run, path, "--grid", "/Floor", "--spacing", 1, "-o", folder)
    grid = of_room["grids"][0]
    assert (grid["columns"], grid["rows"], grid["count"]) == (8, 8, 64)
    angles = []
    for point in grid["points"]:
        x, y, z = point["position_m"]
        assert z == pytest.approx(EYE)
        angles.append(degrees(atan2(2 - x, y) - atan2(-2 - x, y)))
        assert point["sight_angle_deg"] == pytest.approx(angles[-1], abs=STEP)
    angles = np.array(angles)
    for name, limit in (("minimum", 14), ("medium", 28), ("high", 54)):
        near = (abs(angles - limit) < STEP).mean()
        assert grid["shares"]["sight_angle"][name] == pytest.approx((angles >= limit).mean(), abs=near + 1e-9)
    assert grid["sight_angle_deg"] == pytest.approx(np.sort(angles)[::-1][47], abs=STEP)
    levels = grid["en17037_levels"]
    by_hand = [name for name, limit in (("minimum", 14), ("medium", 28), ("high", 54)) if (angles >= limit).mean() >= 0.75][-1]
    assert levels["sight_angle"] == by_hand == "medium" and levels["distance"] == "medium" and levels["layers"] == "minimum"
    assert grid["en17037_level"] == "minimum"
    names = ["distance.png", "level.png", "points.csv", "sight_angle.png"]
    assert sorted(file.name for file in folder.iterdir()) == names
    rows = (folder / "points.csv").read_text().splitlines()
    assert len(rows) == 65 and rows[1].startswith("/Floor,0,0,") and rows[1].endswith(",below the minimum") and rows[4].endswith(",medium")


def test_tables_for_people(run, stage):
    path = stage(room([window(4.0)], more=facade(25.0)))
    lines = run("view-out", path, "--grid", "/Floor", "--spacing", 2, "--quiet").stdout.splitlines()
    assert lines[0].startswith("/Floor: view out, 4 × 4 points (16 there)")
    assert [line.split()[0] for line in lines[1:]] == ["75", "sight", "outside", "layers", "EN"]
    one = run("view-out", path, "--at", f"0,2,{EYE}", "--at", "0,2,2.9", "--quiet").stdout.splitlines()
    assert "sight angle 90.0°" in one[0] and "EN 17037: minimum" in one[0]
    assert len(one) == 2


def test_eyes_over_grids_and_sensors_of_the_stage(run, stage):
    own = '    custom token gonio:grid:quantity = "illuminance"\n    custom double gonio:grid:height = 0.75\n    custom double gonio:grid:spacing = 2\n'
    prims = room([window(4.0)]).replace('def Mesh "Floor" {\n', 'def Mesh "Floor" {\n' + own)
    path = stage(prims)
    height = lambda *arguments: found(run, path, *arguments)["grids"][0]["points"][0]["position_m"][2]
    assert height() == pytest.approx(0.75) and height("--raise", 0.45) == pytest.approx(EYE)
    assert height("--grid", "/Floor") == pytest.approx(EYE) and height("--grid", "/Floor", "--height", 1.7) == pytest.approx(1.7)


def test_same_bits_on_any_threads_and_twice(run, stage):
    path = stage(room([window(4.0)], more=facade(25.0) + LAWN))
    runs = [run("view-out", path, "--grid", "/Floor", "--spacing", 4, "--json", "--quiet", "-j", threads).stdout for threads in (1, 2, 2)]
    assert runs[0] == runs[1] == runs[2]


def test_python_says_the_same(run, stage):
    path = stage(room([window(4.0)], more=facade(25.0) + LAWN))
    eyes = [(0.0, 2.0, EYE), (1.5, 5.0, EYE)]
    of_command = found(run, path, *(word for eye in eyes for word in ("--at", ",".join(map(str, eye)))))["meters"]
    view = gonio.view_out(gonio.load_usd(path), eyes)
    for key, name in (("sight_angle", "sight_angle_deg"), ("widest", "widest_deg"), ("distance", "distance_m"), ("layers", "layers"), ("level", "en17037_level")):
        assert view[key] == [meter[name] for meter in of_command]
    assert [list(distances) for distances in view["distances"]] == [meter["distances_m"] for meter in of_command]
    assert view["area"]["level"] == min(view["level"], key=["below the minimum", "minimum", "medium", "high"].index)
    assert view["area"]["shares"]["layers"]["minimum"] == 1
    with pytest.raises(gonio.SettingError, match="has no surface"):
        gonio.view_out(gonio.load_usd(path), eyes, ground=["/Nowhere"])
    with pytest.raises(gonio.Cancelled):
        gonio.view_out(gonio.load_usd(path), eyes * 50, cancelled=lambda: True)


@pytest.mark.parametrize(
    ("arguments", "what"),
    [
        (("--step", 0.01), "expected 0.1 to 5"),
        (("--field", 95), "expected the step to 90"),
        (("--horizon", 70), "expected 0 to the field of 60"),
        (("--nearest=-1",), "expected 0 to 5000"),
        (("--ground", "/Nowhere"), "'/Nowhere' has no surface"),
        (("--openings", "/Floor"), "nobody sees through /Floor"),
    ],
)
def test_bad_input_is_told(run, stage, arguments, what):
    told = run("view-out", stage(room([window(2.0)])), "--at", f"0,2,{EYE}", *arguments)
    assert told.returncode != 0 and what in told.stderr


def test_who_asks_for_nothing_is_told(run, stage):
    told = run("view-out", stage(room([window(2.0)])))
    assert told.returncode != 0 and "--at X,Y,Z" in told.stderr

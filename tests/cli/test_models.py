"""Honeybee models and Radiance scenes on the command line, against closed forms."""

import json
import math

import pytest

gonio = pytest.importorskip("gonio")

# The CIE's overcast sky that models without light are lit by, lx on open level ground.
SKY_LUX = 10_000.0


def face(identifier, kind, boundary, condition="Outdoors", **more):
    geometry = {"type": "Face3D", "boundary": boundary}
    condition = {"type": condition}
    return {"type": "Face", "identifier": identifier, "face_type": kind, "geometry": geometry, "boundary_condition": condition, "properties": {}, **more}


def black(found):
    found["properties"] = {"radiance": {"modifier": "black"}}
    return found


def model(rooms=(), sensors=(), views=(), modifiers=(), orphaned=()):
    grid = {"type": "SensorGrid", "identifier": "grid", "sensors": [{"pos": pos, "dir": direction} for pos, direction in sensors]}
    radiance = {"type": "ModelRadianceProperties", "sensor_grids": [grid], "views": list(views), "modifiers": list(modifiers)}
    return {
        "type": "Model",
        "identifier": "made",
        "units": "Meters",
        "rooms": [{"type": "Room", "identifier": "room", "faces": list(rooms), "properties": {}}] if rooms else [],
        "orphaned_shades": list(orphaned),
        "properties": {"type": "ModelProperties", "radiance": radiance},
    }


def box(pane):
    """A black box of 4 m by 4 m by 3 m whose whole roof is a pane but for 1 m at each edge."""
    corners = {
        "floor": [[0, 0, 0], [0, 4, 0], [4, 4, 0], [4, 0, 0]],
        "roof": [[0, 0, 3], [4, 0, 3], [4, 4, 3], [0, 4, 3]],
        "south": [[0, 0, 0], [4, 0, 0], [4, 0, 3], [0, 0, 3]],
        "north": [[4, 4, 0], [0, 4, 0], [0, 4, 3], [4, 4, 3]],
        "west": [[0, 4, 0], [0, 0, 0], [0, 0, 3], [0, 4, 3]],
        "east": [[4, 0, 0], [4, 4, 0], [4, 4, 3], [4, 0, 3]],
    }
    kinds = {"floor": "Floor", "roof": "RoofCeiling"}
    faces = {name: black(face(name, kinds.get(name, "Wall"), boundary)) for name, boundary in corners.items()}
    geometry = {"type": "Face3D", "boundary": [[1, 1, 3], [3, 1, 3], [3, 3, 3], [1, 3, 3]]}
    window = {"type": "Aperture", "identifier": "pane", "geometry": geometry, "boundary_condition": {"type": "Outdoors"}}
    faces["roof"]["apertures"] = [{**window, "properties": {"radiance": {"modifier": pane}}}]
    return list(faces.values())


@pytest.fixture
def write(tmp_path):
    def written(content, name="made.hbjson"):
        path = tmp_path / name
        path.write_text(content if isinstance(content, str) else json.dumps(content))
        return path

    return written


def measured(run, path, *arguments):
    found = json.loads(run("measure", path, "--json", "--quiet", "--spp", 4096, *arguments).stdout)
    return [meter["value"] for meter in found["meters"]]


def sky_through(half, height, transmittance):
    """Illuminance in lx, straight under the middle of a square opening, by the overcast sky: ∫ L τ(θ) cos θ dω by a midpoint sum."""
    count, total = 400, 0.0
    zenith = 9.0 * SKY_LUX / (7.0 * math.pi)
    step = 2 * half / count
    for i in range(count):
        for j in range(count):
            x, y = (i + 0.5) * step - half, (j + 0.5) * step - half
            square = x * x + y * y + height * height
            cosine = height / math.sqrt(square)
            total += zenith * (1 + 2 * cosine) / 3 * transmittance(cosine) * cosine**2 / square * step * step
    return total


def pane(transmissivity, index):
    """Transmittance of a pane as Radiance's reference manual and Fresnel have it."""

    def at(cosine):
        inside = math.sqrt(1 - (1 - cosine**2) / index**2)
        tau = transmissivity ** (1 / inside)
        polarised = [((cosine - index * inside) / (cosine + index * inside)) ** 2, ((inside - index * cosine) / (inside + index * cosine)) ** 2]
        return sum(tau * (1 - r) ** 2 / (1 - (r * tau) ** 2) for r in polarised) / 2

    return at


def test_open_ground_has_the_sky(run, write):
    up, north, down = [0, 0, 1], [0, 1, 0], [0, 0, -1]
    values = measured(run, write(model(sensors=[([0, 0, 1], up), ([5, 5, 1], north), ([0, 0, 1], down)])))
    # The overcast sky's vertical illuminance is (3 π + 8) / (14 π) of the level one.
    assert values == pytest.approx([SKY_LUX, SKY_LUX * (3 * math.pi + 8) / (14 * math.pi), 0.0], rel=5e-3, abs=0.01)


@pytest.mark.parametrize("transmissivity, normal", [(0.9584154328610596, 0.88), (0.6975761815384331, 0.64)])
def test_a_pane_passes_what_honeybee_says(run, write, transmissivity, normal):
    clear = {"type": "Glass", "identifier": "clear"} | {f"{c}_transmissivity": transmissivity for c in "rgb"}
    assert pane(transmissivity, 1.52)(1.0) == pytest.approx(normal, abs=5e-4)
    values = [
        measured(run, write(model(box(name), [([2, 2, 0.8], [0, 0, 1])], modifiers=[clear])))[0] for name in ("clear", "air_boundary")
    ]
    expected = [sky_through(1.0, 2.2, of) for of in (pane(transmissivity, 1.52), lambda cosine: 1.0)]
    assert values == pytest.approx(expected, rel=1e-2)


def test_info_and_a_picture(run, write, tmp_path):
    view = {"type": "View", "identifier": "eye", "position": [2, 0.5, 1.5], "direction": [0, 1, 0], "up_vector": [0, 0, 1]}
    path = write(model(box("generic_interior_window_vis_0.88"), views=[view]))
    found = json.loads(run("info", path, "--json").stdout)
    assert (found["up_axis"], found["metres_per_unit"], found["cameras"]) == ("Z", 1.0, ["eye"])
    assert (found["prims"]["Face"], found["prims"]["Aperture"], found["diagnostics"]) == (6, 1, [])
    picture = tmp_path / "room.png"
    told = run("render", path, "-o", picture, "--spp", 4, "--res", 32, 32).stderr
    assert picture.exists() and "there is no light; an even sky lights it" in told


def test_a_box_of_radiance_with_a_lamp(run, write):
    # A lamp of 0.2 m by 0.2 m and 100 W/(sr m²), 2 m above a luxmeter, faces down: E = ∫ L cos² / d² dA, Radiance's 179 lm/W.
    lamp = "void light lamp 0 0 3 100 100 100\nlamp polygon l 0 0 12 -.1 -.1 2  -.1 .1 2  .1 .1 2  .1 -.1 2\n"
    path = write("void plastic black 0 0 5 0 0 0 0 0\n!genbox black room 6 6 3 -i | xform -t -3 -3 -0.5\n" + lamp, "box.rad")
    step, count = 0.01, 20
    middles = [(i + 0.5) * step - 0.1 for i in range(count)]
    expected = sum(17900 * 4 / (x * x + y * y + 4) ** 2 * step * step for x in middles for y in middles)
    (value,) = measured(run, path, "--at", "0,0,0")
    assert value == pytest.approx(expected, rel=1e-2)


def test_the_lamps_back_is_dark(run, write):
    path = write("void light lamp 0 0 3 100 100 100\nlamp polygon l 0 0 12 -.1 -.1 2  -.1 .1 2  .1 .1 2  .1 -.1 2\n", "lamp.rad")
    assert measured(run, path, "--at", "0,0,4", "--normal", "0,0,-1") == [0.0]


@pytest.mark.parametrize(
    "name, text, words",
    [
        ("cut.hbjson", '{"type": "Model", ', "cut.hbjson:1: this is no JSON"),
        ("room.hbjson", '{"type": "Room"}', "expected a honeybee Model"),
        ("nan.hbjson", '{"type": "Model",\n"x": NaN}', "nan.hbjson:2: this is no JSON"),
    ],
)
def test_broken_models(run, write, name, text, words):
    done = run("info", write(text, name), check=False)
    assert done.returncode == 1 and words in done.stderr


def test_commands_are_told_and_never_run(run, write, tmp_path):
    kept = tmp_path / "kept"
    kept.write_text("kept")
    path = write(f"!rm {kept}\nvoid plastic grey 0 0 5 .5 .5 .5 0 0\ngrey sphere s 0 0 4 0 0 0 1\n", "s.rad")
    out = run("info", path).stdout
    assert "s.rad:1" in out and "rm is not run" in out and kept.exists()


@pytest.mark.parametrize("option", [("--variant", "/A{b=c}"), ("--mask", "/A"), ("--frames", "1:2", "-o", "x.####.exr")])
def test_what_only_stages_have(run, write, option):
    done = run("render", write(model(box("black"))), *option, check=False)
    assert done.returncode == 1 and "it is for USD stages" in done.stderr


def test_sensor_grids_are_told_together(run, write):
    """Points of one grid have a mean, a least and a greatest; a single one has none."""
    sensors = [((x, 2.0, 1.5), (0, 0, 1)) for x in (1.5, 2.0, 2.5)]
    path = write(model((), sensors))
    found = json.loads(run("measure", path, "--json", "--quiet", "--spp", 64).stdout)
    values = [meter["value"] for meter in found["meters"]]
    grid = found["sensor_grids"][0]
    assert (grid["name"], grid["quantity"], grid["unit"], grid["points"]) == ("grid", "illuminance", "lx", 3)
    assert grid["average"]["value"] == pytest.approx(sum(values) / 3) and grid["min"]["value"] == min(values)
    assert grid["uniformity_u0"] == pytest.approx(min(values) / (sum(values) / 3))
    text = run("measure", path, "--spp", "64", "--quiet").stdout
    assert "grid: illuminance, 3 points together" in text and "U0" in text
    alone = json.loads(run("measure", write(model((), sensors[:1])), "--json", "--quiet", "--spp", 64).stdout)
    assert alone["sensor_grids"] == []

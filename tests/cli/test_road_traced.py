"""`gonio road` on a measured material, against the path tracer that has the material as its BRDF."""

import json
import math

import numpy
import pytest

gonio = pytest.importorskip("gonio")

CANDELA, SPACING, HEIGHT, OVERHANG, WIDTH = 1000.0, 25.0, 8.0, 0.5, 7.0
IES = "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 60\n0 180\n0\n1000 1000\n"
# So many mounting heights both ways that what is further off does not matter.
REACH = 40
ROAD = f"""[road]
carriageway_width = {WIDTH}
lanes = 2
surface = "asphalt.gbsdf"
luminance_reach = [{REACH}, {REACH}, 5]
[[row]]
luminaire = "lamp.ies"
side = "right"
spacing = {SPACING}
height = {HEIGHT}
overhang = {OVERHANG}
"""


@pytest.fixture(scope="module")
def asphalt():
    """A made-up road: matt, with a broad lobe forward that grows towards grazing light."""
    axes = {"theta_i": numpy.arange(0, 91, 2.5), "theta_o": [0, 60, 85, 88, 89, 90], "delta_phi": numpy.arange(0, 181, 7.5)}
    light, eye, turn = numpy.meshgrid(*(numpy.radians(values) for values in axes.values()), indexing="ij")
    lobe = numpy.exp(-(((math.pi - turn) / 0.6) ** 2)) * numpy.sin(light) ** 4
    return gonio.MeasuredBsdf.from_table(axes, (0.06 * (1 + 4 * lobe * numpy.sin(eye) ** 2))[..., None], bilateral=True)


@pytest.fixture(scope="module")
def found(asphalt, run, tmp_path_factory):
    """What `gonio road` finds."""
    folder = tmp_path_factory.mktemp("road")
    asphalt.write(folder / "asphalt.gbsdf")
    (folder / "lamp.ies").write_text(IES)
    (folder / "road.toml").write_text(ROAD)
    done = run("road", folder / "road.toml", "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def street(asphalt):
    """The road as a scene, z up, with lamps as far as they count."""
    scene = gonio.Scene()
    far = 2 * REACH * HEIGHT
    corners = numpy.array([[-far, -50, 0], [far, -50, 0], [far, 50, 0], [-far, 50, 0]], "f4")
    ground = scene.add_mesh(corners, numpy.array([[0, 1, 2], [0, 2, 3]], "i4"))
    material = scene.put_material({"closures": [{"model": "Measured", "measured": scene.put_measured(asphalt)}]})
    scene.add_instance(ground, [material])
    for number in range(-REACH * 8 // 25 - 2, REACH * 8 // 25 + 4):
        place = [[1, 0, 0, number * SPACING], [0, 1, 0, OVERHANG], [0, 0, 1, HEIGHT], [0, 0, 0, 1]]
        scene.add_light("sphere", lumens=4 * math.pi * CANDELA, radius=0.02, transform=place)
    return scene


def test_luminances_are_those_of_the_path_tracer(asphalt, found):
    scene, seen = street(asphalt), found["observers"][0]
    expected = []
    for y, row in zip(found["luminance_y"], seen["luminance"], strict=True):
        for x, value in zip(found["x"], row, strict=True):
            # As the norm has it: at 1° whatever the distance, from the observer's side.
            turn = math.atan2(y - seen["position"][1], x - seen["position"][0])
            way = [math.cos(turn) * math.cos(math.radians(1)), math.sin(turn) * math.cos(math.radians(1)), -math.sin(math.radians(1))]
            scene.add_meter([a - 5.0 * b for a, b in zip((x, y, 0.0), way, strict=True)], facing=way, quantity="luminance")
            expected.append(value)
    readings = gonio.measure(scene, samples=1024).meters
    got = numpy.array([reading.value for reading in readings])
    assert got == pytest.approx(numpy.array(expected), rel=0.01)
    assert got.mean() == pytest.approx(seen["l_av"], rel=0.002)
    assert got.min() / got.mean() == pytest.approx(seen["uo"], rel=0.01)


def test_its_mean_luminance_coefficient(asphalt, found):
    """Q0 over CIE 144's rectangle, by a sum of other points."""
    x, y = numpy.meshgrid(numpy.arange(-4, 12, 0.08) + 0.04, numpy.arange(-3, 3, 0.08) + 0.04)
    light = numpy.stack([x, y, numpy.ones_like(x)], -1).reshape(-1, 3)
    light /= numpy.linalg.norm(light, axis=1, keepdims=True)
    eye = numpy.broadcast_to([-math.cos(math.radians(1)), 0, math.sin(math.radians(1))], light.shape).copy()
    q = numpy.asarray(asphalt.eval(light, eye))[:, 0] / light[:, 2]
    weight = light[:, 2] ** 3
    assert found["surface"]["q0"] == pytest.approx((q * weight).sum() / weight.sum(), rel=1e-3)
    assert found["surface"]["name"] == "asphalt.gbsdf" and not found["notes"]


@pytest.mark.parametrize(
    ("old", "new", "told"),
    [
        ('"asphalt.gbsdf"', '"asphalt.gbsdf"\nq0 = 0.07', "road.toml:5: [road]: q0 is for r-tables; measured materials keep their own"),
        ('"asphalt.gbsdf"', '"broken.gbsdf"', "broken.gbsdf:2: "),
    ],
)
def test_what_is_wrong_is_told(run, tmp_path, asphalt, old, new, told):
    asphalt.write(tmp_path / "asphalt.gbsdf")
    (tmp_path / "broken.gbsdf").write_text("gbsdf 1\ntable up\n")
    (tmp_path / "lamp.ies").write_text(IES)
    (tmp_path / "road.toml").write_text(ROAD.replace(old, new))
    done = run("road", tmp_path / "road.toml")
    assert done.returncode == 1 and told in done.stderr and done.stderr.count("\n") == 1, done.stderr

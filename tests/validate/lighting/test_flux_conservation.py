"""The flux of each kind of light arrives on the faces of a closed black box: Σ E dA = Φ (CIE 171, 5.4)."""

import math

import confidence
import figures
import numpy
import pytest
from rooms import Room, box_faces, facing

pytestmark = pytest.mark.validate

SECTION = "Flux conservation"
SIZE = (3.0, 4.0, 2.5)
PLACE = (0.4, -0.5, 0.3)
AXES = facing((-0.5, 0.3, -0.8))
GRID = (24, 24)
SAMPLES = 64
LIMIT = 1e-3


def spot_solid_angle(half, blend):
    """∫ smoothstep dω of a spot's cone, by Gauss and Legendre over the cosine."""
    x, w = numpy.polynomial.legendre.leggauss(200)
    cosine = math.cos(half) + (1 - math.cos(half)) * 0.5 * (x + 1)
    t = numpy.clip((cosine - math.cos(half)) / ((1 - math.cos(half)) * blend), 0.0, 1.0)
    return 2 * math.pi * float((w * t * t * (3 - 2 * t)).sum()) * 0.5 * (1 - math.cos(half))


# Name, shape, lumens in a unit of its strength (cd/m², cd for points), changes.
LIGHTS = [
    ("point", "Point", 4 * math.pi, {}),
    ("|cos⁵| about an axis", "Point", 4 * math.pi / 6, {"shaping": {"focus": 5.0}}),
    ("cos⁵ about an axis, half space", "Point", 2 * math.pi / 6, {"shaping": {"focus": 5.0, "cone_angle_deg": 90.0}}),
    ("cone of 30°", "Point", 2 * math.pi * (1 - math.cos(math.radians(30))), {"shaping": {"cone_angle_deg": 30.0}}),
    (
        "spot of 70°, soft",
        "Point",
        spot_solid_angle(math.radians(35), 0.4),
        {"spot": {"angle_deg": 70.0, "blend": 0.4, "stretch": [1.0, 1.0]}},
    ),
    ("rectangle", {"Rectangle": {"width": 0.8, "height": 0.3}}, math.pi * 0.24, {}),
    ("rectangle with a spread of 60°", {"Rectangle": {"width": 0.8, "height": 0.3}}, math.pi * 0.24, {"spread_deg": 60.0}),
    ("disk", {"Disk": {"radius": 0.25}}, math.pi * math.pi * 0.0625, {}),
    ("ellipse", {"Ellipse": {"width": 0.8, "height": 0.3}}, math.pi * math.pi * 0.06, {}),
    ("sphere", {"Sphere": {"radius": 0.2}}, math.pi * 4 * math.pi * 0.04, {}),
    ("sphere of 1 mm", {"Sphere": {"radius": 0.001}}, math.pi * 4 * math.pi * 1e-6, {}),
    ("cylinder", {"Cylinder": {"radius": 0.1, "length": 0.9}}, math.pi * 2 * math.pi * 0.09, {}),
]


def flux_on_faces(room, samples=SAMPLES):
    """Lumens that the six faces get, one value a seed."""
    total = 0.0
    for face in box_faces(SIZE):
        total = total + room.illuminance(face, GRID, samples, averaged=True).mean(axis=(1, 2)) * face.area
    return total


@pytest.mark.parametrize(("name", "shape", "lumens", "changes"), LIGHTS, ids=[light[0] for light in LIGHTS])
def test_a_black_box_gets_the_flux(name, shape, lumens, changes):
    room = Room()
    room.add(*box_faces(SIZE))
    room.light(shape, 1000.0 / lumens, PLACE, AXES, **changes)
    confidence.hold(SECTION, f"{name}, 1000 lm", "closed form", flux_on_faces(room)[:, None], numpy.array([1000.0]), LIMIT)


@pytest.mark.parametrize("shape", [{"Rectangle": {"width": 0.8, "height": 0.3}}, {"Disk": {"radius": 0.25}}], ids=["rectangle", "disk"])
def test_a_light_flush_with_the_ceiling(shape):
    """In the ceiling's own plane it loses nothing to it."""
    room = Room()
    room.add(*box_faces(SIZE))
    area = 0.24 if "Rectangle" in shape else math.pi * 0.0625
    room.light(shape, 1000.0 / (math.pi * area), (0.4, -0.5, SIZE[2] / 2))
    case = f"{next(iter(shape)).lower()} flush with the ceiling, 1000 lm"
    confidence.hold(SECTION, case, "closed form", flux_on_faces(room)[:, None], numpy.array([1000.0]), LIMIT)


def test_no_light_leaks_in():
    """Six rectangles that share nothing but their edges, in the sun and under a sky."""
    room = Room()
    room.add(*box_faces(SIZE))
    room.light({"Distant": {"angle_deg": 0.5}}, 1e9, axes=AXES)
    room.light({"Dome": {"format": "LatLong"}}, 1e4)
    inside = max(float(room.illuminance(face, (64, 64), 64, [1], averaged=True).max()) for face in box_faces(SIZE))
    figures.check(
        figures.Row(
            SECTION,
            "closed box in the sun and under a sky, of the sky's illuminance",
            "no light",
            6 * 64 * 64,
            inside / (math.pi * 1e4),
            0.0,
        )
    )

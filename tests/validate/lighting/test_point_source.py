"""Point sources over 7 × 7 points of a floor and of a wall: E = I(direction) cos / d² (CIE 171, 5.2)."""

import math

import confidence
import numpy
import photometric_file
import pytest
from rooms import Plane, Room, facing

pytestmark = pytest.mark.validate

SECTION = "Point sources"
PLACE = (0.3, -0.2, 1.5)
FLOOR = Plane((0, 0, -1.5), (4, 0, 0), (0, 4, 0))
WALL = Plane((-2, 0, 0), (0, 4, 0), (0, 0, 3))
GRID = (7, 7)
# Nothing is random here: single precision is all that differs.
LIMIT = 2e-5


def expected(plane, intensity):
    """Illuminance of the grid by intensities of directions."""
    to = plane.points(*GRID) - PLACE
    distance = numpy.linalg.norm(to, axis=-1)
    return intensity(to / distance[..., None]) * numpy.maximum(-(to @ plane.normal), 0.0) / distance**3


def hold(case, room, intensity, limit=LIMIT):
    """Floor and wall of a room with one source."""
    planes = (FLOOR, WALL)
    found = numpy.concatenate([room.illuminance(plane, GRID, 4, seeds=[1]).ravel() for plane in planes])
    reference = numpy.concatenate([expected(plane, intensity).ravel() for plane in planes])
    confidence.hold_exact(SECTION, case, "I cos θ / d²", found, reference, limit)


def room_with(strength, **changes):
    room = Room()
    room.add(FLOOR, WALL)
    room.light("Point", strength, PLACE, **changes)
    return room


def test_isotropic():
    hold("isotropic, 1000 lm", room_with(1000 / (4 * math.pi)), lambda w: numpy.full(w.shape[:-1], 1000 / (4 * math.pi)))


@pytest.mark.parametrize("exponent", [1, 2, 8, 30])
def test_powers_of_the_cosine(exponent):
    axis = numpy.array([-0.4, 0.2, -1.0]) / math.sqrt(1.2)
    room = room_with(500.0, axes=facing(axis), shaping={"focus": float(exponent)})
    hold(f"500 cd · cos^{exponent} about a tilted axis", room, lambda w: 500.0 * numpy.abs(w @ axis) ** exponent, 1e-4)


def test_spot():
    axis, half, blend = numpy.array([-0.6, 0.0, -0.8]), math.radians(35), 0.4
    room = room_with(800.0, axes=facing(axis), spot={"angle_deg": 70.0, "blend": blend, "stretch": [1.0, 1.0]})

    def intensity(w):
        x = numpy.clip((w @ axis - math.cos(half)) / ((1 - math.cos(half)) * blend), 0.0, 1.0)
        return 800.0 * x * x * (3 - 2 * x)

    hold("spot of 70° with a soft edge", room, intensity, 1e-4)


@pytest.mark.parametrize(
    "name", ["luminaires/sample1.ldt", "luminaires/sample3.ldt", "shapes/ldt/no_symmetry.ldt", "shapes/ies95/point_opening.ies"]
)
def test_measured_intensities(name, shared):
    path = shared("photometry", *name.split("/"))
    table = photometric_file.read(path)
    room = room_with(1.0, **photometric_file.as_light(path))
    # A direction in single precision is off by 1e-7 rad, on slopes of up to some 100 cd/° of a peak's 1000 cd.
    hold(f"{path.name}, bilinear between its angles", room, table.intensity, 1e-4)

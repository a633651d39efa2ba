"""Light that a sunlit matt plate reflects onto planes that the sun does not reach, free (CIE 171, 5.6) and past an obstruction (5.7)."""

import math
from dataclasses import dataclass

import confidence
import form_factors
import numpy
import pytest
from rooms import Plane, Room, facing

pytestmark = pytest.mark.validate

SECTION = "Diffuse reflection"
LUX = 50_000.0
REFLECTANCE = 0.6
GRID = (7, 7)
UP = numpy.array([0.0, 0.0, 1.0])


@dataclass(frozen=True)
class Case:
    """A plane on which no sun shines, the sun's direction, and plates before it."""

    receiver: Plane
    sun: numpy.ndarray
    plates: tuple[Plane, Plane]


CASES = {
    # The sun comes from behind the wall and over it; the wall's shadow on the ground ends at 0.30 m.
    "wall": Case(
        Plane((0, 0, 1.5), (0, 4, 0), (0, 0, 3)),
        numpy.array([0.1, 0.0, -math.sqrt(0.99)]),
        (Plane((0.85, 0.3, 0), (1, 0, 0), (0, 1, 0)), Plane((1.35, 0, 0), (2, 0, 0), (0, 4, 0))),
    ),
    # The sun comes in under the ceiling's edge; the ceiling's shadow begins 5.2 m behind the edge.
    "ceiling": Case(
        Plane((2.0, 0, 3), (0, 4, 0), (4, 0, 0)),
        numpy.array([math.sqrt(0.75), 0.0, -0.5]),
        (Plane((2.5, 0.3, 0), (1, 0, 0), (0, 1, 0)), Plane((3.0, 0, 0), (2, 0, 0), (0, 4, 0))),
    ),
}
# In the wall's shadow, before the plates.
SCREEN = Plane((0.25, -0.2, 0.3), (0, 1.2, 0), (0, 0, 0.6))
SIZES = ["1 m × 1 m", "2 m × 4 m"]


def sunlit(plate, sun, *others):
    room = Room()
    room.add(plate, reflectance=REFLECTANCE)
    room.add(*others)
    room.light({"Distant": {"angle_deg": 0.0}}, LUX, axes=facing(sun))
    return room


def luminance(sun):
    """Of the plate, cd/m²."""
    return REFLECTANCE * LUX * -sun[2] / math.pi


def rendered(case, number, *others):
    """Lux of the receiver by one of its plates."""
    return sunlit(case.plates[number], case.sun, case.receiver, *others).illuminance(case.receiver, GRID, 32768, bounces=1)


@pytest.mark.parametrize("number", [0, 1], ids=SIZES)
@pytest.mark.parametrize("name", CASES)
def test_a_plate_lights_a_plane(name, number):
    case = CASES[name]
    form = form_factors.polygon(case.plates[number].corners, case.receiver.points(*GRID), case.receiver.normal)
    title = f"plate of {SIZES[number]} onto a {name}"
    confidence.hold(SECTION, title, "ρ E₁ F, Lambert's formula", rendered(case, number), luminance(case.sun) * form)


def past_screen(plate, point, normal):
    """Form of the part of the plate that a point sees past the screen, whose shadow on the plate's plane is cut out of it."""
    corners = SCREEN.corners.copy()
    # Only what is lower than the point has a shadow: a higher screen is taken down to just below it.
    corners[:, 2] = numpy.minimum(corners[:, 2], point[2] - 1e-6)
    shadow = point + (corners - point) * (point[2] / (point[2] - corners[:, 2]))[:, None]
    if numpy.cross(shadow[1] - shadow[0], shadow[2] - shadow[1]) @ UP < 0:
        shadow = shadow[::-1]
    hidden = form_factors.clipped(plate.corners, shadow, UP)
    whole = form_factors.polygon(plate.corners, point[None], normal)[0]
    return whole - (form_factors.polygon(hidden, point[None], normal)[0] if len(hidden) else 0.0)


@pytest.mark.parametrize("number", [0, 1], ids=SIZES)
def test_an_obstruction_hides_part_of_the_plate(number):
    case = CASES["wall"]
    points = case.receiver.points(*GRID)
    forms = numpy.array([[past_screen(case.plates[number], point, case.receiver.normal) for point in line] for line in points])
    title = f"plate of {SIZES[number]} onto a wall, past a screen"
    confidence.hold(SECTION, title, "ρ E₁ F of the visible part", rendered(case, number, SCREEN), luminance(case.sun) * forms)

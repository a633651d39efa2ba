"""Light between matt walls of one reflectance ρ (CIE 171, 5.8): in any closed room the mean illuminance is Φ / (S (1 − ρ)), where S is its area."""

import math

import confidence
import numpy
import pytest
from rooms import Room, box_faces

pytestmark = pytest.mark.validate

SECTION = "Interreflection"
LUMENS = 1000.0
REFLECTANCES = [0.0, 0.05, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 0.95]
GRID = (16, 16)
SAMPLES = 16


def mean_of_faces(size, reflectance, place):
    """Mean illuminance of all faces of a box with a point source, one value a seed."""
    room = Room()
    room.add(*box_faces(size), reflectance=reflectance)
    room.light("Point", LUMENS / (4 * math.pi), place)
    total = 0.0
    for face in box_faces(size):
        found = room.illuminance(face, GRID, SAMPLES, averaged=True, bounces=2048)
        total = total + found.mean(axis=(1, 2)) * face.area
    return total / area(size)


def area(size):
    return sum(face.area for face in box_faces(size))


def hold(case, size, reflectance, place):
    expected = LUMENS / (area(size) * (1 - reflectance))
    confidence.hold(SECTION, case, "Φ / (S (1 − ρ))", mean_of_faces(size, reflectance, place)[:, None], numpy.array([expected]))


@pytest.mark.parametrize("reflectance", REFLECTANCES)
def test_cube_of_four_metres(reflectance):
    hold(f"cube 4 m, light in the middle, ρ = {reflectance}", (4.0, 4.0, 4.0), reflectance, (0, 0, 0))


@pytest.mark.parametrize("reflectance", [0.5, 0.9])
def test_corridor_with_a_light_near_its_end(reflectance):
    hold(f"corridor 12 m × 2 m × 2.5 m, light near an end, ρ = {reflectance}", (12.0, 2.0, 2.5), reflectance, (5.2, 0.3, 0.8))

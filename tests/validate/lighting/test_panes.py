"""Clear glass of index 1.52 between a light and a floor (CIE 171, 5.5): the directional and the diffuse transmittance of a sheet."""

import math

import confidence
import glass
import numpy
import pytest
from rooms import Plane, Room, facing

pytestmark = pytest.mark.validate

SECTION = "Glass"
FLOOR = Plane((0.3, 0.1, 0), (2, 0, 0), (0, 2, 0))
# Keeps the pane's mirror image of what is below from the floor.
GROUND = Plane((0, 0, -1e-3), (200, 0, 0), (0, 200, 0))
PANE = Plane((0, 0, 1), (100, 0, 0), (0, 100, 0))
ANGLES = numpy.array([0, 10, 20, 30, 40, 45, 50, 55, 60, 65, 70, 75, 80, 85])


def glazed(tint=1.0, floor=FLOOR):
    room = Room()
    room.add(floor, GROUND)
    room.add(PANE, material=glass.sheet(room, tint))
    return room


@pytest.mark.parametrize(("case", "tint"), [("clear", 1.0), ("tinted", 0.9)])
def test_parallel_light(case, tint):
    found = []
    for angle in numpy.radians(ANGLES):
        room = glazed(tint)
        room.light({"Distant": {"angle_deg": 0.0}}, 1.0, axes=facing((math.sin(angle), 0.0, -math.cos(angle))))
        found.append(room.illuminance(FLOOR, (4, 4), 16, seeds=[1]).mean() / math.cos(angle))
    expected = glass.transmittance(numpy.cos(numpy.radians(ANGLES)), inner=tint)
    confidence.hold_exact(SECTION, f"sun through a {case} pane at 0° to 85°", "Fresnel and Beer", numpy.array(found), expected, 0.01)


def test_the_edge_between_two_triangles_is_one_surface():
    """Rays straight through the diagonal of a pane pass one sheet of glass, not two."""
    floor = Plane((0, 0, 0), (2, 0, 0), (0, 2, 0))
    room = glazed(floor=floor)
    room.light({"Distant": {"angle_deg": 0.0}}, 1.0, axes=facing((0, 0, -1)))
    found = room.illuminance(floor, (4, 4), 16, seeds=[1])
    expected = numpy.full((4, 4), float(glass.transmittance(1.0)))
    confidence.hold_exact(SECTION, "sun straight down through a pane's diagonal", "Fresnel and Beer", found, expected, 1e-4)


@pytest.mark.parametrize("bounces", [0, 4])
def test_an_even_sky(bounces):
    """A pane is no bounce: without any the floor has its light from the sky all the same."""
    room = glazed()
    room.light({"Dome": {"format": "LatLong"}}, 1.0)
    found = room.illuminance(FLOOR, (4, 4), 4096, bounces=bounces).mean(axis=(1, 2))
    expected = math.pi * glass.diffuse_transmittance()
    case = f"even sky through a clear pane, {bounces} bounces"
    confidence.hold(SECTION, case, "∫ T L cos θ dω", found[:, None], numpy.array([expected]))

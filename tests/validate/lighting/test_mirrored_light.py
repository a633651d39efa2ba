"""A room with one mirror: the light that a wall of reflectance 1 sends back is that of the source's mirror image (the method of images)."""

import confidence
import form_factors
import numpy
import pytest
from rooms import Plane, Room, facing
from test_area_source import rectangle

pytestmark = pytest.mark.validate

SECTION = "Mirrors"
NITS = 1000.0
FLOOR = Plane((0.5, 0, 0), (3, 0, 0), (0, 4, 0))
MIRROR = Plane((-1.2, 0, 0), (0, 400, 0), (0, 0, 400))
FINITE = Plane((-1.2, 0.3, 1.2), (0, 1.0, 0), (0, 0, 0.8))
PLACE, AXES = (0.6, -0.3, 2.0), facing((-0.3, 0.2, -1.0))
GRID = (7, 7)


def image(points):
    """Points behind the mirror."""
    return points * [-1, 1, 1] + [2 * MIRROR.middle[0], 0, 0]


def silver(room):
    return room.scene.add_material("silver", base_color=(1, 1, 1), metalness=1.0, specular_roughness=0.0)


@pytest.mark.parametrize(
    ("case", "shape"), [("sphere", {"Sphere": {"radius": 0.25}}), ("rectangle", {"Rectangle": {"width": 0.8, "height": 0.5}})]
)
def test_a_light_and_its_image(case, shape):
    room = Room()
    room.add(FLOOR)
    room.add(MIRROR, material=silver(room))
    room.light(shape, NITS, PLACE, AXES)
    found = room.illuminance(FLOOR, GRID, 32768, bounces=1)
    points, up = FLOOR.points(*GRID), FLOOR.normal
    if case == "sphere":
        expected = sum(form_factors.sphere(0.25, place, points, up) for place in (numpy.array(PLACE), image(numpy.array(PLACE))))
    else:
        corners = rectangle(PLACE, AXES, 0.8, 0.5)
        # A mirror turns the way round.
        expected = form_factors.polygon(corners, points, up) + form_factors.polygon(image(corners)[::-1], points, up)
    confidence.hold(SECTION, f"{case} before a mirror", "the source and its image", found, NITS * expected)


def test_a_finite_mirror():
    """The image is seen through the mirror as through a window."""
    room = Room()
    room.add(FLOOR)
    room.add(FINITE, material=silver(room))
    # An even panel so large that the mirror shows nothing else.
    panel = Plane((6.0, 0, 2.0), (0, -60, 0), (0, 0, 60))
    lamp = room.scene.add_material("lamp", base_color=(0, 0, 0), specular_weight=0.0, emission_color=(NITS,) * 3)
    room.add(panel, material=lamp)
    found = room.illuminance(FLOOR, GRID, 32768, bounces=1)
    points, up = FLOOR.points(*GRID), FLOOR.normal
    upper = panel.corners.copy()
    # What of the panel is above the floor's plane.
    upper[:, 2] = numpy.maximum(upper[:, 2], 0.0)
    expected = form_factors.polygon(upper, points, up) + form_factors.polygon(FINITE.corners, points, up)
    confidence.hold(SECTION, "shining wall in a mirror of 1 m × 0.8 m", "form factors of wall and mirror", found, NITS * expected)

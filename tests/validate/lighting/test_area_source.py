"""Area sources of known luminance over 7 × 7 points of a floor and of a wall, against closed forms (CIE 171, 5.3)."""

import math

import confidence
import form_factors
import numpy
import pytest
from rooms import Plane, Room, facing

pytestmark = pytest.mark.validate

SECTION = "Area sources"
NITS = 1000.0
FLOOR = Plane((0, 0, -1.5), (4, 0, 0), (0, 4, 0))
# Below the lights, so that they are wholly above its horizon.
WALL = Plane((-2, 0, -0.5), (0, 4, 0), (0, 0, 2))
GRID = (7, 7)
SAMPLES = 256
TILTED = numpy.array([-0.3, 0.2, -1.0])
HEIGHT = 2.5


def hold(case, reference, room, emitted, planes=(FLOOR, WALL), samples=SAMPLES):
    """A room with one light against `emitted(points, normal)` of luminance 1."""
    found = [room.illuminance(plane, GRID, samples).reshape(8, -1) for plane in planes]
    expected = [NITS * emitted(plane.points(*GRID), plane.normal).ravel() for plane in planes]
    confidence.hold(SECTION, case, reference, numpy.concatenate(found, axis=1), numpy.concatenate(expected))


def lit(shape=None, **light):
    room = Room()
    room.add(FLOOR, WALL)
    if shape is not None:
        room.light(shape, NITS, **light)
    return room


def rectangle(place, axes, width, height):
    """Corners of a rectangle light, counter-clockwise as what it shines on sees it from −z."""
    x, y = axes[:, 0] * width / 2, axes[:, 1] * height / 2
    return numpy.asarray(place) + numpy.array([-x - y, -x + y, x + y, x - y])


def test_the_two_forms_of_a_rectangle_agree():
    """The corner formulas, which tables of form factors have, against Lambert's."""
    point = numpy.zeros((1, 3))
    above = numpy.array([[0, 0, 2.0], [0, 1.5, 2.0], [0.7, 1.5, 2.0], [0.7, 0, 2.0]])
    parallel = math.pi * form_factors.corner_parallel(0.7, 1.5, 2.0)
    assert form_factors.polygon(above, point, numpy.array([0, 0, 1.0])) == pytest.approx([parallel], rel=1e-12)
    beside = numpy.array([[2.0, 0, 0], [2.0, 1.5, 0], [2.0, 1.5, 0.7], [2.0, 0, 0.7]])[::-1]
    perpendicular = math.pi * form_factors.corner_perpendicular(0.7, 1.5, 2.0)
    assert form_factors.polygon(beside, point, numpy.array([0, 0, 1.0])) == pytest.approx([perpendicular], rel=1e-12)


@pytest.mark.parametrize(("case", "axis"), [("parallel to the floor", (0, 0, -1)), ("tilted", TILTED)])
def test_rectangle(case, axis):
    axes, place = facing(axis), (0.5, -0.3, 1.0)
    corners = rectangle(place, axes, 1.2, 0.6)
    room = lit({"Rectangle": {"width": 1.2, "height": 0.6}}, place=place, axes=axes)
    hold(f"rectangle 1.2 m × 0.6 m, {case}", "Lambert's formula", room, lambda p, n: form_factors.polygon(corners, p, n))


def test_a_shining_mesh():
    room, lamp = lit(), Plane((0.5, -0.3, 1.0), (0, 0.6, 0), (1.2, 0, 0))
    material = room.scene.add_material("lamp", base_color=(0, 0, 0), specular_weight=0.0, emission_color=(NITS,) * 3)
    room.add(lamp, material=material)
    # Triangles are drawn by their area, not by solid angle.
    hold(
        "shining mesh 1.2 m × 0.6 m", "Lambert's formula", room, lambda p, n: form_factors.polygon(lamp.corners, p, n), samples=16 * SAMPLES
    )


@pytest.mark.parametrize("radius", [0.05, 0.5])
def test_disk(radius):
    place = (0.4, 0.1, 1.0)
    room = lit({"Disk": {"radius": radius}}, place=place)

    def emitted(points, _):
        return form_factors.disk(radius, HEIGHT, numpy.hypot(points[..., 0] - place[0], points[..., 1] - place[1]))

    hold(f"disk of {radius} m, parallel to the floor", "form factor of a disk", room, emitted, planes=(FLOOR,))


@pytest.mark.parametrize("radius", [0.05, 0.45])
def test_sphere(radius):
    place = (0.4, 0.1, 1.0)
    room = lit({"Sphere": {"radius": radius}}, place=place)
    hold(f"sphere of {radius} m", "π L r² cos θ / d²", room, lambda p, n: form_factors.sphere(radius, place, p, n))


@pytest.mark.parametrize(("case", "axis"), [("parallel to the floor", (1.0, 0.0, 0.0)), ("tilted", (0.8, 0.36, 0.48))])
def test_line(case, axis):
    place, radius, length = numpy.array([0.3, -0.2, 1.2]), 2e-5, 1.2
    along = numpy.asarray(axis)
    across = facing(along)[:, 0]
    axes = numpy.stack([along, across, numpy.cross(along, across)], axis=1)
    room = lit({"Cylinder": {"radius": radius, "length": length}}, place=place, axes=axes)
    ends = place - along * length / 2, place + along * length / 2
    hold(f"line of 1.2 m, {case}", "∫ L w sin α cos θ / d² dx", room, lambda p, n: form_factors.line(2 * radius, *ends, p, n))

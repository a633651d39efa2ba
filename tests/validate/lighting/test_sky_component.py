"""Daylight through openings of a black room under the 15 general skies and the traditional overcast one (CIE 171, 5.9 to 5.14).

The reference integrates ISO 15469's luminances over what a point sees of the opening, 96 × 96 directions by Gauss and Legendre; the sky's level is
taken from its horizontal illuminance.
"""

import math

import confidence
import general_sky
import glass
import gonio
import numpy
import pytest
from rooms import Plane, Room

pytestmark = pytest.mark.validate

SECTION = "Sky through openings"
# The room: 4 m × 4 m × 3 m, floor at 0.
FLOOR = Plane((0, 0, 0), (4, 0, 0), (0, 4, 0))
CEILING = Plane((0, 0, 3), (0, 4, 0), (4, 0, 0))
WALLS = [
    Plane((2, 0, 1.5), (0, -4, 0), (0, 0, 3)),
    Plane((0, -2, 1.5), (-4, 0, 0), (0, 0, 3)),
    Plane((0, 2, 1.5), (4, 0, 0), (0, 0, 3)),
]
WEST = Plane((-2, 0, 1.5), (0, 4, 0), (0, 0, 3))
SKYLIGHT = Plane((0.3, -0.2, 3), (0, 1, 0), (1, 0, 0))
WINDOW = Plane((-2, 0.4, 1.6), (0, 2, 0), (0, 0, 1.2))
GRID = (7, 7)
SAMPLES = 1024
SKIES = [*general_sky.PARAMETERS, general_sky.TRADITIONAL_OVERCAST]
GROUND = 0.3


def daylight(kind, ground=0.0):
    """A sky of a type without a sun's disc, the sun about 40° high in the west of south so that it looks in through the window."""
    irradiances = {"direct_normal": 0.0, "diffuse_horizontal": 200.0}
    return gonio.daylight(48.2, 16.4, "2025-06-21T16:30+02:00", sky=f"cie{kind}", coloured=False, ground=ground, **irradiances)


def frame(plane, opening):
    """What is left of a rectangle around an opening in it with parallel edges."""
    u, v = (numpy.asarray(edge, float) for edge in (plane.u, plane.v))
    offset = numpy.asarray(opening.middle) - plane.middle
    a, b = offset @ u / (u @ u), offset @ v / (v @ v)
    half_a, half_b = (abs(numpy.dot(opening.u, edge) + numpy.dot(opening.v, edge)) / (edge @ edge) / 2 for edge in (u, v))
    left, right, low, high = a - half_a, a + half_a, b - half_b, b + half_b
    parts = [(-0.5, left, -0.5, 0.5), (right, 0.5, -0.5, 0.5), (left, right, -0.5, low), (left, right, high, 0.5)]
    return [
        Plane(tuple(plane.middle + u * (start + end) / 2 + v * (bottom + top) / 2), tuple(u * (end - start)), tuple(v * (top - bottom)))
        for start, end, bottom, top in parts
    ]


def outward(opening):
    """Axes of a portal whose light comes in along −z of them: z points out."""
    u, v = (numpy.asarray(edge, float) / numpy.linalg.norm(edge) for edge in (opening.v, opening.u))
    return numpy.stack([u, v, numpy.cross(u, v)], axis=1)


def room_with(opening, sky, *outside, pane=False, portal=True):
    """The black room, open in the ceiling or in the western wall."""
    room = Room()
    closed = (CEILING, WEST)
    room.add(FLOOR, *WALLS, *outside)
    for plane in closed:
        around = abs((numpy.asarray(opening.middle) - plane.middle) @ plane.normal) < 1e-9
        room.add(*(frame(plane, opening) if around else [plane]))
    if pane:
        room.add(opening, material=glass.sheet(room))
    room.scene.add_daylight(sky, up="Z")
    if portal:
        size = {"Rectangle": {"width": float(numpy.linalg.norm(opening.v)), "height": float(numpy.linalg.norm(opening.u))}}
        room.light(size, 1.0, opening.middle, outward(opening), portal=True)
    return room


def blocked(point, targets, planes):
    """Whether the ways on from a point through targets (n, 3) meet any of the rectangles, (n)."""
    hit = numpy.zeros(len(targets), bool)
    to = targets - point
    for plane in planes:
        u, v = numpy.asarray(plane.u), numpy.asarray(plane.v)
        with numpy.errstate(divide="ignore", invalid="ignore"):
            t = ((plane.middle - point) @ plane.normal) / (to @ plane.normal)
            at = point + t[:, None] * to - plane.middle
        hit |= (t > 1.0) & (numpy.abs(at @ u) < u @ u / 2) & (numpy.abs(at @ v) < v @ v / 2)
    return hit


def through(opening, luminance, points, normal, outside=(), pane=False):
    """Illuminance of points by what they see through an opening of a sky `luminance(direction)`."""
    # The edge of a mask cuts through cells.
    x, w = numpy.polynomial.legendre.leggauss(500 if outside else 96)
    u, v = (0.5 * numpy.asarray(edge, float) for edge in (opening.u, opening.v))
    targets = (opening.middle + x[:, None, None] * u + x[:, None] * v).reshape(-1, 3)
    weights = (w[:, None] * w).ravel() * opening.area / 4

    def at(point):
        to = targets - point
        distance = numpy.linalg.norm(to, axis=-1)
        direction = to / distance[:, None]
        across = numpy.abs(direction @ opening.normal)
        received = numpy.maximum(direction @ normal, 0.0) * across / distance**2 * luminance(direction)
        if pane:
            received = received * glass.transmittance(across)
        return numpy.where(blocked(point, targets, outside), 0.0, received) @ weights

    return numpy.apply_along_axis(at, -1, points)


def sky_of(kind, day, ground=0.0):
    """Luminance by direction: the sky at its level, and level ground under it."""
    sun = numpy.array(day.sun_direction)
    scale = day.diffuse_illuminance / general_sky.horizontal(kind, sun)
    below = ground * day.diffuse_illuminance / math.pi
    return lambda direction: numpy.where(direction[..., 2] > 0, scale * general_sky.relative(kind, direction, sun), below)


def hold(case, kind, opening, plane=FLOOR, *, outside=(), pane=False, portal=True, ground=0.0, samples=SAMPLES):
    day = daylight(kind, ground)
    # A pane without thickness in the opening lies on the portal; straight through it is no bounce, but its other half is followed as one.
    found = room_with(opening, day, *outside, pane=pane, portal=portal).illuminance(plane, GRID, samples, bounces=1 if pane else 0)
    expected = through(opening, sky_of(kind, day, ground), plane.points(*GRID), plane.normal, outside, pane)
    confidence.hold(SECTION, case, "∫ L cos θ dω over the opening", found, expected)


def name(kind):
    return "traditional overcast sky" if kind == general_sky.TRADITIONAL_OVERCAST else f"sky type {kind:02}"


def test_the_overcast_sky_has_its_closed_forms():
    """The reference itself: 7 π / 9 for the traditional overcast sky, π for the even one."""
    sun = numpy.array([0.0, 0.6, 0.8])
    assert general_sky.horizontal(16, sun) == pytest.approx(7 * math.pi / 9, rel=1e-6)
    assert general_sky.horizontal(5, sun) == pytest.approx(math.pi, rel=1e-9)


@pytest.mark.parametrize("kind", SKIES)
def test_roof_opening(kind):
    hold(f"roof opening 1 m × 1 m, {name(kind)}", kind, SKYLIGHT)


@pytest.mark.parametrize("kind", SKIES)
def test_window(kind):
    hold(f"window 2 m × 1.2 m, {name(kind)}", kind, WINDOW)


@pytest.mark.parametrize("kind", [5, 12, 16])
def test_openings_without_a_portal(kind):
    hold(f"window without a portal, {name(kind)}", kind, WINDOW, portal=False, samples=16 * SAMPLES)


@pytest.mark.parametrize("kind", [5, 12, 16])
@pytest.mark.parametrize(("case", "opening"), [("roof opening", SKYLIGHT), ("window", WINDOW)], ids=["roof", "window"])
def test_glazed_openings(case, opening, kind):
    hold(f"{case} with a clear pane, {name(kind)}", kind, opening, pane=True)


@pytest.mark.parametrize("kind", [5, 12, 16])
def test_ground_outside(kind):
    """The ceiling has its light from the ground alone."""
    hold(f"window onto ground of ρ = {GROUND}, {name(kind)}, floor", kind, WINDOW, ground=GROUND)
    hold(f"window onto ground of ρ = {GROUND}, {name(kind)}, ceiling", kind, WINDOW, CEILING, ground=GROUND)


OVERHANG = Plane((-2.5, 0.4, 2.3), (1, 0, 0), (0, 2.4, 0))
FIN = Plane((-2.5, 1.5, 1.6), (0, 0, 1.6), (1, 0, 0))


@pytest.mark.parametrize("kind", [5, 12, 16])
@pytest.mark.parametrize(("case", "mask"), [("an overhang", OVERHANG), ("a fin", FIN)], ids=["overhang", "fin"])
def test_masks_outside(case, mask, kind):
    hold(f"window with {case} of 1 m, {name(kind)}", kind, WINDOW, outside=(mask,), samples=8 * SAMPLES)

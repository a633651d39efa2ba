"""Light through a slit in a black plate and through a prism of glass onto a white screen: a rainbow, and nothing else shines.

The glass is `crown`, with BK7's index and Abbe number, or `flint` with more dispersion; the lamp is the sun, or a spot 3 m before the slit. Metres,
edges of the prism upright, all light in planes of one height but for what the slit lets spread.
"""

import math

import numpy
from cornell import Diffuse
from description import Camera, Dispersing, Light, Mesh, Scene, Spot, Sun
from shapes import facing, quad

INDEX = 1.5168
CROWN, FLINT = Dispersing(INDEX, 64.17), Dispersing(INDEX, 30.0)
# The sides of the prism's section, an equilateral triangle, and half its height.
SIDE, HALF_HEIGHT = 0.1, 0.06
# Half the slit's width and height, and how far before the prism's face it is.
HALF_SLIT, SLIT = (0.0015, 0.03), 0.1
# From the prism to the screen; what the screen reflects.
SCREEN, REFLECTANCE = 1.0, 0.8
SUN_ANGLE_DEG, SUN_RADIANCE = 0.05, 1.0e9
SPOT_DISTANCE, SPOT_ANGLE_DEG, SPOT_INTENSITY = 3.0, 3.0, 1.0e4

# Of light through a prism at least deviation, where it is symmetrical: halves of the apex and of the deviation.
HALF_APEX = math.radians(30.0)
HALF_DEVIATION = math.asin(INDEX * math.sin(HALF_APEX)) - HALF_APEX
UP = numpy.array([0.0, 1.0, 0.0])
# Before the prism and after it; the apex is at +z, light is bent towards -z.
TOWARDS = numpy.array([math.cos(HALF_DEVIATION), 0.0, math.sin(HALF_DEVIATION)])
AWAY = TOWARDS * (1.0, 1.0, -1.0)
# The prism's section, counter-clockwise seen from above (from +y): two corners of the base, then the apex.
SECTION = numpy.array([(-0.5, 0.0), (0.5, 0.0), (0.0, math.cos(HALF_APEX))]) * SIDE
# Where light of the line d enters and leaves, the middle of the slit, and where that light meets the screen.
ENTRY = numpy.array([-0.25 * SIDE, 0.0, 0.5 * SECTION[2, 1]])
EXIT = ENTRY * (-1.0, 1.0, 1.0)
MIDDLE = ENTRY - SLIT * TOWARDS
TARGET = EXIT + SCREEN * AWAY
# Across the slit towards the apex, and along the screen towards the blue.
ACROSS = numpy.cross(TOWARDS, UP)
ALONG = numpy.cross(UP, AWAY)


def sun_crown() -> Scene:
    return scene(CROWN, sun())


def sun_flint() -> Scene:
    return scene(FLINT, sun())


def spot_crown() -> Scene:
    return scene(CROWN, spot())


def spot_flint() -> Scene:
    return scene(FLINT, spot())


def scene(glass: Dispersing, light: Light) -> Scene:
    """Seen from above the light's way."""
    middle = TARGET + 0.015 * ALONG
    camera = Camera(facing(middle - 0.6 * AWAY + 0.25 * UP, middle), 5.6)
    return Scene([*plate(), prism(glass), screen()], [light], camera, width=256, height=128, bounces=8)


def sun() -> Sun:
    return Sun(facing((0.0, 0.0, 0.0), TOWARDS), SUN_ANGLE_DEG, (SUN_RADIANCE,) * 3)


def spot() -> Spot:
    return Spot(facing(MIDDLE - SPOT_DISTANCE * TOWARDS, MIDDLE), SPOT_ANGLE_DEG, 0.0, (SPOT_INTENSITY,) * 3)


def plate() -> list[Mesh]:
    """Four quadrilaterals about the slit, so wide that no other light meets the screen."""
    (width, height), black = HALF_SLIT, Diffuse((0.0, 0.0, 0.0))
    # Far enough on the side that the light is bent to for the screen to be in the shade.
    low, high, top = -1.1, 0.15, 0.2
    spans = [((low, -width), (-top, top)), ((width, high), (-top, top)), ((-width, width), (-top, -height)), ((-width, width), (height, top))]
    return [quad(f"plate {number}", [MIDDLE + a * ACROSS + b * UP for a, b in rectangle(*span)], black) for number, span in enumerate(spans)]


def rectangle(u: tuple[float, float], v: tuple[float, float]) -> list[tuple[float, float]]:
    return [(u[0], v[0]), (u[1], v[0]), (u[1], v[1]), (u[0], v[1])]


def prism(glass: Dispersing) -> Mesh:
    """Two triangles and three sides, fronts outwards."""
    points = [(x, y, z) for y in (-HALF_HEIGHT, HALF_HEIGHT) for x, z in SECTION]
    faces = [(0, 1, 2), (3, 5, 4), (0, 3, 4), (0, 4, 1), (1, 4, 5), (1, 5, 2), (2, 5, 3), (2, 3, 0)]
    return Mesh("prism", numpy.array(points, "f4"), numpy.array(faces, "i4"), glass)


def screen() -> Mesh:
    """Across the light's way, its front towards the prism."""
    corners = [TARGET - a * ALONG + b * UP for a, b in rectangle((-0.12, 0.12), (-0.08, 0.08))]
    return quad("screen", corners, Diffuse((REFLECTANCE,) * 3))

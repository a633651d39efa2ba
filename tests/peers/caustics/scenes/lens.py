"""A lamp in a tube behind a plano-convex lens throws a spot onto a wall; nothing else shines."""

import math

import numpy
from cornell import Diffuse, Glass
from description import Camera, Disk, Light, Mesh, Scene
from lineup import BOUNCES
from shapes import ball, box, facing, lathed, placed, quad, smoothed

WALL = Diffuse((0.7, 0.7, 0.7))
# Metres: the radius of the lens and of its curved side, its thickness at the edge, the inner and outer radius of the tube.
LENS, CURVATURE, EDGE, TUBE = 0.04, 0.08, 0.004, (0.0395, 0.044)
# The lamp's radius, and how far behind the flat side it is: within the focal length of 0.16 m, so that the spot is wide.
LAMP, DISTANCE = 0.006, 0.12
# The middle of the lens' flat side, and where it looks.
PLACE = facing((-0.75, 1.1, 0.9), (0.35, 0.95, -1.2))


def scene() -> Scene:
    """Seen from beside the tube."""
    lamp: list[Light] = [Disk(PLACE @ moved_back(DISTANCE), LAMP, (4.0e6, 3.6e6, 3.0e6))]
    return Scene(
        [*room(), tube(), *lens()], lamp, Camera(facing((0.9, 1.5, 2.2), (-0.05, 0.85, -0.6)), 50.0), width=192, height=144, bounces=BOUNCES
    )


def room() -> list[Mesh]:
    """A corner of a room, the wall that is lit, and things in the spot and beside it."""
    return [
        quad("floor", [(-1.6, 0, 2.4), (1.6, 0, 2.4), (1.6, 0, -1.2), (-1.6, 0, -1.2)], Diffuse((0.45, 0.35, 0.25))),
        quad("wall", [(-1.6, 0, -1.2), (1.6, 0, -1.2), (1.6, 2, -1.2), (-1.6, 2, -1.2)], WALL),
        quad("left", [(-1.6, 0, 2.4), (-1.6, 0, -1.2), (-1.6, 2, -1.2), (-1.6, 2, 2.4)], WALL),
        box("chest", (0.75, 0.3, -0.8), (0.5, 0.6, 0.4), Diffuse((0.2, 0.3, 0.5)), 15.0),
        ball("ball", (0.3, 0.9, -1.0), 0.09, Diffuse((0.7, 0.3, 0.2))),
    ]


def moved_back(distance: float) -> numpy.ndarray:
    """Along the frame's +z, away from where it looks."""
    matrix = numpy.eye(4)
    matrix[2, 3] = distance
    return matrix


def along(profile: list[tuple[float, float]], name: str, surface: Diffuse | Glass) -> Mesh:
    """A profile of (radius, height) turned about the axis of the lens; heights go where the lens looks."""
    upright = numpy.array([[1, 0, 0, 0], [0, 0, 1, 0], [0, -1, 0, 0], [0, 0, 0, 1]], "f8")
    return placed(lathed(name, numpy.array(profile), (0.0, 0.0, 0.0), surface, segments=192), PLACE @ upright)


def tube() -> Mesh:
    """Black inside and out, closed behind; the edge of the lens sits within its front."""
    inner, outer = TUBE
    profile = [
        (0.0, -DISTANCE - 0.02),
        (outer, -DISTANCE - 0.02),
        (outer, EDGE),
        (inner, EDGE),
        (inner, -DISTANCE - 0.015),
        (0.0, -DISTANCE - 0.015),
    ]
    return along(profile, "tube", Diffuse((0.04, 0.04, 0.04)))


def lens() -> list[Mesh]:
    """Flat side, edge and curved side, each smooth by itself."""
    most = math.asin(LENS / CURVATURE)
    drop = CURVATURE * math.cos(most)
    curved = [(CURVATURE * math.sin(angle), EDGE + CURVATURE * math.cos(angle) - drop) for angle in numpy.linspace(most, 0.0, 97)]
    # Steps of the same angle all along, so that no triangle is a needle.
    flat = [(radius, 0.0) for radius in numpy.linspace(0.0, LENS, 17)]
    parts = [
        along(flat, "flat side", Glass(1.5)),
        along([(LENS, 0.0), (LENS, EDGE)], "edge", Glass(1.5)),
        along(curved, "curved side", Glass(1.5)),
    ]
    return [smoothed(part) for part in parts]

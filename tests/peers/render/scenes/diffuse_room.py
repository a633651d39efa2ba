"""A diffuse room with nine flat lights close to ceiling and walls, so that a renderer whose lights are surfaces shows the same."""

import numpy
from cornell import Diffuse
from description import Camera, Disk, Light, Mesh, Rectangle, Scene
from shapes import ball, box, downward, facing, lathed, quad, room

WALL = (0.72, 0.70, 0.66)
CEILING = (0.8, 0.8, 0.8)
X, Z, H = 3.0, 4.0, 3.0


def scene() -> Scene:
    """Seen from a corner of the room."""
    return Scene([*shell(), *things()], lights(), Camera(facing((2.4, 1.7, 3.6), (-0.5, 1.0, -1.2)), 58.0))


def shell() -> list[Mesh]:
    """A closed room."""
    return [
        *room(X, Z, H, Diffuse((0.35, 0.24, 0.16)), Diffuse(CEILING), Diffuse(WALL)),
        quad("left", [(-X, 0, Z), (-X, 0, -Z), (-X, H, -Z), (-X, H, Z)], Diffuse((0.55, 0.2, 0.15))),
    ]


def things() -> list[Mesh]:
    """Boxes, turned bodies and balls."""
    stool = numpy.array([(0.0, 0.001), (0.25, 0.001), (0.2, 0.25), (0.25, 0.58), (0.0, 0.6)])
    return [
        box("table", (-0.6, 0.401, -0.9), (2.0, 0.8, 1.2), Diffuse((0.42, 0.25, 0.12)), 12.0),
        box("chest", (1.9, 0.601, -3.2), (1.2, 1.2, 0.8), Diffuse((0.15, 0.28, 0.45)), -10.0),
        lathed("stool", stool, (0.9, 0.0, 0.2), Diffuse((0.2, 0.5, 0.25)), segments=64),
        lathed("other stool", stool, (-1.6, 0.0, 0.9), Diffuse((0.5, 0.25, 0.55)), segments=64),
        ball("ball", (-1.1, 1.06, -0.9), 0.25, Diffuse((0.75, 0.6, 0.2)), 4),
        ball("other ball", (-0.1, 1.01, -0.8), 0.2, Diffuse((0.7, 0.7, 0.7)), 4),
    ]


def lights() -> list[Light]:
    """Five rectangles and four disks."""
    warm, cool = (1700.0, 1450.0, 1100.0), (1100.0, 1300.0, 1700.0)
    ceiling = [Rectangle(downward(x, H - 0.001, z), 0.8, 0.25, warm, CEILING) for x in (-1.5, 1.5) for z in (-2.0, 1.5)]
    wall = Rectangle(facing((X - 0.001, 1.8, -1.5), (0.0, 1.8, -1.5)), 0.9, 0.6, cool, WALL)
    spots = [Disk(downward(0.0, H - 0.001, z), 0.15, (4500.0, 3900.0, 3000.0), CEILING) for z in (-3.0, -1.0, 1.0)]
    back = Disk(facing((-1.5, 2.0, -Z + 0.001), (-1.5, 2.0, 0.0)), 0.25, cool, WALL)
    return [*ceiling, wall, *spots, back]

"""A furnished room with nine lights of all kinds: two rectangles, two disks, two balls, a point, a spot, and the sun through an opening."""

import numpy
from cornell import Diffuse, Glass, Mirror
from description import Camera, Disk, Light, Mesh, Point, Rectangle, Scene, Sphere, Spot, Sun
from shapes import ball, box, downward, facing, lathed, moved, room

WALL = Diffuse((0.72, 0.70, 0.66))
FLOOR = Diffuse((0.35, 0.24, 0.16))
CEILING = Diffuse((0.8, 0.8, 0.8))
WOOD = Diffuse((0.42, 0.25, 0.12))
CLOTH = Diffuse((0.15, 0.28, 0.45))
# Half the room's width and depth, and its height.
X, Z, H = 3.0, 4.0, 3.0


def scene() -> Scene:
    """Seen from a corner of the room."""
    return Scene([*shell(), *furniture()], lights(), Camera(facing((2.4, 1.7, 3.6), (-0.5, 1.0, -1.2)), 58.0))


def shell() -> list[Mesh]:
    """Floor, ceiling and walls; the one at -x has an opening of 1.6 by 1.4 m."""
    return [
        *room(X, Z, H, FLOOR, CEILING, WALL),
        box("under", (-X - 0.1, 0.45, 0.0), (0.2, 0.9, 2 * Z), WALL),
        box("over", (-X - 0.1, 2.65, 0.0), (0.2, 0.7, 2 * Z), WALL),
        box("beside", (-X - 0.1, 1.6, -2.7), (0.2, 1.4, 2.6), WALL),
        box("before", (-X - 0.1, 1.6, 2.1), (0.2, 1.4, 3.8), WALL),
    ]


def furniture() -> list[Mesh]:
    """A table with things on it, stools, a shelf with balls: 14 thousand triangles."""
    legs = numpy.stack([moved(x, 0, z) for x in (-1.5, 0.3) for z in (-1.4, -0.4)])
    leg = box("leg", (0.0, 0.35, 0.0), (0.07, 0.698, 0.07), WOOD)
    vase = numpy.array([(0.0, 0.0), (0.10, 0.0), (0.14, 0.1), (0.11, 0.22), (0.06, 0.30), (0.08, 0.36)])
    stool = numpy.array([(0.0, 0.001), (0.2, 0.001), (0.16, 0.25), (0.2, 0.48), (0.0, 0.5)])
    items = [
        box("table", (-0.6, 0.73, -0.9), (2.0, 0.05, 1.2), WOOD),
        Mesh(leg.name, leg.points, leg.triangles, leg.surface, places=legs),
        lathed("vase", vase, (-0.2, 0.757, -0.9), Mirror(0.85, 0.35), segments=64),
        ball("glass", (-0.75, 0.92, -0.75), 0.16, Glass(1.5), 4),
        ball("mirror", (-1.25, 0.94, -1.05), 0.18, Mirror(0.9, 0.15), 4),
        lathed("stool", stool, (0.9, 0.0, -0.2), CLOTH, segments=64),
        lathed("other stool", stool, (-0.6, 0.0, 0.5), CLOTH, segments=64),
        box("shelf", (0.6, 1.3, -3.8), (2.6, 0.05, 0.36), WOOD),
        box("chest", (1.6, 0.4, -3.6), (1.2, 0.798, 0.6), CLOTH, 8.0),
    ]
    colours = [(0.7, 0.2, 0.15), (0.75, 0.6, 0.2), (0.2, 0.5, 0.25), (0.5, 0.25, 0.55)]
    return items + [ball(f"ball {i}", (-0.3 + 0.55 * i, 1.5, -3.8), 0.17, Diffuse(colour), 4) for i, colour in enumerate(colours)]


def lights() -> list[Light]:
    """Nine, about as strong as each other."""
    return [
        Rectangle(downward(-1.2, 2.99, 1.2), 1.2, 0.3, (2400.0, 2200.0, 1900.0)),
        Rectangle(facing((2.98, 1.9, -2.0), (0.0, 1.4, -2.0)), 0.8, 0.6, (900.0, 1100.0, 1500.0)),
        Disk(downward(1.2, 2.99, -1.0), 0.2, (6000.0, 5200.0, 4000.0)),
        Disk(downward(1.4, 2.99, 1.8), 0.15, (7000.0, 5200.0, 3600.0)),
        Sphere(moved(-0.6, 2.1, -0.9), 0.12, (6500.0, 5000.0, 3300.0)),
        Sphere(moved(-2.5, 1.5, -3.4), 0.2, (1800.0, 1300.0, 800.0)),
        Point(moved(2.4, 2.2, -3.2), (70.0, 90.0, 130.0)),
        Spot(facing((0.4, 2.9, -1.9), (0.6, 1.4, -3.9)), 60.0, 0.4, (420.0, 330.0, 220.0)),
        Sun(facing((-4.0, 2.9, -1.1), (0.0, 0.0, -0.2)), 2.0, (4.0e6, 3.4e6, 2.5e6)),
    ]

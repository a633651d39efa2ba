"""An office and a corridor, joined by a door: matt rectangles, six luminaires, two grids of points. Metres, z is up.

The wall between is 0.1 m thick. What reaches the corridor has come through the door.
"""

from dataclasses import dataclass
from pathlib import Path

import numpy

Vector = tuple[float, float, float]

LUMINAIRE = Path(__file__).resolve().with_name("luminaire.ldt")
# The file's luminous opening: along C0 (x) and along C90 (y).
OPENING = (0.038, 0.638)
REFLECTANCE = {"ceiling": 0.7, "wall": 0.5, "floor": 0.2, "desk": 0.4}

WIDTH, HEIGHT = 6.0, 2.8
OFFICE_DEPTH, CORRIDOR_START, DEPTH = 4.5, 4.6, 6.4
DOOR_LEFT, DOOR_RIGHT, DOOR_HEIGHT = 4.6, 5.5, 2.1
DESK_LOW, DESK_HIGH = (2.2, 1.8, 0.71), (3.8, 2.6, 0.74)
LUMINAIRES: list[Vector] = [(x, y, 2.79) for x in (1.0, 3.0, 5.0) for y in (1.125, 3.375)]


@dataclass(frozen=True)
class Rectangle:
    """A corner and two edges; edge u × edge v points into the room."""

    material: str
    corner: Vector
    u: Vector
    v: Vector

    def corners(self) -> list[Vector]:
        """All four, counterclockwise seen from the room."""
        p, u, v = (numpy.array(each) for each in (self.corner, self.u, self.v))
        return [vector(each) for each in (p, p + u, p + u + v, p + v)]


@dataclass(frozen=True)
class Grid:
    """Points that look up: the middles of equal cells of a level rectangle."""

    name: str
    centre: Vector
    size: tuple[float, float]
    spacing: float

    def points(self) -> numpy.ndarray:
        """Places (points, 3), row by row along x."""
        columns, rows = (round(length / self.spacing) for length in self.size)
        x = self.centre[0] + (numpy.arange(columns) - 0.5 * (columns - 1)) * self.spacing
        y = self.centre[1] + (numpy.arange(rows) - 0.5 * (rows - 1)) * self.spacing
        return numpy.array([(a, b, self.centre[2]) for b in y for a in x])


GRIDS = [
    Grid("office", (3.0, 2.25, 0.75), (5.0, 3.5), 0.5),
    Grid("corridor", (3.0, 5.5, 0.02), (5.4, 1.2), 0.6),
]


def box(material: str, low: Vector, high: Vector, faces: str) -> list[Rectangle]:
    """The named faces (`-x`, `+z`, …) of a box, seen from outside."""
    a, size = numpy.array(low), numpy.array(high) - numpy.array(low)
    found = []
    for face in faces.split():
        axis = "xyz".index(face[1])
        u, v = (numpy.eye(3)[(axis + turn) % 3] * size for turn in (1, 2))
        if face[0] == "-":
            u, v = v, u
        corner = a + numpy.eye(3)[axis] * size * (face[0] == "+")
        found.append(Rectangle(material, vector(corner), vector(u), vector(v)))
    return found


def vector(values: numpy.ndarray) -> Vector:
    """Three numbers of Python's."""
    x, y, z = values.tolist()
    return x, y, z


def turned(rectangles: list[Rectangle]) -> list[Rectangle]:
    """Seen from the other side, as a room's walls are from within."""
    return [Rectangle(each.material, each.corner, each.v, each.u) for each in rectangles]


def room(start: float, end: float, open_side: str) -> list[Rectangle]:
    """Floor, ceiling and three walls between two places along y; `open_side` is the side of the wall with the door."""
    low, high = (0.0, start, 0.0), (WIDTH, end, HEIGHT)
    closed = "-y" if open_side == "+y" else "+y"
    faces = {"wall": f"-x +x {closed}", "floor": "-z", "ceiling": "+z"}
    return turned([each for material, named in faces.items() for each in box(material, low, high, named)])


def wall_between() -> list[Rectangle]:
    """Both faces around the door, and the sides, the lintel and the threshold of the opening."""
    pieces = [(0.0, DOOR_LEFT, 0.0), (DOOR_RIGHT, WIDTH, 0.0), (DOOR_LEFT, DOOR_RIGHT, DOOR_HEIGHT)]
    found = []
    for left, right, bottom in pieces:
        found += box("wall", (left, OFFICE_DEPTH, bottom), (right, CORRIDOR_START, HEIGHT), "-y +y")
    opening = (DOOR_LEFT, OFFICE_DEPTH, 0.0), (DOOR_RIGHT, CORRIDOR_START, DOOR_HEIGHT)
    return found + turned(box("wall", *opening, "-x +x +z") + box("floor", *opening, "-z"))


def rectangles() -> list[Rectangle]:
    """All surfaces."""
    rooms = room(0.0, OFFICE_DEPTH, "+y") + room(CORRIDOR_START, DEPTH, "-y")
    return rooms + wall_between() + box("desk", DESK_LOW, DESK_HIGH, "-x +x -y +y -z +z")


def points() -> numpy.ndarray:
    """The points of both grids (points, 3), the office's first."""
    return numpy.concatenate([grid.points() for grid in GRIDS])


def each_grid(values: numpy.ndarray) -> dict[str, numpy.ndarray]:
    """Values of all points (…, points) by grid."""
    ends = numpy.cumsum([len(grid.points()) for grid in GRIDS])[:-1]
    return {grid.name: part for grid, part in zip(GRIDS, numpy.split(values, ends, axis=-1), strict=True)}

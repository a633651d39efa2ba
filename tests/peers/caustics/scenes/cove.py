"""A room lit by coves alone: lamps lie in troughs along two walls and shine at the ceiling, from where all light comes."""

from cornell import Diffuse
from description import Camera, Light, Mesh, Rectangle, Scene
from lineup import BOUNCES
from shapes import ball, box, facing, quad, room

WALL = Diffuse((0.7, 0.68, 0.64))
X, Z, H = 2.2, 2.8, 2.7
# A trough's height above the floor, how far it stands out, its lip, and the lamp's width within.
SILL, OUT, LIP, LAMP = 2.3, 0.18, 0.16, 0.03


def scene() -> Scene:
    """Seen from a corner; no lamp is in view."""
    meshes, lights = shell() + things(), []
    for side in (-1, 1):
        meshes += trough(side)
        lights.append(lamp(side))
    return Scene(meshes, lights, Camera(facing((1.7, 1.5, 2.5), (-0.5, 0.9, -1.0)), 62.0), width=192, height=144, bounces=BOUNCES)


def shell() -> list[Mesh]:
    """All six sides."""
    left = quad("left", [(-X, 0, Z), (-X, 0, -Z), (-X, H, -Z), (-X, H, Z)], WALL)
    return [*room(X, Z, H, Diffuse((0.35, 0.25, 0.17)), Diffuse((0.8, 0.8, 0.8)), WALL), left]


def trough(side: int) -> list[Mesh]:
    """A shelf and its lip along a wall, open at the top."""
    x = side * (X - OUT / 2)
    return [
        box(f"shelf {side}", (x, SILL, 0.0), (OUT, 0.02, 2 * Z), WALL),
        box(f"lip {side}", (side * (X - OUT), SILL + LIP / 2, 0.0), (0.02, LIP, 2 * Z), WALL),
    ]


def lamp(side: int) -> Light:
    """A strip on the shelf, close to the wall."""
    place = facing((side * (X - 0.05), SILL + 0.02, 0.0), (side * (X - 0.05), SILL + 1.0, 0.0), up=(0.0, 0.0, 1.0))
    return Rectangle(place, LAMP, 2 * Z - 0.4, (30000.0, 27000.0, 23000.0), WALL.reflectance)


def things() -> list[Mesh]:
    """A table and what lies beside it."""
    return [
        box("table", (-0.6, 0.72, -0.9), (1.4, 0.04, 0.8), Diffuse((0.5, 0.36, 0.22))),
        ball("ball", (-0.4, 0.89, -0.9), 0.15, Diffuse((0.7, 0.3, 0.2))),
        box("crate", (0.9, 0.3, -1.6), (0.6, 0.6, 0.6), Diffuse((0.45, 0.5, 0.6)), 25.0),
    ]

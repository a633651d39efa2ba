"""A candle lantern lights a room: a small flame within four panes of glass in a metal frame."""

from cornell import Diffuse, Glass
from description import Camera, Light, Mesh, Scene, Sphere
from lineup import BOUNCES
from shapes import ball, box, facing, moved, quad, room

METAL = Diffuse((0.25, 0.22, 0.2))
WALL = Diffuse((0.7, 0.68, 0.62))
# Half the lantern's width, the height of its panes, where it stands.
HALF, TALL, X, Y, Z = 0.07, 0.2, 0.1, 0.751, -0.3
POST, PANE = 0.008, 0.003


def scene() -> Scene:
    """A table in a closed room."""
    flame: list[Light] = [Sphere(moved(X, Y + 0.1, Z), 0.008, (60000.0, 40000.0, 18000.0))]
    return Scene(
        [*shell(), *things(), *lantern()],
        flame,
        Camera(facing((0.5, 1.25, 1.7), (0.05, 0.9, -0.4)), 52.0),
        width=192,
        height=144,
        bounces=BOUNCES,
    )


def shell() -> list[Mesh]:
    """All six sides."""
    left = quad("left", [(-1.6, 0, 2.0), (-1.6, 0, -2.0), (-1.6, 2.4, -2.0), (-1.6, 2.4, 2.0)], WALL)
    return [*room(1.6, 2.0, 2.4, Diffuse((0.4, 0.3, 0.2)), Diffuse((0.8, 0.8, 0.8)), WALL), left]


def things() -> list[Mesh]:
    """What throws shadows beside the lantern."""
    return [
        box("table", (0.0, 0.7, -0.3), (1.2, 0.1, 0.8), Diffuse((0.42, 0.25, 0.12))),
        box("book", (-0.3, 0.79, -0.25), (0.22, 0.07, 0.16), Diffuse((0.15, 0.28, 0.45)), 25.0),
        ball("apple", (0.36, 0.811, -0.12), 0.06, Diffuse((0.6, 0.12, 0.08))),
    ]


def lantern() -> list[Mesh]:
    """Base, roof, posts, and between the posts the panes, solid and parallel."""
    corners = [(x, z) for x in (-HALF, HALF) for z in (-HALF, HALF)]
    posts = [box(f"post {i}", (X + x, Y + 0.012 + TALL / 2, Z + z), (POST, TALL, POST), METAL) for i, (x, z) in enumerate(corners)]
    wide = 2 * HALF - POST
    panes = []
    for i, (x, z) in enumerate([(HALF, 0.0), (-HALF, 0.0), (0.0, HALF), (0.0, -HALF)]):
        size = (PANE if x else wide, TALL, PANE if z else wide)
        panes.append(box(f"pane {i}", (X + x, Y + 0.012 + TALL / 2, Z + z), size, Glass(1.5)))
    plates = [
        box("base", (X, Y + 0.006, Z), (2 * HALF + 0.03, 0.012, 2 * HALF + 0.03), METAL),
        box("roof", (X, Y + 0.018 + TALL, Z), (2 * HALF + 0.03, 0.012, 2 * HALF + 0.03), METAL),
        box("candle", (X, Y + 0.047, Z), (0.03, 0.07, 0.03), Diffuse((0.8, 0.75, 0.65))),
    ]
    return [*plates, *posts, *panes]

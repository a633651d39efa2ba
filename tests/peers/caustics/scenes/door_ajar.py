"""A dark room gets its light from a bright one, through a door that is ajar."""

import math

from cornell import Diffuse
from description import Camera, Light, Mesh, Rectangle, Scene
from lineup import BOUNCES
from shapes import ball, box, downward, facing, moved, placed, quad

WALL = Diffuse((0.72, 0.70, 0.66))
DARK = Diffuse((0.55, 0.6, 0.7))
# The wall between the rooms is at z = 0; the door is hinged at the left of its opening.
LEFT, RIGHT, TOP, HEIGHT, THICK = -0.45, 0.45, 2.05, 2.6, 0.12
AJAR_DEG = 18.0


def scene() -> Scene:
    """In the dark room, z > 0."""
    lamp: list[Light] = [Rectangle(downward(0.0, HEIGHT - 0.002, -1.8), 0.6, 0.6, (9000.0, 8400.0, 7600.0), (0.8, 0.8, 0.8))]
    view = Camera(facing((1.3, 1.5, 3.2), (-0.35, 0.95, 0.2)), 60.0)
    return Scene([*rooms(), *partition(), *things()], lamp, view, width=192, height=144, bounces=BOUNCES)


def rooms() -> list[Mesh]:
    """One shell about both."""
    x, back, front, h = 1.8, -3.6, 3.6, HEIGHT
    return [
        quad("floor", [(-x, 0, front), (x, 0, front), (x, 0, back), (-x, 0, back)], Diffuse((0.4, 0.3, 0.2))),
        quad("ceiling", [(-x, h, back), (x, h, back), (x, h, front), (-x, h, front)], Diffuse((0.8, 0.8, 0.8))),
        quad("back", [(-x, 0, back), (x, 0, back), (x, h, back), (-x, h, back)], WALL),
        quad("front", [(x, 0, front), (-x, 0, front), (-x, h, front), (x, h, front)], DARK),
        quad("left", [(-x, 0, front), (-x, 0, back), (-x, h, back), (-x, h, front)], WALL),
        quad("right", [(x, 0, back), (x, 0, front), (x, h, front), (x, h, back)], WALL),
    ]


def partition() -> list[Mesh]:
    """The wall with its opening and the door, turned into the dark room."""
    width = RIGHT - LEFT - 0.01
    leaf = box("door", (width / 2, TOP / 2, 0.02), (width, TOP - 0.01, 0.04), Diffuse((0.45, 0.28, 0.15)))
    x = 1.8
    return [
        box("wall left", ((LEFT - x) / 2, HEIGHT / 2, 0.0), (LEFT + x, HEIGHT, THICK), DARK),
        box("wall right", ((RIGHT + x) / 2, HEIGHT / 2, 0.0), (x - RIGHT, HEIGHT, THICK), DARK),
        box("lintel", (0.0, (TOP + HEIGHT) / 2, 0.0), (RIGHT - LEFT, HEIGHT - TOP, THICK), DARK),
        placed(leaf, moved(LEFT + 0.005, 0.0, THICK / 2, -AJAR_DEG)),
    ]


def things() -> list[Mesh]:
    """On the floor of the dark room."""
    side = 0.5 / math.sqrt(2.0)
    return [
        box("crate", (-1.1, 0.26, 1.2), (side, 0.518, side), Diffuse((0.5, 0.35, 0.2)), 20.0),
        ball("ball", (0.35, 0.221, 1.0), 0.22, Diffuse((0.7, 0.3, 0.2))),
        ball("other ball", (-0.4, 0.151, 1.9), 0.15, Diffuse((0.75, 0.75, 0.75))),
    ]

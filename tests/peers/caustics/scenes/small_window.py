"""Daylight through a small window: the sun falls on the floor beside it, the sky through it, all else is light from there."""

import numpy
from cornell import Diffuse
from description import Camera, Mesh, Scene, Sun
from lineup import BOUNCES
from shapes import ball, box, facing, quad

WALL = Diffuse((0.72, 0.7, 0.66))
X, Z, H, THICK = 2.0, 3.0, 2.6, 0.15
# The window in the wall at x = -X: its middle along z, its width, sill and head.
PLACE, WIDE, SILL, HEAD = -1.2, 0.8, 0.9, 1.9
SKY = (3200.0, 4000.0, 5600.0)


def scene() -> Scene:
    """Seen from the far corner, along the wall of the window."""
    sun = Sun(facing((-3.0, 4.2, -1.6), (0.0, 0.0, 0.0)), 0.53, (1.2e9, 1.1e9, 0.95e9))
    sky = numpy.zeros((16, 32, 3), "f4")
    sky[:8] = SKY
    view = Camera(facing((1.5, 1.5, 2.7), (-0.4, 0.9, -0.6)), 62.0)
    return Scene([*shell(), *window_wall(), *things()], [sun], view, environment=sky, width=192, height=144, bounces=BOUNCES)


def shell() -> list[Mesh]:
    """All sides but that of the window, as thick as it: the sun is outside."""
    ceiling = box("ceiling", (0.0, H + THICK / 2, 0.0), (2 * (X + THICK), THICK, 2 * (Z + THICK)), Diffuse((0.8, 0.8, 0.8)))
    floor = box("floor", (0.0, -THICK / 2, 0.0), (2 * (X + THICK), THICK, 2 * (Z + THICK)), Diffuse((0.4, 0.3, 0.2)))
    right = box("right", (X + THICK / 2, H / 2, 0.0), (THICK, H, 2 * (Z + THICK)), WALL)
    ends = [box(f"end {side}", (0.0, H / 2, side * (Z + THICK / 2)), (2 * X, H, THICK), WALL) for side in (-1, 1)]
    return [ceiling, floor, right, *ends]


def window_wall() -> list[Mesh]:
    """Four blocks about the opening."""
    x, low, high = -X - THICK / 2, PLACE - WIDE / 2, PLACE + WIDE / 2
    end = Z + THICK
    return [
        box("window back", (x, H / 2, (low - end) / 2), (THICK, H, low + end), WALL),
        box("window front", (x, H / 2, (high + end) / 2), (THICK, H, end - high), WALL),
        box("window below", (x, SILL / 2, PLACE), (THICK, SILL, WIDE), WALL),
        box("window above", (x, (HEAD + H) / 2, PLACE), (THICK, H - HEAD, WIDE), WALL),
    ]


def things() -> list[Mesh]:
    """A table in the shade."""
    return [
        box("table", (0.4, 0.72, -1.6), (1.0, 0.04, 0.8), Diffuse((0.5, 0.36, 0.22))),
        ball("ball", (0.3, 0.89, -1.6), 0.15, Diffuse((0.7, 0.3, 0.2))),
        quad("mat", [(-0.2, 0.002, 0.8), (0.8, 0.002, 0.8), (0.8, 0.002, -0.2), (-0.2, 0.002, -0.2)], Diffuse((0.2, 0.35, 0.3))),
    ]

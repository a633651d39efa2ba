"""A pool in the sun: waves over tiles, all that is under water lit and seen through its surface."""

import numpy
from cornell import Diffuse, Glass
from description import Camera, Light, Mesh, Scene, Sun
from lineup import BOUNCES
from shapes import box, facing, quad, sheet, smoothed

# Half the width and depth of the basin, how far its floor and the water's surface are below the deck, metres.
X, Z, FLOOR, WATER = 2.0, 1.5, -1.3, -0.15
TILE = 0.25
SUN = (1.55e9, 1.45e9, 1.3e9)


def scene() -> Scene:
    """From the edge of the pool."""
    sun: list[Light] = [Sun(facing((-0.5, 1.3, 0.35), (0.0, 0.0, 0.0)), 0.53, SUN)]
    meshes = [*floor(), *basin(), *deck(), water()]
    return Scene(meshes, sun, Camera(facing((0.7, 1.7, 2.6), (-0.1, -0.9, -0.2)), 48.0), width=192, height=144, bounces=BOUNCES)


def floor() -> list[Mesh]:
    """Tiles of two colours."""
    found: list[list[numpy.ndarray]] = [[], []]
    for row in range(round(2 * Z / TILE)):
        for column in range(round(2 * X / TILE)):
            x, z = -X + column * TILE, -Z + row * TILE
            corners = [(x, FLOOR, z + TILE), (x + TILE, FLOOR, z + TILE), (x + TILE, FLOOR, z), (x, FLOOR, z)]
            found[(row + column) % 2].append(numpy.array(corners))
    colours = [(0.3, 0.55, 0.62), (0.62, 0.68, 0.66)]
    return [tiles(f"tiles {k}", numpy.array(corners), Diffuse(colours[k])) for k, corners in enumerate(found)]


def tiles(name: str, corners: numpy.ndarray, surface: Diffuse) -> Mesh:
    """Squares (K, 4, 3) of one surface."""
    first = 4 * numpy.arange(len(corners), dtype="i4")[:, None]
    triangles = numpy.concatenate([first + numpy.array([0, 1, 2], "i4"), first + numpy.array([0, 2, 3], "i4")])
    return Mesh(name, corners.reshape(-1, 3).astype("f4"), triangles, surface)


def basin() -> list[Mesh]:
    """Its four walls."""
    wall = Diffuse((0.5, 0.6, 0.62))
    return [
        quad("far", [(-X, FLOOR, -Z), (X, FLOOR, -Z), (X, 0, -Z), (-X, 0, -Z)], wall),
        quad("near", [(X, FLOOR, Z), (-X, FLOOR, Z), (-X, 0, Z), (X, 0, Z)], wall),
        quad("left", [(-X, FLOOR, Z), (-X, FLOOR, -Z), (-X, 0, -Z), (-X, 0, Z)], wall),
        quad("right", [(X, FLOOR, -Z), (X, FLOOR, Z), (X, 0, Z), (X, 0, -Z)], wall),
    ]


def deck() -> list[Mesh]:
    """Boards around it, a diving board above."""
    stone = Diffuse((0.55, 0.52, 0.46))
    a, b = X + 1.5, Z + 1.5
    return [
        quad("deck far", [(-a, 0, -Z), (a, 0, -Z), (a, 0, -b), (-a, 0, -b)], stone),
        quad("deck near", [(-a, 0, b), (a, 0, b), (a, 0, Z), (-a, 0, Z)], stone),
        quad("deck left", [(-a, 0, Z), (-X, 0, Z), (-X, 0, -Z), (-a, 0, -Z)], stone),
        quad("deck right", [(X, 0, Z), (a, 0, Z), (a, 0, -Z), (X, 0, -Z)], stone),
        box("board", (-1.5, 0.4, -0.5), (1.4, 0.06, 0.4), Diffuse((0.7, 0.25, 0.15))),
    ]


def water() -> Mesh:
    """A surface from wall to wall, and a little into them; up is out of the water."""
    z, x = numpy.meshgrid(numpy.linspace(Z + 0.01, -Z - 0.01, 241), numpy.linspace(-X - 0.01, X + 0.01, 321), indexing="ij")
    height = numpy.full_like(x, WATER)
    random = numpy.random.default_rng(4)
    for _ in range(24):
        length, heading, phase = random.uniform(0.25, 1.1), random.uniform(0.0, 2 * numpy.pi), random.uniform(0.0, 2 * numpy.pi)
        height += 0.0035 * length * numpy.sin(2 * numpy.pi / length * (x * numpy.cos(heading) + z * numpy.sin(heading)) + phase)
    return smoothed(sheet("water", numpy.stack([x, height, z], axis=2), Glass(1.33)))

"""A hall of 1,000 bays with ten small lights each, evenly spaced; the camera stands in one bay, whose walls keep the others' light out."""

import numpy
from cornell import Diffuse
from description import Camera, Disk, Light, Mesh, Scene
from shapes import ball, box, downward, facing, moved, quad

# Metres a bay is wide, deep and high; bays along x and z.
SIDE, HEIGHT = 5.0, 3.0
COLUMNS, ROWS = 40, 25
WHITE = Diffuse((0.7, 0.7, 0.7))
RADIANCE = (9000.0, 8200.0, 7000.0)


def scene() -> Scene:
    """All 10,000 lights are on."""
    return built([(column, row) for column in range(COLUMNS) for row in range(ROWS)])


def bay() -> Scene:
    """Only the ten of the camera's own bay are on."""
    return built([(COLUMNS // 2, ROWS // 2)])


def built(lit: list[tuple[int, int]]) -> Scene:
    """The hall with the lights of some bays; the camera's bay is about the origin."""
    lights = [light for column, row in lit for light in ceiling(*middle(column, row))]
    camera = Camera(facing((1.9, 1.7, 2.1), (-0.8, 0.9, -1.0)), 60.0)
    return Scene([*shell(), *things()], lights, camera)


def middle(column: int, row: int) -> tuple[float, float]:
    """Where a bay's middle lies."""
    return SIDE * (column - COLUMNS // 2), SIDE * (row - ROWS // 2)


def ceiling(x: float, z: float) -> list[Light]:
    """A bay's ten lights, 2 by 5."""
    places = [(x + SIDE * (i - 0.5) / 2, z + SIDE * (j - 2) / 5) for i in (0, 1) for j in range(5)]
    return [Disk(downward(light_x, HEIGHT - 0.01, light_z), 0.06, RADIANCE) for light_x, light_z in places]


def shell() -> list[Mesh]:
    """Floor and ceiling of the whole hall, and walls between all bays."""
    (x0, z0), (x1, z1) = middle(0, 0), middle(COLUMNS - 1, ROWS - 1)
    x0, z0, x1, z1 = x0 - SIDE / 2, z0 - SIDE / 2, x1 + SIDE / 2, z1 + SIDE / 2
    along = box("wall", (0.0, HEIGHT / 2, 0.0), (x1 - x0, HEIGHT, 0.05), WHITE)
    across = box("partition", (0.0, HEIGHT / 2, 0.0), (0.05, HEIGHT, z1 - z0), WHITE)
    rows = numpy.stack([moved((x0 + x1) / 2, 0, z0 + SIDE * k) for k in range(ROWS + 1)])
    columns = numpy.stack([moved(x0 + SIDE * k, 0, (z0 + z1) / 2) for k in range(COLUMNS + 1)])
    return [
        quad("floor", [(x0, 0, z1), (x1, 0, z1), (x1, 0, z0), (x0, 0, z0)], Diffuse((0.4, 0.33, 0.25))),
        quad("ceiling", [(x0, HEIGHT, z0), (x1, HEIGHT, z0), (x1, HEIGHT, z1), (x0, HEIGHT, z1)], WHITE),
        Mesh(along.name, along.points, along.triangles, along.surface, places=rows),
        Mesh(across.name, across.points, across.triangles, across.surface, places=columns),
    ]


def things() -> list[Mesh]:
    """What stands in the camera's bay."""
    return [
        box("desk", (-0.9, 0.376, -0.9), (1.6, 0.75, 0.8), Diffuse((0.45, 0.28, 0.15)), 10.0),
        ball("ball", (-0.9, 0.96, -0.9), 0.2, Diffuse((0.7, 0.2, 0.15)), 4),
        box("column", (1.2, 0.901, -1.5), (0.5, 1.8, 0.5), Diffuse((0.2, 0.4, 0.5)), 30.0),
    ]

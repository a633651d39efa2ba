"""A street of houses under a sun and a panorama of the sky."""

import numpy
from cornell import Diffuse
from description import Camera, Mesh, Scene, Sun
from shapes import box, facing, sheet, sky

TOWARD_SUN = (0.55, 0.5, 0.3)
PLAIN = Diffuse((0.5, 0.5, 0.5))


def scene() -> Scene:
    """Two rows of houses with recessed windows; the camera stands in the street."""
    sun = Sun(facing(TOWARD_SUN, (0.0, 0.0, 0.0)), 0.53, (1.1e9, 1.0e9, 0.85e9))
    camera = Camera(facing((0.0, 1.7, 30.0), (0.0, 3.0, 0.0)), 55.0)
    return Scene([road(), *houses()], [sun], camera, sky(TOWARD_SUN, glow=40_000.0))


def road() -> Mesh:
    """80 by 80 m."""
    x, z = numpy.meshgrid([-40.0, 40.0], [40.0, -40.0])
    return sheet("road", numpy.stack([x, numpy.zeros_like(x), z], axis=2), Diffuse((0.18, 0.18, 0.17)))


def joined(name: str, boxes: list[Mesh], surface: Diffuse) -> Mesh:
    """One mesh of many."""
    firsts = numpy.cumsum([0, *(len(each.points) for each in boxes[:-1])])
    triangles = numpy.concatenate([each.triangles + first for each, first in zip(boxes, firsts, strict=True)])
    return Mesh(name, numpy.concatenate([each.points for each in boxes]), triangles.astype("i4"), surface)


def houses() -> list[Mesh]:
    """Eight on either side, in three colours, with sills under dark panes."""
    random = numpy.random.default_rng(3)
    walls: list[list[Mesh]] = [[], [], []]
    sills, panes = [], []
    for row, side in ((k, s) for k in range(8) for s in (-1.0, 1.0)):
        height, depth, z = random.uniform(6, 11), random.uniform(7, 9), 24.0 - 8.0 * row
        middle = (side * (6.0 + depth / 2), height / 2, z)
        walls[int(random.integers(3))].append(box("wall", middle, (depth, height, 7.2), PLAIN))
        for floor, along in ((f, a) for f in range(int(height // 3)) for a in (-2.2, 0.0, 2.2)):
            sills.append(box("sill", (side * 5.88, 1.05 + 3 * floor, z + along), (0.24, 0.1, 1.4), PLAIN))
            panes.append(box("pane", (side * 5.99, 1.8 + 3 * floor, z + along), (0.02, 1.4, 1.0), PLAIN))
    colours = [(0.6, 0.5, 0.38), (0.55, 0.3, 0.22), (0.7, 0.68, 0.62)]
    made = [joined(f"walls {k}", boxes, Diffuse(colours[k])) for k, boxes in enumerate(walls) if boxes]
    return [*made, joined("sills", sills, Diffuse((0.7, 0.7, 0.7))), joined("panes", panes, Diffuse((0.04, 0.05, 0.06)))]

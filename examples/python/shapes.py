"""Shapes, and a finished picture, which several of these examples share. Lengths are metres, y is up."""

from __future__ import annotations

from collections.abc import Sequence

import gonio
import numpy
from numpy.typing import NDArray

Point = tuple[float, float, float]
Matrix = Sequence[Sequence[float]]


def at(x: float, y: float, z: float, degrees: float = 0.0) -> list[list[float]]:
    """A translation after a turn about y."""
    cosine, sine = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
    return [[cosine, 0, sine, x], [0, 1, 0, y], [-sine, 0, cosine, z], [0, 0, 0, 1]]


def quad(scene: gonio.Scene, corners: Sequence[Point], material: int) -> None:
    """A flat quadrilateral, u from its first corner to the second."""
    uvs = numpy.array([[0, 0], [1, 0], [1, 1], [0, 1]], "f4")
    mesh = scene.add_mesh(numpy.array(corners, "f4"), numpy.array([[0, 1, 2], [0, 2, 3]], "i4"), uvs=uvs)
    scene.add_instance(mesh, [material])


def box(scene: gonio.Scene, low: Point, high: Point) -> int:
    """A block between two corners; gives the mesh's number."""
    corners = numpy.array([(x, y, z) for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])], "f4")
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [triangle for a, b, c, d in sides for triangle in ((a, b, c), (a, c, d))]
    return scene.add_mesh(corners, numpy.array(triangles, "i4"))


def put_box(scene: gonio.Scene, low: Point, high: Point, material: int, transform: Matrix | None = None) -> None:
    """The same, placed."""
    scene.add_instance(box(scene, low, high), [material], transform=transform)


def lathe(scene: gonio.Scene, profile: Sequence[tuple[float, float]], sides: int = 128) -> int:
    """A turned body from (radius, height), bottom first for an outside, with smooth normals; gives the mesh's number."""
    radius, height = numpy.array(profile, "f8").T
    angle = 2 * numpy.pi * numpy.arange(sides) / sides
    slope = numpy.stack([numpy.gradient(height), -numpy.gradient(radius)], axis=-1)
    slope /= numpy.maximum(numpy.linalg.norm(slope, axis=-1, keepdims=True), 1e-9)

    def turned(r: NDArray[numpy.float64], y: NDArray[numpy.float64]) -> NDArray[numpy.float32]:
        x, z = r[:, None] * numpy.cos(angle), r[:, None] * numpy.sin(angle)
        return numpy.stack([x, numpy.broadcast_to(y[:, None], x.shape), z], axis=-1).reshape(-1, 3).astype("f4")

    ring, side = numpy.meshgrid(numpy.arange(len(profile) - 1), numpy.arange(sides), indexing="ij")
    a, b = ring * sides + side, ring * sides + (side + 1) % sides
    triangles = numpy.stack([b, a, a + sides, b, a + sides, b + sides], axis=-1).reshape(-1, 3).astype("i4")
    return scene.add_mesh(turned(radius, height), triangles, normals=turned(slope[:, 0], slope[:, 1]))


def round_profile(points: Sequence[tuple[float, float]], steps: int = 12) -> list[tuple[float, float]]:
    """A profile through points, rounded between them (Catmull and Rom)."""
    p = numpy.array([points[0], *points, points[-1]], "f8")
    t = numpy.linspace(0, 1, steps, endpoint=False)[:, None]
    parts = [
        0.5 * (2 * b + (c - a) * t + (2 * a - 5 * b + 4 * c - d) * t**2 + (3 * b - a - 3 * c + d) * t**3)
        for a, b, c, d in zip(p, p[1:], p[2:], p[3:], strict=False)
    ]
    return [(max(float(r), 0.0), float(y)) for r, y in [*numpy.concatenate(parts), p[-1]]]


def noise(rows: int, columns: int, cells: int, seed: int, octaves: int = 4) -> NDArray[numpy.float64]:
    """Soft noise from 0 to 1 that repeats at its edges."""
    random = numpy.random.default_rng(seed)
    total = numpy.zeros((rows, columns))
    for octave in range(octaves):
        count = cells * 2**octave
        grid = random.random((count, count))
        y, x = numpy.meshgrid(numpy.arange(rows) * count / rows, numpy.arange(columns) * count / columns, indexing="ij")
        i, j = y.astype(int), x.astype(int)
        u, v = y - i, x - j
        u, v = u * u * (3 - 2 * u), v * v * (3 - 2 * v)
        low = grid[i % count, j % count] * (1 - v) + grid[i % count, (j + 1) % count] * v
        high = grid[(i + 1) % count, j % count] * (1 - v) + grid[(i + 1) % count, (j + 1) % count] * v
        total += (low * (1 - u) + high * u) / 2**octave
    total -= total.min()
    scaled: NDArray[numpy.float64] = total / total.max()
    return scaled


def finished(
    scene: gonio.Scene, path: str, *, exposure: float = 0.0, white: float = 6.0, adapted: float | None = None, apart: bool = True
) -> gonio.Film:
    """Renders, takes the noise out where pyoidn is there, and writes the picture, by an exposure or as an eye sees it that is adapted to so many cd/m²;
    `apart` keeps lamps that are seen out of the denoising."""
    passes = ["color", "illuminance", "luminance", "denoising_albedo", "denoising_normal", *(["denoising_light"] if apart else [])]
    # The sky that is seen covers what is behind, as in a photograph.
    scene.set(passes=passes, film_transparent=False)
    with gonio.Render(scene) as render:
        render.wait()
        film = render.film()
    try:
        film = gonio.denoise(film)
    except gonio.UnsupportedError as error:
        print(error)
    if adapted is None:
        film.write_picture(path, exposure=exposure, white=white)
    else:
        film.write_picture(path, adapted=adapted)
    return film

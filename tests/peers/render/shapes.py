"""Meshes, frames and images that scenes are built of."""

import dataclasses
import math
from collections.abc import Sequence

import numpy
from cornell import refined
from description import Mesh, Surface

Vector = Sequence[float] | numpy.ndarray
OCTAHEDRON = numpy.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], "f8")
OCTANTS = numpy.array([(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)], "i4")


def facing(position: Vector, target: Vector, up: Vector = (0.0, 1.0, 0.0)) -> numpy.ndarray:
    """A frame at a position whose -z points at a target."""
    backward = unit(numpy.subtract(position, target))
    right = unit(numpy.cross(up, backward))
    matrix = numpy.eye(4)
    matrix[:3, :] = numpy.stack([right, numpy.cross(backward, right), backward, position], axis=1)
    return matrix


def downward(x: float, y: float, z: float) -> numpy.ndarray:
    """A frame whose -z points down."""
    return facing((x, y, z), (x, y - 1.0, z), up=(0.0, 0.0, 1.0))


def moved(x: float, y: float, z: float, turn_deg: float = 0.0, scale: float = 1.0) -> numpy.ndarray:
    """Scales, turns about y, then moves."""
    cosine, sine = scale * math.cos(math.radians(turn_deg)), scale * math.sin(math.radians(turn_deg))
    return numpy.array([[cosine, 0, sine, x], [0, scale, 0, y], [-sine, 0, cosine, z], [0, 0, 0, 1]])


def unit(vector: Vector) -> numpy.ndarray:
    """A vector made unit."""
    length = float(numpy.linalg.norm(vector))
    return numpy.asarray(vector, "f8") / length


def quad(name: str, corners: Sequence[Vector], surface: Surface) -> Mesh:
    """A quadrilateral, counter-clockwise from the texture's lower left corner."""
    uvs = numpy.array([(0, 0), (1, 0), (1, 1), (0, 1)], "f4")
    return Mesh(name, numpy.array(corners, "f4"), numpy.array([(0, 1, 2), (0, 2, 3)], "i4"), surface, uvs)


def room(half_width: float, half_depth: float, height: float, floor: Surface, ceiling: Surface, wall: Surface) -> list[Mesh]:
    """A room about the vertical, seen from inside, without the wall at -x."""
    x, z, h = half_width, half_depth, height
    return [
        quad("floor", [(-x, 0, z), (x, 0, z), (x, 0, -z), (-x, 0, -z)], floor),
        quad("ceiling", [(-x, h, -z), (x, h, -z), (x, h, z), (-x, h, z)], ceiling),
        quad("back", [(-x, 0, -z), (x, 0, -z), (x, h, -z), (-x, h, -z)], wall),
        quad("front", [(x, 0, z), (-x, 0, z), (-x, h, z), (x, h, z)], wall),
        quad("right", [(x, 0, -z), (x, 0, z), (x, h, z), (x, h, -z)], wall),
    ]


def box(name: str, centre: Vector, size: Vector, surface: Surface, turn_deg: float = 0.0) -> Mesh:
    """A closed box about its centre, turned about y."""
    corners = numpy.array([(x, y, z) for x in (-0.5, 0.5) for y in (-0.5, 0.5) for z in (-0.5, 0.5)]) * size
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = numpy.array([triangle for a, b, c, d in faces for triangle in ((a, b, c), (a, c, d))], "i4")
    x, y, z = centre
    place = moved(x, y, z, turn_deg)
    return Mesh(name, (corners @ place[:3, :3].T + place[:3, 3]).astype("f4"), triangles, surface)


def ball(name: str, centre: Vector, radii: float | Vector, surface: Surface, subdivisions: int = 4) -> Mesh:
    """An octahedron refined towards an ellipsoid: 8 * 4^subdivisions triangles."""
    points, triangles = OCTAHEDRON, OCTANTS
    for _ in range(subdivisions):
        points, triangles = refined(points, triangles)
    return Mesh(name, (points * radii + centre).astype("f4"), triangles.astype("i4"), surface)


def sheet(name: str, points: numpy.ndarray, surface: Surface, *, closed: bool = False) -> Mesh:
    """A grid of points (rows, columns, 3); the front is where columns × rows points. `closed` joins the last column to the first."""
    rows, columns, _ = points.shape
    number = numpy.arange(rows * columns, dtype="i4").reshape(rows, columns)
    if closed:
        number = numpy.concatenate([number, number[:, :1]], axis=1)
    a, b, c, d = (part.ravel() for part in (number[:-1, :-1], number[:-1, 1:], number[1:, 1:], number[1:, :-1]))
    triangles = numpy.concatenate([numpy.stack([a, b, c], axis=1), numpy.stack([a, c, d], axis=1)])
    v, u = numpy.meshgrid(numpy.linspace(0, 1, rows), numpy.linspace(0, 1, columns), indexing="ij")
    uvs = numpy.stack([u, v], axis=2).reshape(-1, 2).astype("f4")
    return Mesh(name, points.reshape(-1, 3).astype("f4"), triangles, surface, uvs)


def smoothed(mesh: Mesh) -> Mesh:
    """The mesh with normals at its points, means of its faces' by area; points at the same place share theirs."""
    a, b, c = (mesh.points[mesh.triangles[:, k]].astype("f8") for k in range(3))
    _, place = numpy.unique(numpy.round(mesh.points.astype("f8"), 7), axis=0, return_inverse=True)
    sums = numpy.zeros((place.max() + 1, 3))
    for k in range(3):
        numpy.add.at(sums, place.ravel()[mesh.triangles[:, k]], numpy.cross(b - a, c - a))
    normals = (sums / numpy.linalg.norm(sums, axis=1, keepdims=True))[place.ravel()]
    return dataclasses.replace(mesh, normals=normals.astype("f4"))


def placed(mesh: Mesh, matrix: numpy.ndarray) -> Mesh:
    """The mesh moved and turned by a frame, points and normals."""
    points = (mesh.points @ matrix[:3, :3].T + matrix[:3, 3]).astype("f4")
    normals = None if mesh.normals is None else (mesh.normals @ matrix[:3, :3].T).astype("f4")
    return dataclasses.replace(mesh, points=points, normals=normals)


def lathed(name: str, profile: numpy.ndarray, centre: Vector, surface: Surface, segments: int = 96) -> Mesh:
    """A profile of (radius, height), upwards on the outside, turned about the vertical through `centre`."""
    angle = -2.0 * numpy.pi * numpy.arange(segments) / segments
    radius, height = profile[:, :1], profile[:, 1:]
    points = numpy.stack([radius * numpy.cos(angle), height + 0.0 * angle, radius * numpy.sin(angle)], axis=2)
    return sheet(name, points + numpy.asarray(centre), surface, closed=True)


def directions(height: int) -> numpy.ndarray:
    """Unit vectors (height, 2 height, 3) of the pixels of a latitude-longitude image."""
    latitude = numpy.pi * (0.5 - (numpy.arange(height) + 0.5) / height)[:, None]
    longitude = 2.0 * numpy.pi * (0.5 - (numpy.arange(2 * height) + 0.5) / (2 * height))[None, :]
    across = numpy.cos(latitude)
    x, y, z = across * numpy.sin(longitude), numpy.sin(latitude) + 0.0 * longitude, across * numpy.cos(longitude)
    return numpy.stack([x, y, z], axis=2)


def sky(toward_sun: Vector, *, height: int = 256, glow: float = 0.0, width: float = 0.02) -> numpy.ndarray:
    """A clear sky in cd/m² over dull ground, brighter at the horizon and about the sun; `glow` is the peak added there."""
    d = directions(height)
    cosine = d @ unit(toward_sun)
    up = numpy.clip(d[..., 1:2], 0.0, 1.0)
    blue = numpy.array([1500.0, 2600.0, 5200.0]) * (1.0 - 0.55 * up) + numpy.array([4200.0, 3600.0, 2600.0]) * (1.0 - up) ** 6
    ground = numpy.array([700.0, 620.0, 500.0])
    halo = numpy.array([1.0, 0.85, 0.65]) * (glow * numpy.exp((cosine - 1.0) / width) + 3000.0 * numpy.exp((cosine - 1.0) / 0.1))[..., None]
    blend = numpy.clip(d[..., 1:2] * 20.0 + 0.5, 0.0, 1.0)
    radiance: numpy.ndarray = (blue + halo) * blend + ground * (1.0 - blend)
    return radiance.astype("f4")

"""Shapes as polygons: bevelled boxes with smooth normals, and lathes, tubes and cushions as subdivision surfaces. Metres, y up."""

from dataclasses import dataclass

import numpy

Vector = tuple[float, float, float]


@dataclass
class Polygons:
    """Points (N, 3), corner indices of each face, texture coordinates a corner (in metres), normals a point (none: subdivision)."""

    points: numpy.ndarray
    faces: list[list[int]]
    uvs: numpy.ndarray
    normals: numpy.ndarray | None = None


def translation(x: float, y: float, z: float) -> numpy.ndarray:
    """A matrix for column vectors."""
    matrix = numpy.eye(4)
    matrix[:3, 3] = x, y, z
    return matrix


def rotation(axis: str, degrees: float) -> numpy.ndarray:
    """A turn about x, y or z, counterclockwise."""
    cosine, sine = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
    i, j = {"x": (1, 2), "y": (2, 0), "z": (0, 1)}[axis]
    matrix = numpy.eye(4)
    matrix[i, i] = matrix[j, j] = cosine
    matrix[i, j], matrix[j, i] = -sine, sine
    return matrix


def transformed(polygons: Polygons, matrix: numpy.ndarray) -> Polygons:
    """The polygons moved by a rigid matrix."""
    turn = matrix[:3, :3]
    normals = None if polygons.normals is None else polygons.normals @ turn.T
    return Polygons(polygons.points @ turn.T + matrix[:3, 3], polygons.faces, polygons.uvs, normals)


def face_uv(point: numpy.ndarray, axis: int, along: int) -> tuple[float, float]:
    """Texture coordinates on a face across `axis`, u along the axis `along`."""
    across = 3 - axis - along
    return point[along], point[across]


def box(centre: Vector, size: Vector, bevel: float = 0.003) -> Polygons:
    """A box whose edges are cut by `bevel` and shaded round; u runs along each face's longer side."""
    half = numpy.array(size) / 2
    bevel = min(bevel, 0.45 * min(size))
    corners = [numpy.array([(i >> 2 & 1) * 2 - 1, (i >> 1 & 1) * 2 - 1, (i & 1) * 2 - 1]) for i in range(8)]
    points, normals = [], []
    for corner in corners:
        for axis in range(3):
            inset = numpy.full(3, bevel)
            inset[axis] = 0
            points.append(corner * (half - inset))
            normals.append(corner * (numpy.arange(3) == axis))
    points, normals = numpy.array(points), numpy.array(normals, float)
    faces, axes = box_faces(corners, points)
    offset = numpy.array([centre[0] * 7.31 + centre[1] * 3.7, centre[2] * 5.13 + centre[1] * 1.9]) % 1
    uvs = []
    for face, axis in zip(faces, axes):
        sides = [side for side in range(3) if side != axis]
        along = max(sides, key=lambda side: size[side])
        uvs += [numpy.array(face_uv(points[i], axis, along)) + offset for i in face]
    return Polygons(points + numpy.array(centre), faces, numpy.array(uvs), normals)


def box_faces(corners: list[numpy.ndarray], points: numpy.ndarray) -> tuple[list[list[int]], list[int]]:
    """Six sides, twelve bevels and eight corners, each turned outwards, and the axis on whose side each is mapped."""
    faces, axes = [], []
    for axis in range(3):
        for sign in (-1, 1):
            faces.append([3 * i + axis for i, corner in enumerate(corners) if corner[axis] == sign])
            axes.append(axis)
    for axis in range(3):
        first, second = (side for side in range(3) if side != axis)
        for a in (-1, 1):
            for b in (-1, 1):
                ends = [i for i, corner in enumerate(corners) if corner[first] == a and corner[second] == b]
                faces.append([3 * i + side for i in ends for side in (first, second)])
                axes.append(first)
    for i in range(8):
        faces.append([3 * i, 3 * i + 1, 3 * i + 2])
        axes.append(0)
    return [outward(face, points) for face in faces], axes


def outward(face: list[int], points: numpy.ndarray) -> list[int]:
    """The corners of a convex face in counterclockwise order as seen from outside a shape about the origin."""
    middle = points[face].mean(axis=0)
    normal = middle / numpy.linalg.norm(middle)
    x_axis = numpy.cross(normal, numpy.eye(3)[numpy.argmin(abs(normal))])
    y_axis = numpy.cross(normal, x_axis)
    angles = [numpy.arctan2(numpy.dot(points[i] - middle, y_axis), numpy.dot(points[i] - middle, x_axis)) for i in face]
    return [face[i] for i in numpy.argsort(angles)]


def sheet(corner: Vector, u_side: Vector, v_side: Vector, in_metres: bool = False) -> Polygons:
    """A rectangle from its lower left corner; it faces u × v. Texture coordinates go from 0 to 1, or in metres."""
    corner, u_side, v_side = (numpy.array(vector, float) for vector in (corner, u_side, v_side))
    points = numpy.array([corner, corner + u_side, corner + u_side + v_side, corner + v_side])
    normal = numpy.cross(u_side, v_side)
    width, height = (numpy.linalg.norm(u_side), numpy.linalg.norm(v_side)) if in_metres else (1.0, 1.0)
    uvs = numpy.array([[0, 0], [width, 0], [width, height], [0, height]])
    return Polygons(points, [[0, 1, 2, 3]], uvs, numpy.tile(normal / numpy.linalg.norm(normal), (4, 1)))


def ring_factor(count: int) -> float:
    """By which Catmull–Clark shrinks a ring of points."""
    return 2 / 3 + numpy.cos(2 * numpy.pi / count) / 3


def lathe(profile: list[tuple[float, float]], count: int = 16) -> Polygons:
    """A profile of (radius, height), from the bottom up along the outside, turned about y. Radii of 0 close it."""
    angles = numpy.arange(count) / count * 2 * numpy.pi
    circle = numpy.stack([numpy.cos(angles), numpy.zeros(count), -numpy.sin(angles)], axis=1) / ring_factor(count)
    points, rings = [], []
    for radius, height in profile:
        start = len(points)
        if radius == 0:
            points.append(numpy.array([0, height, 0]))
            rings.append([start] * count)
        else:
            points += list(circle * radius + [0, height, 0])
            rings.append(list(range(start, start + count)))
    faces, uvs = [], []
    for row, (low, high) in enumerate(zip(rings, rings[1:])):
        for i in range(count):
            j = (i + 1) % count
            corners = [(low[i], i, row), (low[j], i + 1, row), (high[j], i + 1, row + 1), (high[i], i, row + 1)]
            kept = [corner for n, corner in enumerate(corners) if corner[0] != corners[n - 1][0]]
            faces.append([corner[0] for corner in kept])
            uvs += [(corner[1] / count, profile[corner[2]][1]) for corner in kept]
    return Polygons(numpy.array(points), faces, numpy.array(uvs))


def tube(path: list[Vector], radius: float, count: int = 8, end_radius: float | None = None) -> Polygons:
    """A round bar with closed ends along a path that the subdivision smooths."""
    path = numpy.array(path, float)
    first, last = path[0], path[-1]
    towards, back = path[1] - path[0], path[-2] - path[-1]
    inset = radius * 0.15
    inner = [first + towards / numpy.linalg.norm(towards) * inset], [last + back / numpy.linalg.norm(back) * inset]
    path = numpy.concatenate([[first], inner[0], path[1:-1], inner[1], [last]])
    radii = numpy.linspace(radius, radius if end_radius is None else end_radius, len(path)) / ring_factor(count)
    side = numpy.cross(path[1] - path[0], [0.31, 0.87, 0.38])
    angles = numpy.arange(count) / count * 2 * numpy.pi
    points = []
    for i, place in enumerate(path):
        tangent = path[min(i + 1, len(path) - 1)] - path[max(i - 1, 0)]
        tangent /= numpy.linalg.norm(tangent)
        side = side - numpy.dot(side, tangent) * tangent
        side /= numpy.linalg.norm(side)
        other = numpy.cross(tangent, side)
        points += [place + radii[i] * (numpy.cos(angle) * side + numpy.sin(angle) * other) for angle in angles]
    faces = []
    for row in range(len(path) - 1):
        for i in range(count):
            j = (i + 1) % count
            faces.append([row * count + i, row * count + j, (row + 1) * count + j, (row + 1) * count + i])
    end = (len(path) - 1) * count
    faces += [list(range(count))[::-1], list(range(end, end + count))]
    uvs = numpy.zeros((sum(map(len, faces)), 2))
    return Polygons(numpy.array(points), faces, uvs)


def cushion(size: Vector, edge: float, shape=None) -> Polygons:
    """A box about the origin that the subdivision rounds over `edge`; `shape` moves its points (N, 3) afterwards."""
    stops = []
    for length in size:
        half = length / 2
        stops.append([-half, -half + edge, 0.0, half - edge, half] if half > 2 * edge else [-half, -half * 0.4, half * 0.4, half])
    index, points, faces, uvs = {}, [], [], []

    def point(key: tuple[int, int, int]) -> int:
        if key not in index:
            index[key] = len(points)
            points.append([stops[axis][key[axis]] for axis in range(3)])
        return index[key]

    for axis in range(3):
        first, second = (axis + 1) % 3, (axis + 2) % 3
        for level, is_high in ((0, False), (len(stops[axis]) - 1, True)):
            for i in range(len(stops[first]) - 1):
                for j in range(len(stops[second]) - 1):
                    cells = [(i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)]
                    cells = cells if is_high else cells[::-1]
                    keys = []
                    for a, b in cells:
                        key = [0, 0, 0]
                        key[axis], key[first], key[second] = level, a, b
                        keys.append(tuple(key))
                        uvs.append((stops[first][a], stops[second][b]))
                    faces.append([point(key) for key in keys])
    points = numpy.array(points)
    return Polygons(points if shape is None else shape(points), faces, numpy.array(uvs))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Values that Cycles computes of a mesh for the Geometry and Wireframe nodes, and attributes of edges as values of points."""

import numpy as np

from .random_number import of_words
from .transforms import unit

# Corners of a triangle in Blender's Parametric coordinates.
PARAMETRIC_CORNERS = np.array([(1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 0.0)], dtype=np.float32)


def edges_of(mesh):
    """The two points of each edge."""
    edges = np.empty((len(mesh.edges), 2), dtype=np.int32)
    mesh.edges.foreach_get("vertices", edges.reshape(-1))
    return edges


def pointiness(points, normals, edges):
    """How a mesh bulges: the angle between each point's normal and the mean direction of its edges as a share of a half turn, smoothed once
    over the neighbours; points that lie on one another count as one."""
    _, first, number = np.unique(points + 0.0, axis=0, return_index=True, return_inverse=True)
    number, count = number.reshape(-1), len(first)
    summed = np.stack([np.bincount(number, normals[:, axis], minlength=count) for axis in range(3)], axis=1)
    pairs = np.unique(np.sort(number[edges], axis=1), axis=0)
    along = unit(points[first][pairs[:, 1]].astype(float) - points[first][pairs[:, 0]])
    ends = np.concatenate([pairs[:, 0], pairs[:, 1]])
    neighbours = np.bincount(ends, minlength=count)
    means = [np.bincount(ends, np.concatenate([along[:, axis], -along[:, axis]]), minlength=count) for axis in range(3)]
    mean = np.stack(means, axis=1) / np.maximum(neighbours, 1)[:, None]
    cosine = np.clip(np.einsum("ij,ij->i", unit(summed), mean), -1.0, 1.0)
    raw = np.where(neighbours > 0, np.arccos(cosine) / np.pi, 0.0)
    around = np.bincount(ends, np.concatenate([raw[pairs[:, 1]], raw[pairs[:, 0]]]), minlength=count)
    return ((raw + around) / (neighbours + 1))[number].astype(np.float32)


def islands(count, edges):
    """A random number for each point, the same for all that edges connect: that of the root of a union by rank, edge after edge."""
    parents, ranks = list(range(count)), [0] * count

    def root(point):
        while parents[point] != point:
            parents[point] = point = parents[parents[point]]
        return point

    for one, other in edges.tolist():
        one, other = root(one), root(other)
        if one != other:
            if ranks[one] < ranks[other]:
                one, other = other, one
            parents[other] = one
            ranks[one] += ranks[one] == ranks[other]
    roots = np.array([root(point) for point in range(count)], dtype=np.int64)
    known, place = np.unique(roots, return_inverse=True)
    return np.array([of_words(int(each)) / 0xFFFFFFFF for each in known], dtype=np.float32)[place.reshape(-1)]


def edges_to_points(values, edges, count, data_type):
    """Values of edges as values of points, as Blender carries them over: means of those around, or whether one of them is true."""
    ends = edges.reshape(-1)
    each = np.repeat(values.astype(float), 2, axis=0)
    around = np.maximum(np.bincount(ends, minlength=count), 1)[:, None]
    mean = np.stack([np.bincount(ends, column, minlength=count) for column in each.T], axis=1) / around
    if data_type == "BOOLEAN":
        return (mean > 0.0).astype(np.float32)
    return np.round(mean) if data_type in ("INT", "INT8") else mean.astype(np.float32)


def apart(arguments):
    """The arguments of `put_mesh` with corners that no two triangles share, so that each triangle may have values of its own."""
    triangles, corners, points = (arguments[name] for name in ("triangles", "corners", "points"))
    order, per_corner = triangles.reshape(-1), len(points) if corners is None else len(corners)
    # The scene tells points from corners by their number.
    is_spread = corners is None or len(order) == len(points)
    of_points = order if corners is None else corners[order]

    def gathered(values):
        if values is None:
            return None
        if len(values) == per_corner:
            return np.ascontiguousarray(values[order])
        return np.ascontiguousarray(values[of_points]) if is_spread else values

    return {
        **arguments,
        "points": np.ascontiguousarray(points[of_points]) if is_spread else points,
        "triangles": np.arange(len(order), dtype=np.int32).reshape(-1, 3),
        "corners": None if is_spread else np.ascontiguousarray(of_points),
        "normals": gathered(arguments["normals"]),
        "primvars": {name: gathered(values) for name, values in arguments["primvars"].items()},
    }


def corner_points(arguments, number):
    """Of each corner the position of its triangle's first, second or third corner."""
    corners = arguments["triangles"] if arguments["corners"] is None else arguments["corners"][arguments["triangles"]]
    return np.repeat(arguments["points"][corners[:, number]], 3, axis=0)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Arrays of a grid's numbers, and where they stand."""

from dataclasses import dataclass

import numpy as np

# Points that are looked at together.
AT_ONCE = 1 << 17


def carried(matrix, points):
    """Points (N, 3) by an affine matrix."""
    return points @ matrix[:3, :3].T + matrix[:3, 3]


def filling(low, high, shape):
    """From the middles of so many boxes, which have whole numbers, to the larger box that they fill."""
    matrix, edges = np.eye(4), (high - low) / np.array(shape)
    matrix[:3, :3], matrix[:3, 3] = np.diag(edges), low + 0.5 * edges
    return matrix


def corners(mesh):
    """The least and the greatest coordinates of a mesh's points; None where it has none."""
    points = np.empty((len(mesh.vertices), 3), dtype=np.float32)
    mesh.vertices.foreach_get("co", points.reshape(-1))
    return (points.min(axis=0).astype(float), points.max(axis=0).astype(float)) if len(points) else None


@dataclass(frozen=True, eq=False)
class Dense:
    """Numbers (nx, ny, nz), or vectors (nx, ny, nz, 3), at whole coordinates, and the matrix from there to the object's space. Beyond its outer
    faces there is nothing."""

    values: np.ndarray
    to_object: np.ndarray

    @property
    def shape(self):
        """Points along the axes."""
        return self.values.shape[:3]

    @property
    def count(self):
        """All points."""
        return int(np.prod(self.shape))

    def is_like(self, other):
        """Whether another has the same points."""
        return self.shape == other.shape and np.allclose(self.to_object, other.to_object, rtol=1e-5, atol=1e-7)

    def rows(self, rows):
        """Four numbers for each of some points: a number in the first three, 1 in the last."""
        values = self.values.reshape(self.count, -1)[rows].astype(np.float32)
        return np.concatenate([np.broadcast_to(values, (len(rows), 3)), np.ones((len(rows), 1), np.float32)], axis=1)

    def points(self, rows):
        """Places of some points, (N, 3), in the object's space."""
        lattice = np.stack(np.unravel_index(rows, self.shape), axis=1).astype(float)
        return carried(self.to_object, lattice)

    def shares(self, points):
        """Where places of the object's space are in the box of all that these fill, 0 to 1."""
        return (carried(np.linalg.inv(self.to_object), points) + 0.5) / np.array(self.shape)

    def on(self, other):
        """Its numbers at the points of another lattice, trilinear."""
        if self.is_like(other):
            return self
        inverse = np.linalg.inv(self.to_object)
        vectors = self.values.reshape(*self.shape, -1)
        found = np.zeros((other.count, vectors.shape[3]), dtype=np.float32)
        for start in range(0, other.count, AT_ONCE):
            rows = np.arange(start, min(start + AT_ONCE, other.count))
            found[rows] = _trilinear(vectors, carried(inverse, other.points(rows)))
        return Dense(found.reshape(*other.shape, *self.values.shape[3:]), other.to_object)


def _trilinear(values, places):
    edge = np.array(values.shape[:3])
    inside = ((places >= -0.5) & (places <= edge - 0.5)).all(axis=1)
    places = np.clip(places, 0.0, edge - 1.0)
    low = np.minimum(np.floor(places).astype(int), np.maximum(edge - 2, 0))
    high = np.minimum(low + 1, edge - 1)
    share = places - low
    total = np.zeros((len(places), values.shape[3]))
    for corner in range(8):
        upper = np.array([corner >> axis & 1 for axis in range(3)], dtype=bool)
        x, y, z = np.where(upper, high, low).T
        total += np.prod(np.where(upper, share, 1.0 - share), axis=1)[:, None] * values[x, y, z]
    return total * inside[:, None]

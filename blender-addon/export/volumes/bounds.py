# SPDX-License-Identifier: GPL-3.0-or-later
"""The box of a mesh, and the points in it at which a volume shader that varies is asked."""

from dataclasses import dataclass

import numpy as np

from .lattice import Dense, corners, filling

# Points along the longest edge, as many as Cycles looks at to know how dense such volumes are at most.
ALONG = 128
# By what share of its longest edge the box of the points is wider than the mesh on each side.
WIDER = 1e-3
# What stands in for the name of a grid: no attribute has it.
NAMELESS = ""


@dataclass(frozen=True, eq=False)
class Within(Dense):
    """Points in a mesh, whose generated coordinates are those of its texture space: its lower corner and its edges."""

    corner: np.ndarray
    edges: np.ndarray

    def shares(self, points):
        """Where places of the object's space are in the texture space, 0 to 1, as Cycles has it of volumes."""
        return (points - self.corner) / self.edges


class Bounds:
    """As a volume's grids: none that a shader could ask for, on the points of a box."""

    names = {NAMELESS: None}
    # A mesh has an extent whatever its shader asks for.
    unasked = frozenset({NAMELESS})

    def __init__(self, low, high, centre, size):
        self._lattice = _lattice(low, high, centre - size, 2.0 * size)
        self.stamp = np.concatenate([low, high, centre, size]).tobytes()

    def is_scalar(self, name):
        """Numbers could be at the points."""
        return True

    def count(self, name):
        """How many points there are."""
        return self._lattice.count

    def dense(self, name):
        """The points."""
        return self._lattice

    def forget_numbers(self):
        """There are none."""


def bounds_of(group):
    """The bounds of what a group shows."""
    if group.kind == "MESH":
        return _of_mesh(group.data)
    mesh = group.source.to_mesh()
    try:
        return _of_mesh(mesh)
    finally:
        group.source.to_mesh_clear()


def _of_mesh(mesh):
    centre, size = np.array(mesh.texspace_location, dtype=float), np.array(mesh.texspace_size, dtype=float)
    return Bounds(*corners(mesh), centre, np.where(size == 0.0, 1.0, size))


def _lattice(low, high, corner, edges):
    """Points in the middles of boxes that fill a little more than the bounds."""
    longest = float((high - low).max())
    low, high = low - WIDER * longest, high + WIDER * longest
    shape = np.maximum(np.ceil(ALONG * (high - low) / (high - low).max() - 1e-6), 1).astype(int)
    return Within(np.broadcast_to(np.float32(1.0), shape), filling(low, high, shape), corner, edges)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Grids of VDB files, read by the OpenVDB module that comes with Blender where the renderer is not to read them itself."""

from dataclasses import dataclass
from functools import cached_property

import bpy
import numpy as np

from .lattice import Dense

# Before 5.0 values stood in the middle of voxels whose corners have whole numbers.
SHIFT = 0.0 if bpy.app.version >= (5, 0, 0) else 0.5


# Kinds of grids, by how the names of their classes begin.
KINDS = ("Float", "Double", "Half", "Int32", "Int64", "Bool", "Vec3S", "Vec3D", "Vec3H")


@dataclass(frozen=True)
class Told:
    """What the head of a file tells of a grid; no matrix where it is no linear one."""

    is_scalar: bool
    matrix: np.ndarray | None


class Stored:
    """The grids of a file; `stamp` is another when they are, `unasked` those that count without being asked for, `silent` those that may be lacking."""

    unasked = silent = frozenset()

    def __init__(self, path, stamp):
        self.path, self.stamp, self._dense = path, stamp, {}

    def __eq__(self, other):
        return isinstance(other, Stored) and (self.path, self.stamp) == (other.path, other.stamp)

    @cached_property
    def names(self):
        """The names of grids of numbers or vectors, the first of each name."""
        found = {}
        for grid in _openvdb().readAllGridMetadata(self.path):
            kind = type(grid).__name__
            if kind.startswith(KINDS) and grid.name not in found:
                found[grid.name] = Told(not kind.startswith("Vec3"), _matrix(grid))
        return found

    def is_scalar(self, name):
        """Whether a grid is of numbers."""
        return self.names[name].is_scalar

    def source(self, name):
        """What the scene reads a grid from."""
        return self.path, name

    def to_object(self, name):
        """From where the scene places a grid to where Blender has it."""
        matrix = self._matrix(name)
        moved = np.eye(4)
        moved[:3, 3] = matrix[:3, :3] @ np.full(3, SHIFT)
        return moved

    def are_alike(self, one, other):
        """Whether two grids have the same voxels."""
        return np.allclose(self._matrix(one), self._matrix(other), rtol=1e-6, atol=0.0)

    def highest(self, name):
        """The greatest value of a grid of numbers."""
        return float(_openvdb().read(self.path, name).evalMinMax()[1])

    def box(self, name):
        """The least voxel of a grid that holds something, and its edges in voxels, with one more on each side in which it fades."""
        low, high = self._read(name).evalActiveVoxelBoundingBox()
        return np.array(low) - 1, np.array(high) - np.array(low) + 3

    def count(self, name):
        """Voxels of the box of a grid."""
        return int(np.prod(self.box(name)[1].astype(float)))

    def dense(self, name):
        """All of a grid."""
        if name not in self._dense:
            low, edge = self.box(name)
            values = np.zeros((*edge, *(() if self.is_scalar(name) else (3,))), dtype=np.float32)
            self._read(name).copyToArray(values, ijk=tuple(int(x) for x in low))
            moved = np.eye(4)
            moved[:3, 3] = low + SHIFT
            self._dense[name] = Dense(values, self._matrix(name) @ moved)
        return self._dense[name]

    def _read(self, name):
        grid = _openvdb().read(self.path, name)
        if grid.empty() or grid.activeVoxelCount() == 0:
            raise ValueError(f"the grid '{name}' of '{self.path}' is empty")
        return grid

    def _matrix(self, name):
        if self.names[name].matrix is None:
            raise ValueError(f"the grid '{name}' has voxels that grow with distance, which are not supported")
        return self.names[name].matrix

    def forget_numbers(self):
        """Frees the memory of what was read."""
        self._dense = {}


def _openvdb():
    bpy.utils.expose_bundled_modules()
    import openvdb

    return openvdb


def _matrix(grid):
    """From a grid's voxels to the file's space."""
    if not grid.transform.isLinear:
        return None
    origin = np.array(grid.transform.indexToWorld((0, 0, 0)))
    matrix = np.eye(4)
    matrix[:3, 3] = origin
    for axis in range(3):
        matrix[:3, axis] = np.array(grid.transform.indexToWorld(tuple(int(axis == k) for k in range(3)))) - origin
    return matrix

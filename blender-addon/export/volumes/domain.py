# SPDX-License-Identifier: GPL-3.0-or-later
"""Smoke and fire of Blender's fluid simulation: grids that fill the box of their domain."""

from hashlib import blake2b

import numpy as np

from .lattice import Dense, corners, filling

# Names of grids in shaders, and components of the numbers of Blender's own arrays.
GRIDS = {"density": 1, "flame": 1, "temperature": 1, "heat": 1, "color": 4, "velocity": 3}


class Simulated:
    """The grids of a domain, and the factor on its velocities; `unasked` are those that count without being asked for, `silent` those that are there
    where they were simulated."""

    unasked, silent = frozenset(), frozenset(GRIDS)

    def __init__(self, grids, velocity_scale):
        self.names, self.velocity_scale = grids, velocity_scale
        digest = blake2b(digest_size=16)
        for name, grid in grids.items():
            digest.update(f"{name} {grid.shape}".encode())
            digest.update(np.ascontiguousarray(grid.values))
            digest.update(grid.to_object.tobytes())
        self.stamp = digest.digest()

    def __eq__(self, other):
        return isinstance(other, Simulated) and self.stamp == other.stamp

    def is_scalar(self, name):
        """Whether a grid is of numbers."""
        return self.names[name].values.ndim == 3

    def source(self, name):
        """What the scene reads a grid from."""
        return np.ascontiguousarray(self.names[name].values)

    def to_object(self, name):
        """From a grid's voxels to the object's space."""
        return self.names[name].to_object

    def are_alike(self, one, other):
        """Whether two grids have the same voxels."""
        return self.names[one].is_like(self.names[other])

    def highest(self, name):
        """The greatest value of a grid of numbers."""
        return float(self.names[name].values.max())

    def count(self, name):
        """Voxels of a grid."""
        return self.names[name].count

    def dense(self, name):
        """All of a grid."""
        return self.names[name]

    def forget_numbers(self):
        """They are all there is."""


def grids_of(thing, settings):
    """What a domain's settings hold at the frame, placed in the box of its mesh; None where nothing is simulated yet."""
    box = corners(thing.data)
    if box is None:
        return None
    coarse = tuple(settings.domain_resolution)
    fine = tuple(settings.noise_scale * edge for edge in coarse)
    found = {}
    for name, components in GRIDS.items():
        values = _numbers(getattr(settings, f"{name}_grid"))
        shape = next((shape for shape in (coarse, fine) if len(values) and len(values) == np.prod(shape) * components), None)
        if shape is not None:
            found[name] = Dense(_arranged(values, shape, components), filling(*box, shape))
    return Simulated(found, settings.velocity_scale) if found else None


def _numbers(array):
    values = np.empty(len(array), dtype=np.float32)
    if len(values):
        array.foreach_get(values)
    return values


def _arranged(values, shape, components):
    """Blender counts along x first."""
    values = values.reshape(*shape[::-1], components).transpose(2, 1, 0, 3)
    return values[..., 0] if components == 1 else values[..., :3]

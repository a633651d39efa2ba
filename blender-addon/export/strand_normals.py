# SPDX-License-Identifier: GPL-3.0-or-later
"""The normals of hair curves, along which the longer axis of an elliptic strand lies.

Blender's own `normals` cannot be read as a whole: the array is freed before it is copied (4.5 and 5.0).
"""

import numpy as np

from .mesh_attributes import read
from .transforms import unit

# The values of the attribute `normal_mode`; 0 is the least twist.
Z_UP, FREE = 1, 2


def of_curves(curves, tangents, begins, ends):
    """Unit normals (N, 3) of the points of hair curves that run from `begins` to `ends`, as Blender has them to within the turns between points."""
    tangents = unit(tangents.astype(np.float64))
    modes = _attribute(curves, "normal_mode", len(begins))
    upright = _unit_or(np.stack([tangents[:, 1], -tangents[:, 0], np.zeros(len(tangents))], axis=1), (1.0, 0.0, 0.0))
    normals = _least_twist(tangents, upright, begins, ends)
    by_point = np.repeat(modes, ends - begins)
    normals = np.where((by_point == Z_UP)[:, None], upright, normals)
    custom = curves.attributes.get("custom_normal")
    if custom is not None:
        normals = np.where((by_point == FREE)[:, None], unit(read(custom)[:, :3]), normals)
    tilt = _attribute(curves, "tilt", len(tangents))[:, None]
    return (normals * np.cos(tilt) + np.cross(tangents, normals) * np.sin(tilt)).astype(np.float32)


def _least_twist(tangents, first, begins, ends):
    """Each strand's first normal, carried from point to point."""
    normals = first.copy()
    counts = ends - begins
    for step in range(1, int(counts.max())):
        here = begins[counts > step] + step
        before, after, carried = tangents[here - 1], tangents[here], normals[here - 1]
        axis, cos = np.cross(before, after), np.sum(before * after, axis=1, keepdims=True)
        # Rodrigues' rotation without its angle.
        along = np.sum(axis * carried, axis=1, keepdims=True) / np.maximum(1.0 + cos, 1e-6)
        normals[here] = _unit_or(carried * cos + np.cross(axis, carried) + axis * along, (1.0, 0.0, 0.0))
    return normals


def _attribute(curves, name, count):
    """One number an element; zeros where there is none."""
    attribute = curves.attributes.get(name)
    return np.zeros(count) if attribute is None else read(attribute)[:count, 0]


def _unit_or(vectors, instead):
    """Vectors of length 1, and another in the place of zeros."""
    vectors = unit(vectors)
    return np.where(np.any(vectors, axis=1, keepdims=True), vectors, instead)

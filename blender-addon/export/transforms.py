# SPDX-License-Identifier: GPL-3.0-or-later
"""Matrices between Blender and the scene description, and unit vectors."""

import numpy as np


def columns(matrix):
    """A 4×4 matrix for column vectors in the form of the scene description."""
    m = np.asarray(matrix, dtype=float)
    return {"columns": [[float(m[row][column]) for row in range(3)] for column in range(4)]}


def unit(vectors):
    """Vectors (N, 3) of length 1; zeros stay."""
    lengths = np.linalg.norm(vectors, axis=1, keepdims=True)
    return vectors / np.where(lengths > 0.0, lengths, 1.0)


def without_scale(matrix):
    """A matrix whose axes have length 1."""
    m = np.array(matrix, dtype=float)
    lengths = np.linalg.norm(m[:3, :3], axis=0)
    m[:3, :3] /= np.where(lengths > 0.0, lengths, 1.0)
    return m


def usable(matrices):
    """Which of (N, 4, 4) matrices are finite and do not flatten space."""
    finite = np.isfinite(matrices).all(axis=(1, 2))
    linear = np.where(finite[:, None, None], matrices[:, :3, :3], 0.0).astype(float)
    a, b, c = linear[:, 0], linear[:, 1], linear[:, 2]
    volume = np.einsum("ij,ij->i", a, np.cross(b, c))
    return finite & (volume != 0.0)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Tangents along UV maps as MikkTSpace makes them of triangles: corners that agree in all have one, weighted by the angles around."""

import numpy as np

from .transforms import unit

# Odd factors that scatter the bits of what is hashed.
FACTORS = np.array([0x9E3779B97F4A7C15, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9], dtype=np.uint64)


def tangents(points, normals, uv, corners, triangles):
    """(corners, 4): a unit vector along u and the side of v, 1 or −1; `points` by point, `normals` and `uv` by corner."""
    place, facing, flat = points[corners[triangles]].astype(float), normals[triangles].astype(float), uv[triangles].astype(float)
    edge, other = place[:, 1] - place[:, 0], place[:, 2] - place[:, 0]
    step, step_other = flat[:, 1] - flat[:, 0], flat[:, 2] - flat[:, 0]
    area = step[:, 0] * step_other[:, 1] - step[:, 1] * step_other[:, 0]
    side = np.where(area > 0.0, 1.0, -1.0)
    along = unit(step_other[:, 1:] * edge - step[:, 1:] * other) * side[:, None]
    along[area == 0.0] = 0.0
    weighted = np.empty_like(place)
    for number in range(3):
        ahead, back = (place[:, (number + n) % 3] - place[:, number] for n in (1, 2))
        normal = facing[:, number]
        cosine = np.einsum("ij,ij->i", unit(_level(ahead, normal)), unit(_level(back, normal)))
        weighted[:, number] = unit(_level(along, normal)) * np.arccos(np.clip(cosine, -1.0, 1.0))[:, None]
    _, group = np.unique(_alike(points[corners], normals, uv)[triangles] + (side[:, None] > 0.0).astype(np.uint64), return_inverse=True)
    group = group.reshape(-1)
    summed = np.stack([np.bincount(group, weighted[..., axis].reshape(-1)) for axis in range(3)], axis=1)
    lengths = np.linalg.norm(summed, axis=1, keepdims=True)
    # Where no triangle has a direction, any will do.
    made = np.where(lengths > 0.0, summed / np.where(lengths > 0.0, lengths, 1.0), (1.0, 0.0, 0.0))
    found = np.zeros((len(corners), 4), dtype=np.float32)
    found[triangles.reshape(-1), :3] = made[group]
    found[triangles.reshape(-1), 3] = np.repeat(side, 3)
    return found


def _alike(*columns):
    """An even number for each row, the same for rows that are the same."""
    mark = np.zeros(len(columns[0]), dtype=np.uint64)
    for column in np.concatenate(columns, axis=1).astype(np.float32).T:
        mark = (mark ^ (column + 0.0).view(np.uint32).astype(np.uint64)) * FACTORS[0]
        mark ^= mark >> np.uint64(29)
        mark = mark * FACTORS[1] + FACTORS[2]
    return mark & ~np.uint64(1)


def _level(vectors, normals):
    return vectors - normals * np.einsum("ij,ij->i", vectors, normals)[:, None]

# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes told with as little as says the same, for scene and renderer keep what they are told."""

import numpy as np

# Corners that are looked at together, in a cache; numpy's own numbers for them take eight bytes each.
CHUNK = 1 << 16


def compact(arguments, *, keeps_corners=False):
    """The arguments of `put_mesh` with coordinates that are the same at all corners around every point as values of points, unless `keeps_corners`;
    with values of the corners of triangles, where those take less than how triangles find them among others."""
    corners, points = arguments["corners"], arguments["points"]
    if corners is None:
        return arguments
    found = dict(arguments)
    if not keeps_corners:
        found["primvars"] = {name: _of_points(values, corners, len(points)) for name, values in arguments["primvars"].items()}
    if len(corners) == found["triangles"].size:
        # Triangles are the faces, and their corners in order.
        found.update(triangles=corners.reshape(-1, 3), corners=None, faces=None)
    elif _is_less_in_order(found):
        order = found["triangles"].reshape(-1)
        found["primvars"] = {name: _in_order(values, order, len(corners)) for name, values in found["primvars"].items()}
        found.update(triangles=_gathered(corners, order).reshape(-1, 3), corners=None)
    return found


def _is_less_in_order(arguments):
    """Whether what belongs to corners takes less if it is told by triangles: the scene and the renderer keep its numbers and which of them a
    triangle has, the scene once for all and the renderer for each."""
    corners, count = len(arguments["corners"]), arguments["triangles"].size
    widths = [values.shape[1] for values in arguments["primvars"].values() if len(values) == corners]
    normals = arguments["normals"]
    # The scene tells points from corners by their number.
    if not widths or count == len(arguments["points"]) or (normals is not None and len(normals) == corners):
        return False
    return 2 * sum(widths) * count < 2 * sum(widths) * corners + (1 + len(widths)) * count


def _in_order(values, order, corners):
    """Values of corners as those of triangles' corners."""
    if len(values) != corners:
        return values
    return _gathered(_pairs(values), order)[:, None].view(np.float32) if values.shape[1] == 2 else np.take(values, order, axis=0)


def _gathered(values, order):
    found = np.empty(len(order), dtype=values.dtype)
    for chunk in _chunks(order):
        # Numbers of corners are Blender's own; "raise" would gather into another array first.
        np.take(values, order[chunk], out=found[chunk], mode="clip")
    return found


def _pairs(values):
    """Each pair of numbers as one, bit for bit."""
    return values.view(np.int64)[:, 0]


def _of_points(values, corners, count):
    """Pairs of numbers of points in place of those of corners; those of corners where some differ around a point, by a bit."""
    if values.shape != (len(corners), 2) or values.dtype != np.float32:
        return values
    pairs, found = _pairs(values), np.zeros(count, dtype=np.int64)
    for chunk in _chunks(corners):
        here = corners[chunk]
        found[here] = pairs[chunk]
        # Seams are seen here mostly.
        if not np.array_equal(found[here], pairs[chunk]):
            return values
    # What a later part has put there.
    agree = all(np.array_equal(found[corners[chunk]], pairs[chunk]) for chunk in _chunks(corners))
    return found[:, None].view(np.float32) if agree else values


def _chunks(array):
    return (slice(start, start + CHUNK) for start in range(0, len(array), CHUNK))

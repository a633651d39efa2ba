# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's box projection: an image from the six sides of a box, blended where the surface turns from one to the next."""

from .inputs import carried, direction, hit

# Below this, sides that meet are told apart by their order.
SHARP = 1e-6


def box_projection(t, place, blend):
    """The places in the image seen along x, y and z, and the weight of each."""
    normal = -direction(t) if t.is_world else _object_normal(t)
    x, y, z = (place.component(i) for i in range(3))
    nx, ny, nz = (normal.component(i) for i in range(3))
    zero = t.graph.scalar(0.0)
    # No side shows the image mirrored.
    sides = [
        t.graph.combine(y.mix(1.0 - y, nx.less(0.0)), z, zero),
        t.graph.combine((1.0 - x).mix(x, ny.less(0.0)), z, zero),
        t.graph.combine((1.0 - y).mix(y, nz.less(0.0)), x, zero),
    ]
    return list(zip(sides, _weights(t, [abs(nx), abs(ny), abs(nz)], blend), strict=True))


def _object_normal(t):
    return carried(t, hit(t, "Normal"), "World", "Object", "Normal").normalized()


def _weights(t, n, blend):
    """The normal as barycentric coordinates in a triangle whose corners are the sides, as in Cycles: one side near a corner, two along the
    edges, three in the middle."""
    limit = 0.5 * (1.0 + blend)
    total = n[0] + n[1] + n[2]
    n = [each / total for each in n]
    corners, left = [], t.graph.scalar(1.0)
    for i in range(3):
        j, k = (i + 1) % 3, (i + 2) % 3
        inside = ((n[i] + n[j]) * limit).less(n[i]) * ((n[i] + n[k]) * limit).less(n[i])
        corners.append(inside * left)
        left = left - corners[-1]
    if blend < SHARP:
        # Exactly between two sides the first has it all.
        return [corners[0] + left, corners[1], corners[2]]
    weights = list(corners)
    for i, j, k in ((0, 1, 2), (1, 2, 0), (0, 2, 1)):
        edge = n[k].less((n[i] + n[j]) * (1.0 - limit)) * left
        left = left - edge
        share = ((n[i] / (n[i] + n[j]) - 0.5 * (1.0 - blend)) * (1.0 / blend)).clamp()
        weights[i] = weights[i] + edge * share
        weights[j] = weights[j] + edge * (1.0 - share)
    middle = [(each * (2.0 - limit) + (limit - 1.0)) * (1.0 / (2.0 * limit - 1.0)) for each in n]
    return [weight + left * share for weight, share in zip(weights, middle, strict=True)]

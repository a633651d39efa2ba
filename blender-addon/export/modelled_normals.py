# SPDX-License-Identifier: GPL-3.0-or-later
"""Normals of meshes that are cut without smoothing (Simple subdivision) for the renderer to cut them on: those of the faces as they were
modelled, as Cycles has them. Blender gives the cut mesh those of its own faces, which bend near edges alone.

Blender keeps the modelled points first, and the parts of each face together: a face of n corners has n patches about its corners, each of as
many parts as the others. Faces of as many corners have their parts in the same order.
"""

import numpy as np


def modelled(group):
    """How many corners the faces have that a group's last modifier cuts without smoothing, and how many points they have; None for others."""
    if group.dicing is None or dict(group.dicing)["smooth"]:
        return None
    mesh = group.source.original.data
    sizes = np.empty(len(mesh.polygons), dtype=np.int32)
    mesh.polygons.foreach_get("loop_total", sizes)
    return sizes, len(mesh.vertices)


def modelled_normals(corners, normals, sizes, count):
    """Normals (N, 3) of a cut mesh's corners between the `normals` of its points, shorter than 1 there. None where it is not cut from faces of
    these sizes over the first `count` points, as modifiers before have changed them."""
    side = _side(len(corners), int(sizes.sum()))
    if side is None:
        return None
    parts, first = sizes * side**2, np.cumsum(sizes * side**2) - sizes * side**2
    cells, found = corners.reshape(-1, 4), np.empty((len(corners) // 4, 4, 3), dtype=np.float32)
    for size in np.unique(sizes):
        blocks = first[sizes == size][:, None] + np.arange(size * side**2)
        points = cells[blocks].reshape(len(blocks), -1)
        are_modelled = points < count
        places = np.flatnonzero(are_modelled[0])
        weights = _weights(cells[blocks[0]], places, side) if len(places) == size else None
        if weights is None or (are_modelled != are_modelled[0]).any():
            return None
        found[blocks] = np.einsum("ks,bsx->bkx", weights, normals[points[:, places]]).reshape(*blocks.shape, 4, 3)
    return found.reshape(-1, 3)


def _side(corners, modelled_corners):
    """How many parts a patch has along a side; None where no whole number of cuts makes so many corners."""
    side = 1
    while 4 * modelled_corners * side**2 < corners:
        side *= 2
    return side if 4 * modelled_corners * side**2 == corners and corners else None


def _weights(cells, places, side):
    """By corner of a face's parts (4 P), the weights of the face's corners, which are at some places among them; None if these are no
    patches."""
    edges = {(cell[k], cell[(k + 1) % 4]): (number, k) for number, cell in enumerate(cells.tolist()) for k in range(4)}
    try:
        patches = [_patch(cells, edges, *divmod(int(place), 4), side) for place in places]
        after, before = zip(*(_points(cells, patch, side) for patch in patches), strict=True)
        following = [before.index(point) for point in after]
    except (KeyError, ValueError):
        return None
    weights = np.zeros((cells.size, len(places)))
    for own, patch in enumerate(patches):
        behind = following.index(own)
        for (x, y), (number, turn) in patch.items():
            for k, (right, up) in enumerate([(0, 0), (1, 0), (1, 1), (0, 1)]):
                s, t = (x + right) / side, (y + up) / side
                row = np.full(len(places), s * t / len(places))
                row[own] += (1 - s) * (1 - t) + 0.5 * s * (1 - t) + 0.5 * t * (1 - s)
                row[following[own]] += 0.5 * s * (1 - t)
                row[behind] += 0.5 * t * (1 - s)
                weights[4 * number + (turn + k) % 4] = row
    # Each part is in a patch.
    return weights if (weights.sum(axis=1) > 0.5).all() else None


def _patch(cells, edges, number, turn, side):
    """The parts of the patch about a corner: by column and row the number of a part, and which of its corners is nearest."""
    patch = {}
    for y in range(side):
        here = (number, turn)
        for x in range(side):
            patch[x, y] = here
            if x + 1 < side:
                right, k = edges[_corner(cells, here, 2), _corner(cells, here, 1)]
                here = right, (k + 1) % 4
        if y + 1 < side:
            number, turn = edges[_corner(cells, (number, turn), 3), _corner(cells, (number, turn), 2)]
    return patch


def _points(cells, patch, side):
    """The points in the middle of the edges after and before a patch's corner."""
    return _corner(cells, patch[side - 1, 0], 1), _corner(cells, patch[0, side - 1], 3)


def _corner(cells, part, k):
    number, turn = part
    return int(cells[number][(turn + k) % 4])

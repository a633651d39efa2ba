"""Glass as panes: a sheet in the place of each thin box, since a pane of gonio is a whole one, both faces counted."""

from __future__ import annotations

from typing import Any

import numpy as np

# Faces within this cosine look the same way.
SAME_WAY = 0.99
# Of a box's faces, by area: the share that the two large ones have at least.
FLAT = 0.8
# A pane's rectangle is filled up to this share; a frame's is not.
FILLED = 0.9


def components(faces: Any, points: Any, items: Any) -> list[Any]:
    """Numbers of the faces that hang together: of one item, by corners at the same place."""
    _, places = np.unique(np.round(points, 6), axis=0, return_inverse=True)
    _, bodies = np.unique(items, return_inverse=True)
    corners = places.reshape(-1)[faces] + len(points) * bodies.reshape(-1, 1)
    _, corners = np.unique(corners, return_inverse=True)
    corners = corners.reshape(-1, 3)
    label = np.arange(corners.max(initial=0) + 1)
    while True:
        lower = label.copy()
        np.minimum.at(lower, corners, label[corners].min(axis=1)[:, None])
        lower = lower[lower]
        if (lower == label).all():
            break
        label = lower
    of_faces = label[corners[:, 0]]
    return [np.flatnonzero(of_faces == value) for value in np.unique(of_faces)]


def sheets(faces: Any, points: Any, items: Any) -> tuple[Any, Any]:
    """One side of each thin box and all open sheets; and, apart, what is neither."""
    kept: list[Any] = []
    thick: list[Any] = []
    for members in components(faces, points, items):
        sheet = _sheet(faces[members], points)
        (thick if sheet is None else kept).append(faces[members] if sheet is None else sheet)
    nothing = np.zeros((0, 3), faces.dtype)
    return np.concatenate([nothing, *kept]), np.concatenate([nothing, *thick])


def is_pane(faces: Any, points: Any) -> bool:
    """Whether a solid is a flat full rectangle, as glazing is: neither a bar nor a frame."""
    normals, areas = _normals(faces, points)
    sheet = _sheet(faces, points)
    if sheet is None or len(sheet) == len(faces):
        return False
    axis = normals[areas.argmax()]
    corners = points[np.unique(faces)]
    along = _longest_edge(points[sheet], axis)
    sizes = [np.ptp(corners @ direction) for direction in (along, np.cross(axis, along), axis)]
    area = areas[(normals @ axis) > SAME_WAY].sum()
    return bool(sizes[2] < 0.25 * min(sizes[:2]) and area > FILLED * sizes[0] * sizes[1])


def _sheet(faces: Any, points: Any) -> Any:
    """The faces of one side; all of an open sheet; None where the surface is no flat one."""
    normals, areas = _normals(faces, points)
    total = areas.sum()
    if total == 0.0:
        return faces[:0]
    towards = normals @ normals[areas.argmax()]
    front, back = towards > SAME_WAY, towards < -SAME_WAY
    if areas[front | back].sum() < FLAT * total:
        # Open sheets may bend.
        return None if _is_closed(faces, points) else faces
    return faces if areas[back].sum() < 0.5 * areas[front].sum() else faces[front]


def _is_closed(faces: Any, points: Any) -> bool:
    _, places = np.unique(np.round(points, 6), axis=0, return_inverse=True)
    corners = places.reshape(-1)[faces]
    edges = np.sort(np.concatenate([corners[:, [0, 1]], corners[:, [1, 2]], corners[:, [2, 0]]]), axis=1)
    _, counts = np.unique(edges, axis=0, return_counts=True)
    return bool((counts > 1).all())


def _normals(faces: Any, points: Any) -> tuple[Any, Any]:
    """Unit normals and areas."""
    a, b, c = (points[faces[:, i]] for i in range(3))
    cross = np.cross(b - a, c - a)
    lengths = np.linalg.norm(cross, axis=1)
    return cross / np.where(lengths > 0.0, lengths, 1.0)[:, None], 0.5 * lengths


def _longest_edge(triangles: Any, axis: Any) -> Any:
    """Direction of the longest edge that is not a rectangle's diagonal: the one whose box is smallest."""
    edges = (triangles - np.roll(triangles, 1, axis=1)).reshape(-1, 3)
    lengths = np.linalg.norm(edges, axis=1)
    directions = edges[lengths > 1e-6] / lengths[lengths > 1e-6][:, None]
    flat = triangles.reshape(-1, 3)
    boxes = [np.ptp(flat @ direction) * np.ptp(flat @ np.cross(axis, direction)) for direction in directions]
    return directions[int(np.argmin(boxes))]

"""Rooms as calculation grids: the floors of IfcSpace."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .notes import Notes
from .shapes import Placed

# Work plane above the floor, and the strip along walls that EN 12464-1 leaves out: 15 % of the narrower side, this at most; metres.
HEIGHT, MARGIN, SHARE = 0.75, 0.5, 0.15
# Faces of the floor lie as near to the lowest one.
STEP = 0.05
LEVEL = 0.99


@dataclass(frozen=True)
class Grid:
    """A room's work plane: a rectangle with its matrix, or triangles; margin in metres."""

    space: Any
    margin: float
    area: float
    size: tuple[float, float] | None = None
    matrix: Any = field(default=None, repr=False)
    points: Any = field(default=None, repr=False)
    faces: Any = field(default=None, repr=False)


def grid(placed: Placed, notes: Notes) -> Grid | None:
    """The grid of a space; None, told, where it has no level floor or is too narrow."""
    with notes.sound(placed.element):
        return _grid(placed, notes)
    return None


def _grid(placed: Placed, notes: Notes) -> Grid | None:
    floor = _floor(placed)
    if floor is None:
        notes.of("rooms without a level floor have no grid", placed.element)
        return None
    points, faces = floor
    area = _area(points, faces)
    border = _border(faces)
    lengths = np.linalg.norm(points[border[:, 0], :2] - points[border[:, 1], :2], axis=1)
    margin = min(MARGIN, SHARE * _width(area, float(lengths.sum())))
    longest = points[border[lengths.argmax()], :2]
    along = (longest[1] - longest[0]) / lengths.max()
    axes = np.stack([along, (-along[1], along[0])])
    flat = points[:, :2] @ axes.T
    low, size = flat.min(axis=0), np.ptp(flat, axis=0)
    plane = float(points[:, 2].mean()) + HEIGHT
    if area > 0.999 * size[0] * size[1]:
        matrix = np.eye(4)
        matrix[:2, :2] = axes.T
        matrix[:3, 3] = (*((low + 0.5 * size) @ axes), plane)
        return Grid(placed.element, margin, area, (float(size[0]), float(size[1])), matrix)
    if not _has_points(flat, faces, border, margin):
        notes.of("rooms that are too narrow for a grid have none", placed.element)
        return None
    points = np.column_stack([points[:, :2], np.full(len(points), plane)])
    return Grid(placed.element, margin, area, points=points, faces=faces)


def _floor(placed: Placed) -> tuple[Any, Any] | None:
    """Points and triangles, all facing up, of the lowest level faces."""
    points, faces = placed.points(), placed.shape.faces
    a, b, c = (points[faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    lengths = np.linalg.norm(normals, axis=1)
    level = (np.abs(normals[:, 2]) > LEVEL * lengths) & (lengths > 1e-9)
    if not level.any():
        return None
    heights = points[faces].mean(axis=1)[:, 2]
    level &= heights < heights[level].min() + STEP
    upright = np.where(normals[level, 2:] > 0.0, faces[level], faces[level][:, ::-1])
    used, numbers = np.unique(upright, return_inverse=True)
    # Corners of several faces at one place are one, so that edges between faces are none of the border.
    _, first, same = np.unique(np.round(points[used, :2], 4), axis=0, return_index=True, return_inverse=True)
    return points[used][first], same.reshape(-1)[numbers.reshape(-1, 3)]


def _area(points: Any, faces: Any) -> float:
    a, b, c = (points[faces[:, i], :2] for i in range(3))
    u, v = b - a, c - a
    return float(0.5 * np.abs(u[:, 0] * v[:, 1] - u[:, 1] * v[:, 0]).sum())


def _border(faces: Any) -> Any:
    """Edges of one triangle alone."""
    edges = np.sort(np.concatenate([faces[:, [0, 1]], faces[:, [1, 2]], faces[:, [2, 0]]]), axis=1)
    unique, counts = np.unique(edges, axis=0, return_counts=True)
    return unique[counts == 1]


def _width(area: float, perimeter: float) -> float:
    """The narrower side of the rectangle with this area and perimeter; of what is rounder than a square the square's."""
    half = 0.5 * perimeter
    rest = half * half - 4.0 * area
    return 0.5 * (half - math.sqrt(rest)) if rest > 0.0 else math.sqrt(area)


def _has_points(flat: Any, faces: Any, border: Any, margin: float) -> bool:
    """Whether gonio's lattice of EN 12464-1 has a point within the margin: 0.2 · 5^log₁₀ d metres apart, d being the longer side."""
    low, size = flat.min(axis=0) + margin, np.ptp(flat, axis=0) - 2.0 * margin
    if min(size) <= 0.0:
        return False
    d = max(size) if max(size) < 2.0 * min(size) else min(size)
    spacing = d / max(round(d / min(0.2 * 5.0 ** math.log10(d), 10.0)), 1)
    counts = np.maximum(np.round(size / spacing), 1).astype(int)
    steps = [low[i] + (np.arange(counts[i]) + 0.5) * size[i] / counts[i] for i in range(2)]
    lattice = np.stack(np.meshgrid(*steps), axis=-1).reshape(-1, 2)
    ends = flat[border]
    inside = np.zeros(len(lattice), bool)
    for corners in flat[faces]:
        sides = [_side(corners[i], corners[(i + 1) % 3], lattice) for i in range(3)]
        inside |= (np.min(sides, axis=0) > 0.0) | (np.max(sides, axis=0) < 0.0)
    for start, end in ends:
        along = end - start
        share = np.clip((lattice - start) @ along / (along @ along), 0.0, 1.0)
        inside &= np.linalg.norm(lattice - start - share[:, None] * along, axis=1) > margin
    return bool(inside.any())


def _side(start: Any, end: Any, points: Any) -> Any:
    along, to = end - start, points - start
    return along[0] * to[:, 1] - along[1] * to[:, 0]

"""Where cameras and lights stand and look."""

from __future__ import annotations

import math
from collections.abc import Sequence

from .description import numbers

# Below this sine a direction counts as that of the way up.
PARALLEL = 1e-6


def look_at(
    position: Sequence[float], target: Sequence[float], up: Sequence[float] = (0.0, 1.0, 0.0)
) -> list[list[float]]:
    """The transform of a camera or a light at a position in metres that looks, or shines, at a target; rows of a 4×4 matrix for column vectors.

    Cameras look and flat lights shine along their −z; `up` leans to their +y. Where `up` is along the line of sight, another axis takes its place.
    """
    eye, aim = numbers("position", position, 3), numbers("target", target, 3)
    back = _unit([a - b for a, b in zip(eye, aim, strict=True)])
    if back is None:
        raise ValueError(f"look_at: the position {tuple(eye)} and the target are the same point")
    upward = _unit(numbers("up", up, 3))
    if upward is None:
        raise ValueError("look_at: up has no direction")
    right = _cross(upward, back)
    if math.hypot(*right) < PARALLEL:
        # Straight up or down: the axis that is furthest from the line of sight, as a map has north.
        least = min(range(3), key=lambda axis: abs(back[axis]))
        right = _cross([float(axis == least) for axis in range(3)], back)
    right = _unit(right) or right
    columns = (right, _cross(back, right), back, eye)
    return [[column[row] for column in columns] for row in range(3)] + [[0.0, 0.0, 0.0, 1.0]]


def _cross(a: Sequence[float], b: Sequence[float]) -> list[float]:
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def _unit(v: Sequence[float]) -> list[float] | None:
    """The unit vector; None without a length."""
    length = math.hypot(*v)
    return [x / length for x in v] if 0.0 < length < math.inf else None

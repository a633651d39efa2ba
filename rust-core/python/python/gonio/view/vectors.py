"""Vectors of three numbers, as few as a camera needs."""

from __future__ import annotations

import math
from collections.abc import Sequence

Vector = tuple[float, float, float]


def vector(values: Sequence[float]) -> Vector:
    """Three numbers as a vector."""
    x, y, z = values
    return (float(x), float(y), float(z))


def add(a: Vector, b: Vector, factor: float = 1.0) -> Vector:
    """a + factor · b."""
    return (a[0] + factor * b[0], a[1] + factor * b[1], a[2] + factor * b[2])


def dot(a: Vector, b: Vector) -> float:
    """The inner product."""
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def cross(a: Vector, b: Vector) -> Vector:
    """The vector across both."""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def unit(a: Vector) -> Vector:
    """The same direction with length 1; (0, 0, 0) stays."""
    length = math.sqrt(dot(a, a))
    return (a[0] / length, a[1] / length, a[2] / length) if length > 0.0 else a


def turned(a: Vector, axis: Vector, angle: float) -> Vector:
    """Turned about an axis of length 1 by an angle in radians (Rodrigues' formula)."""
    cosine, sine = math.cos(angle), math.sin(angle)
    return add(add((a[0] * cosine, a[1] * cosine, a[2] * cosine), cross(axis, a), sine), axis, dot(axis, a) * (1.0 - cosine))

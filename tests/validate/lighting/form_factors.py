"""Illuminance of points by Lambertian emitters of luminance 1, in closed forms."""

import math
from typing import Any

import numpy


def polygon(corners: numpy.ndarray, points: numpy.ndarray, normal: numpy.ndarray) -> numpy.ndarray:
    """Lambert's formula: a polygon (n, 3) that lies above the horizon of all points (…, 3) with one normal, seen counter-clockwise from its
    front; zero behind it."""
    total = numpy.zeros(points.shape[:-1])
    for first, second in zip(corners, numpy.roll(corners, -1, axis=0), strict=True):
        a, b = first - points, second - points
        across = numpy.cross(a, b)
        length = numpy.linalg.norm(across, axis=-1)
        angle = numpy.arctan2(length, (a * b).sum(axis=-1))
        total += angle * (across @ normal) / numpy.maximum(length, 1e-300)
    return numpy.maximum(-0.5 * total, 0.0)


def corner_parallel(a: float, b: float, c: float) -> float:
    """Form factor from a point to a parallel rectangle a × b at distance c, one corner straight above it."""
    x, y = a / c, b / c
    p, q = math.sqrt(1 + x * x), math.sqrt(1 + y * y)
    return (x / p * math.atan(y / p) + y / q * math.atan(x / q)) / (2 * math.pi)


def corner_perpendicular(a: float, b: float, c: float) -> float:
    """Form factor from a point to a perpendicular rectangle of width b and height a above the point's plane at distance c."""
    x, y = a / b, c / b
    r = math.hypot(x, y)
    return (math.atan(1 / y) - y / r * math.atan(1 / r)) / (2 * math.pi)


def disk(radius: float, height: float, aside: Any) -> numpy.ndarray:
    """A parallel disk at a height, its axis `aside` of the points."""
    d2, h2, r2 = numpy.square(aside), height**2, radius**2
    return 0.5 * math.pi * (1.0 - (h2 + d2 - r2) / numpy.sqrt((h2 + d2 + r2) ** 2 - 4.0 * r2 * d2))


def sphere(radius: float, middle: Any, points: numpy.ndarray, normal: numpy.ndarray) -> numpy.ndarray:
    """A sphere wholly above the points' horizon."""
    to = numpy.asarray(middle) - points
    distance = numpy.linalg.norm(to, axis=-1)
    return math.pi * radius**2 * (to @ normal) / distance**3


def line(width: float, first: Any, second: Any, points: numpy.ndarray, normal: numpy.ndarray) -> numpy.ndarray:
    """A thin cylinder of a diameter between two places wholly above the points' horizon: ∫ width sin α cos θ / r² dx in closed form."""
    first, second = numpy.asarray(first, float), numpy.asarray(second, float)
    axis = (second - first) / numpy.linalg.norm(second - first)
    foot = first - points - ((first - points) @ axis)[..., None] * axis
    p = numpy.linalg.norm(foot, axis=-1)
    start, end = (first - points) @ axis, (second - points) @ axis

    # With t along the axis from the foot, r² = p² + t², sin α = p / r and cos θ = (foot · n + t axis · n) / r.
    def upright(t: numpy.ndarray) -> numpy.ndarray:
        return t / (2 * p**2 * (p**2 + t**2)) + numpy.arctan(t / p) / (2 * p**3)

    def along(t: numpy.ndarray) -> numpy.ndarray:
        return -1.0 / (2 * (p**2 + t**2))

    return width * p * ((foot @ normal) * (upright(end) - upright(start)) + (axis @ normal) * (along(end) - along(start)))


def clipped(subject: numpy.ndarray, window: numpy.ndarray, normal: numpy.ndarray) -> numpy.ndarray:
    """The part of a convex polygon inside of another in the same plane, both counter-clockwise about a normal (Sutherland and Hodgman)."""
    part = list(subject)
    for first, second in zip(window, numpy.roll(window, -1, axis=0), strict=True):
        inward = numpy.cross(normal, second - first)
        kept: list[numpy.ndarray] = []
        for a, b in zip(part, part[1:] + part[:1], strict=True):
            da, db = (a - first) @ inward, (b - first) @ inward
            if da >= 0:
                kept.append(a)
            if (da < 0) != (db < 0):
                kept.append(a + (b - a) * (da / (da - db)))
        part = kept
        if not part:
            break
    return numpy.array(part).reshape(-1, 3)

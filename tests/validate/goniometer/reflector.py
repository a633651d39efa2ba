"""A sphere of even luminance in the focus of a parabolic mirror, seen from afar.

Light that leaves along ω came, before a mirror's place at the distance d from the focus, from the sphere if ω is within asin(a / d) of the
axis. With d = f + r² / 4f that is a disk of the mirror about the vertex, seen from afar as its rim's disk at cos γ. The sphere itself adds
L π a², less what the rim hides. Rays followed backward over the exact paraboloid, with as many reflections as there are, hold the formula.
"""

import numpy
from expected import Expected
from luminaires import BULB, FOCUS, LUMENS, REFLECTANCE, RIM
from optics import across, mirrored, strata, towards

LUMINANCE = LUMENS / (4 * numpy.pi**2 * BULB**2)


def closed_form(gamma: numpy.ndarray) -> numpy.ndarray:
    """Candela up to 60°, where nothing hides the sphere."""
    angle = numpy.radians(gamma)
    lit = 4 * FOCUS * (BULB / numpy.maximum(numpy.sin(angle), 1e-9) - FOCUS)
    area = numpy.pi * numpy.clip(lit, 0.0, RIM**2) * numpy.cos(angle)
    result: numpy.ndarray = LUMINANCE * (numpy.pi * BULB**2 + REFLECTANCE * area)
    return result


def sphere_met(origin: numpy.ndarray, direction: numpy.ndarray, reach: numpy.ndarray) -> numpy.ndarray:
    """Whether rays meet the sphere within a distance."""
    along = -(origin * direction).sum(axis=1)
    near = along - numpy.sqrt(numpy.maximum(BULB**2 - (origin**2).sum(axis=1) + along**2, 0))
    nearest = ((origin + along[:, None] * direction) ** 2).sum(axis=1)
    result: numpy.ndarray = (nearest < BULB**2) & (near > 1e-9) & (near < reach)
    return result


def mirror_met(origin: numpy.ndarray, direction: numpy.ndarray) -> numpy.ndarray:
    """Distances to the paraboloid within its rim; inf without one."""
    a = (direction[:, :2] ** 2).sum(axis=1) / (4 * FOCUS)
    b = (origin[:, :2] * direction[:, :2]).sum(axis=1) / (2 * FOCUS) + direction[:, 2]
    c = (origin[:, :2] ** 2).sum(axis=1) / (4 * FOCUS) + origin[:, 2] - FOCUS
    root = numpy.sqrt(numpy.maximum(b * b - 4 * a * c, 0))
    # Stable for rays along the axis, where a is 0.
    q = -0.5 * (b + numpy.where(b < 0, -1.0, 1.0) * root)
    best = numpy.full(len(origin), numpy.inf)
    for t in (
        numpy.divide(q, a, out=numpy.full_like(q, numpy.inf), where=a > 1e-12),
        numpy.divide(c, q, out=numpy.full_like(q, numpy.inf), where=q != 0),
    ):
        place = origin[:, :2] + numpy.where(numpy.isfinite(t), t, 0)[:, None] * direction[:, :2]
        good = (b * b >= 4 * a * c) & numpy.isfinite(t) & (t > 1e-9) & ((place**2).sum(axis=1) <= RIM**2)
        best = numpy.where(good & (t < best), t, best)
    return best


def traced(gamma: float, count: int = 400, batches: int = 8, seed: int = 1) -> tuple[float, float]:
    """Candela by rays backward, and their standard error. The sphere hides nothing."""
    generator = numpy.random.default_rng(seed)
    view = towards(gamma)
    right, up = across(view)
    side = 1.25 * RIM
    results = []
    for _ in range(batches):
        place = (2 * strata(count, generator) - 1) * side
        origin = view + place[:, :1] * right + place[:, 1:] * up
        direction = numpy.broadcast_to(-view, origin.shape).copy()
        weight, sum_ = numpy.ones(len(origin)), 0.0
        for _ in range(20):
            reach = mirror_met(origin, direction)
            sum_ += float((weight * sphere_met(origin, direction, reach)).sum())
            on = numpy.isfinite(reach)
            origin, direction, weight = origin[on] + reach[on, None] * direction[on], direction[on], weight[on] * REFLECTANCE
            if len(origin) == 0:
                break
            normal = numpy.concatenate([origin[:, :2] / (2 * FOCUS), numpy.ones((len(origin), 1))], axis=1)
            # The outside of the mirror reflects too.
            direction = mirrored(direction, normal / numpy.linalg.norm(normal, axis=1)[:, None])
        results.append(LUMINANCE * sum_ * (2 * side) ** 2 / count**2)
    return float(numpy.mean(results)), float(numpy.std(results, ddof=1) / batches**0.5)


def expected() -> Expected:
    """By the closed form up to 60°, by rays beyond."""
    polar = numpy.arange(0.0, 180.01, 0.25)
    candela, error = closed_form(polar), numpy.zeros(len(polar))
    for i in numpy.flatnonzero(polar > 60):
        if polar[i] % 2.5 == 0:
            candela[i], error[i] = traced(float(polar[i]), count=200, batches=4)
    kept = (polar <= 60) | (polar % 2.5 == 0)
    how = "closed form to 60°, rays backward over the exact paraboloid beyond"
    return Expected(how, numpy.zeros(1), polar[kept], candela[None, kept], error[None, kept])


if __name__ == "__main__":
    for angle in (0, 3, 7, 9, 12, 15, 18, 30, 60, 75, 85, 100, 120, 150, 180):
        print(angle, float(closed_form(numpy.array(float(angle)))), *traced(float(angle)))

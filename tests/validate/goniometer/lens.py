"""A disk near the focus of a plano-convex lens, seen from afar: rays backward through the exact sphere and plane.

Each ray splits in two at each interface by Fresnel's law of unpolarised light until its weight is below a millionth. A ray that meets the
disk's face brings its luminance. What reaches the eye past the lens is integrated over the disk. The lens is the part of a ball above
nothing but its plane, so a ray outside meets it once, and what it throws back never comes again.
"""

import numpy
from expected import Expected
from luminaires import CHIP, CURVE, INDEX, LENS_RADIUS, LUMENS, PLANE, SAG
from optics import across, dot, mirrored, reflectance, refracted, strata, towards

LUMINANCE = LUMENS / (numpy.pi**2 * CHIP**2)
MIDDLE = numpy.array([0.0, 0.0, -PLANE - SAG + CURVE])
FAINT = 1e-6
# Rays that go round near the sharp rim are let go of after so many reflections.
LONGEST = 100


def spans(origin: numpy.ndarray, direction: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """Where lines go into and out of the lens, and whether each is through the plane; in > out where they miss it."""
    offset = origin - MIDDLE
    b, c = dot(offset, direction), dot(offset, offset) - CURVE**2
    square = b * b - c
    root = numpy.sqrt(numpy.maximum(square, 0))
    with numpy.errstate(divide="ignore", invalid="ignore"):
        flat = (-PLANE - origin[:, 2]) / direction[:, 2]
    up = direction[:, 2] > 0
    below = origin[:, 2] < -PLANE
    level = direction[:, 2] == 0
    # The half space under the plane: up to it going up, from it on going down.
    first = numpy.where(level, numpy.where(below, -numpy.inf, numpy.inf), numpy.where(up, -numpy.inf, flat))
    last = numpy.where(level, numpy.where(below, numpy.inf, -numpy.inf), numpy.where(up, flat, numpy.inf))
    enters, leaves = numpy.maximum(-b - root, first), numpy.minimum(-b + root, last)
    missed = square <= 0
    return numpy.where(missed, 1.0, enters), numpy.where(missed, 0.0, leaves), first > -b - root, last < -b + root


def normals(place: numpy.ndarray, through_plane: numpy.ndarray) -> numpy.ndarray:
    """Outward."""
    return numpy.where(through_plane[:, None], [0.0, 0.0, 1.0], (place - MIDDLE) / CURVE)


def disk_met(origin: numpy.ndarray, direction: numpy.ndarray) -> numpy.ndarray:
    """Whether rays outside meet the disk's face, which looks down."""
    rising = direction[:, 2] > 1e-12
    t = -origin[:, 2] / numpy.where(rising, direction[:, 2], 1.0)
    place = origin[:, :2] + t[:, None] * direction[:, :2]
    result: numpy.ndarray = rising & (t > 0) & ((place**2).sum(axis=1) < CHIP**2)
    return result


def inside(origin: numpy.ndarray, direction: numpy.ndarray, weight: numpy.ndarray) -> float:
    """Weighted rays in the lens that at last meet the disk."""
    total = 0.0
    for _ in range(LONGEST):
        _, t, _, flat = spans(origin + 1e-12 * direction, direction)
        place = origin + t[:, None] * direction
        normal = normals(place, flat)
        share = reflectance(dot(direction, normal), 1 / INDEX)
        out = share < 1
        outward = refracted(direction[out], -normal[out], 1 / INDEX)
        total += float((weight[out] * (1 - share[out]) * disk_met(place[out], outward)).sum())
        on = weight * share > FAINT
        origin, direction, weight = place[on], mirrored(direction[on], normal[on]), (weight * share)[on]
        if not on.any():
            break
    return total


def through(gamma: float, count: int, generator: numpy.random.Generator) -> float:
    """Candela by way of the lens."""
    view = towards(gamma)
    right, up = across(view)
    side = 1.02 * LENS_RADIUS
    place = (2 * strata(count, generator) - 1) * side
    origin = view + [0.0, 0.0, -PLANE] + place[:, :1] * right + place[:, 1:] * up
    direction = numpy.broadcast_to(-view, origin.shape)
    enters, leaves, flat, _ = spans(origin, direction)
    met = enters < leaves
    place, direction, flat = origin[met] + enters[met, None] * direction[met], direction[met], flat[met]
    normal = normals(place, flat)
    share = reflectance(-dot(direction, normal), INDEX)
    total = float((share * disk_met(place, mirrored(direction, normal))).sum())
    total += inside(place, refracted(direction, normal, INDEX), 1 - share)
    return LUMINANCE * total * (2 * side / count) ** 2


def past(gamma: float, count: int, generator: numpy.random.Generator) -> float:
    """Candela that the disk sends past the lens."""
    view = towards(gamma)
    if view[2] >= 0:
        return 0.0
    u = strata(count, generator)
    r, angle = CHIP * numpy.sqrt(u[:, 0]), 2 * numpy.pi * u[:, 1]
    origin = numpy.stack([r * numpy.cos(angle), r * numpy.sin(angle), 0 * r], -1)
    enters, leaves, _, _ = spans(origin, numpy.broadcast_to(view, origin.shape))
    return float(LUMINANCE * numpy.pi * CHIP**2 * -view[2] * (1 - (enters < leaves).mean()))


def intensity(gamma: float, count: int = 200, batches: int = 4, seed: int = 1) -> tuple[float, float]:
    """Candela and their standard error."""
    generator = numpy.random.default_rng(seed)
    results = [through(gamma, count, generator) + past(gamma, count, generator) for _ in range(batches)]
    return float(numpy.mean(results)), float(numpy.std(results, ddof=1) / batches**0.5)


def expected() -> Expected:
    """Fine where the beam and the rim's shadow are."""
    polar = numpy.concatenate([numpy.arange(0.0, 30.0, 0.25), numpy.arange(30.0, 180.01, 2.5)])
    both = numpy.array([intensity(float(gamma)) for gamma in polar])
    return Expected("rays backward through the exact sphere and plane", numpy.zeros(1), polar, both[None, :, 0], both[None, :, 1])

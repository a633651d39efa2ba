"""A plate that is lit by its edge: light sent into the box fills its white dots, and rays backward from afar find them.

First, light paths from the strip go through the box and leave on each patch of a dot what they bring there. Dots are Lambertian, so this is
all there is to know of them. Then rays backward, from all over a rectangle across the view, go on to the first dot and take its
luminance; of what passes the lit edge on their way some meets the strip's face. The strip hides nothing. `by_chance` follows rays backward
from dot to dot all the way to the strip, without patches; it is slower and holds the figures.
"""

from collections.abc import Callable

import numpy
from expected import Expected
from luminaires import DOT, DOT_REFLECTANCE, EDGE_REFLECTANCE, GAP, GUIDE, GUIDE_INDEX, LUMENS, PITCH, STRIP
from optics import reflectance

LUMINANCE = LUMENS / (numpy.pi * STRIP[0] * STRIP[1])
LOW = numpy.array([-0.5 * GUIDE[0], -0.5 * GUIDE[1], 0.0])
HIGH = -LOW + numpy.array([0.0, 0.0, GUIDE[2]])
# Patches along a dot's side, and dots along the plate's.
PATCHES = 4
DOTS = round(GUIDE[0] / PITCH), round(GUIDE[1] / PITCH)
# Degrees of C and γ that a value stands for.
CELL = 10.0, 5.0
# Rays whose weight is below this go on with it, as many as make up for it.
FAINT = 0.02
# What comes of rays on white dots: weights to go on with, given their numbers, places and weights.
Dotted = Callable[[numpy.ndarray, numpy.ndarray, numpy.ndarray], numpy.ndarray]


def strip_met(origin: numpy.ndarray, direction: numpy.ndarray) -> numpy.ndarray:
    """Whether rays outside meet the strip's face, which looks to +x."""
    back = direction[:, 0] < -1e-12
    t = (-0.5 * GUIDE[0] - GAP - origin[:, 0]) / numpy.where(back, direction[:, 0], -1.0)
    y, z = origin[:, 1] + t * direction[:, 1], origin[:, 2] + t * direction[:, 2]
    result: numpy.ndarray = back & (t > 0) & (numpy.abs(y) < 0.5 * STRIP[0]) & (numpy.abs(z - 0.5 * GUIDE[2]) < 0.5 * STRIP[1])
    return result


def on_dot(place: numpy.ndarray) -> numpy.ndarray:
    """Whether places of the upper face are white."""
    off = [numpy.abs((place[:, k] - LOW[k]) % PITCH - 0.5 * PITCH) for k in (0, 1)]
    result: numpy.ndarray = (off[0] < 0.5 * DOT) & (off[1] < 0.5 * DOT)
    return result


def patch(place: numpy.ndarray) -> numpy.ndarray:
    """Numbers of the patches of white places; both halves of the plate, y and −y, share theirs."""
    numbers = []
    for k in (0, 1):
        dot = numpy.clip(((place[:, k] - LOW[k]) // PITCH).astype(int), 0, DOTS[k] - 1)
        within = (place[:, k] - LOW[k]) % PITCH - 0.5 * (PITCH - DOT)
        numbers.append(dot * PATCHES + numpy.clip((within * (PATCHES / DOT)).astype(int), 0, PATCHES - 1))
    rows = DOTS[1] * PATCHES
    result: numpy.ndarray = numbers[0] * rows + numpy.minimum(numbers[1], rows - 1 - numbers[1])
    return result


def scattered(count: int, generator: numpy.random.Generator) -> numpy.ndarray:
    """Directions down from a white dot, by the cosine."""
    u = generator.random((count, 2))
    r, angle = numpy.sqrt(u[:, 0]), 2 * numpy.pi * u[:, 1]
    return numpy.stack([r * numpy.cos(angle), r * numpy.sin(angle), -numpy.sqrt(1 - u[:, 0])], -1)


def followed(
    origin: numpy.ndarray, direction: numpy.ndarray, weight: numpy.ndarray, generator: numpy.random.Generator, dotted: Dotted
) -> numpy.ndarray:
    """Follows what faces throw back of rays in the plate; gives what of each meets the strip through the lit edge."""
    found = numpy.zeros(len(origin))
    number = numpy.arange(len(origin))
    while len(origin):
        with numpy.errstate(divide="ignore"):
            t = numpy.where(direction > 0, HIGH - origin, LOW - origin) / direction
        t = numpy.where(numpy.isfinite(t), t, numpy.inf)
        axis, row = t.argmin(axis=1), numpy.arange(len(origin))
        origin = origin + t[row, axis][:, None] * direction
        along = direction[row, axis]
        origin[row, axis] = numpy.where(along > 0, HIGH[axis], LOW[axis])
        taped = (axis == 1) | ((axis == 0) & (along > 0))
        white = (axis == 2) & (along > 0)
        white[white] = on_dot(origin[white])
        share = numpy.where(taped, EDGE_REFLECTANCE, reflectance(numpy.abs(along), 1 / GUIDE_INDEX))
        lit = numpy.flatnonzero((axis == 0) & ~taped & (share < 1))
        ray = direction[lit] * GUIDE_INDEX
        ray[:, 0] = -numpy.sqrt(1 - (ray[:, 1:] ** 2).sum(axis=1))
        found[number[lit]] += (weight * (1 - share))[lit] * strip_met(origin[lit], ray)
        direction = direction.copy()
        direction[row, axis] = -along
        weight = numpy.where(white, weight, weight * share)
        weight[white] = dotted(number[white], origin[white], weight[white])
        direction[white] = scattered(int(white.sum()), generator)
        keep = weight > FAINT * generator.random(len(origin))
        weight = numpy.maximum(weight, FAINT)
        origin, direction, weight, number = origin[keep], direction[keep], weight[keep], number[keep]
    return found


def filled(paths: int, seed: int) -> numpy.ndarray:
    """Luminance of the patches as it leaves the glass, less by the square of the index, by light paths from the strip."""
    generator = numpy.random.default_rng(seed)
    flux = numpy.zeros(DOTS[0] * DOTS[1] * PATCHES**2)

    def dotted(number: numpy.ndarray, place: numpy.ndarray, weight: numpy.ndarray) -> numpy.ndarray:
        flux[:] += numpy.bincount(patch(place), weight, len(flux))
        return weight * DOT_REFLECTANCE

    batch = 500_000
    for _ in range(0, paths, batch):
        u = generator.random((batch, 2))
        place = numpy.stack(
            [numpy.full(batch, -0.5 * GUIDE[0]), (u[:, 0] - 0.5) * STRIP[0], 0.5 * GUIDE[2] + (u[:, 1] - 0.5) * STRIP[1]], -1
        )
        # Cosine about +x.
        direction = -scattered(batch, generator)[:, [2, 1, 0]]
        place[:, 1:] += direction[:, 1:] / direction[:, :1] * GAP
        enters = (place >= LOW).all(axis=1) & (place <= HIGH).all(axis=1)
        place, weight, direction = place[enters], 1 - reflectance(direction[enters, 0], GUIDE_INDEX), direction[enters] / GUIDE_INDEX
        direction[:, 0] = numpy.sqrt(1 - (direction[:, 1:] ** 2).sum(axis=1))
        followed(place, direction, weight, generator, dotted)
    # Patches of both halves are one.
    area = 2 * (DOT / PATCHES) ** 2
    return flux * (LUMENS / (-(-paths // batch) * batch)) * DOT_REFLECTANCE / (numpy.pi * area * GUIDE_INDEX**2)


def seen(
    plane: float, gamma: float, rays: int, seed: int, dots: numpy.ndarray | None, cell: tuple[float, float] = (0.0, 0.0)
) -> tuple[float, float]:
    """Candela in the mean over the solid angle of a cell of C and γ, and their standard error as if rays did not lie evenly.

    Rays go backward: to the dots' luminance, or without one to the strip itself.
    """
    generator = numpy.random.default_rng([seed, round(1000 * plane), round(1000 * gamma)])
    u = spread(rays, 4, generator)
    low, high = (numpy.cos(numpy.radians(numpy.clip(gamma + side * cell[1], 0.0, 180.0))) for side in (-0.5, 0.5))
    polar, turn = numpy.arccos(low + (high - low) * u[:, 0]), numpy.radians(plane + (u[:, 1] - 0.5) * cell[0])
    view = numpy.stack([numpy.sin(polar) * numpy.cos(turn), numpy.sin(polar) * numpy.sin(turn), -numpy.cos(polar)], -1)
    right = numpy.stack([-numpy.sin(turn), numpy.cos(turn), 0 * turn], -1)
    origin, area = view, 1.0
    corners = numpy.array([[x, y, z] for x in (LOW[0] - 2 * GAP, HIGH[0]) for y in (LOW[1], HIGH[1]) for z in (LOW[2], HIGH[2])])
    for axis, number in ((right, u[:, 2]), (numpy.cross(view, right), u[:, 3])):
        places = axis @ corners.T
        first, width = places.min(axis=1), numpy.ptp(places, axis=1)
        origin = origin + (first + width * number)[:, None] * axis
        area = area * width
    values = area * luminances(origin, -view, generator, dots)
    return float(values.mean()), float(values.std() / rays**0.5)


def spread(count: int, dimensions: int, generator: numpy.random.Generator) -> numpy.ndarray:
    """Points that lie evenly in the unit cube: multiples of powers of the root of x^(d+1) = x + 1, from a place at random."""
    root = 1.0
    for _ in range(60):
        root = (1 + root) ** (1 / (dimensions + 1))
    steps = root ** -numpy.arange(1.0, dimensions + 1)
    result: numpy.ndarray = (generator.random(dimensions) + numpy.arange(count)[:, None] * steps) % 1.0
    return result


def luminances(
    origin: numpy.ndarray, direction: numpy.ndarray, generator: numpy.random.Generator, dots: numpy.ndarray | None
) -> numpy.ndarray:
    """Of rays from outside, through what the faces pass on and throw back."""
    values = numpy.zeros(len(origin))
    with numpy.errstate(divide="ignore", invalid="ignore"):
        first, last = (LOW - origin) / direction, (HIGH - origin) / direction
    near, far = numpy.minimum(first, last), numpy.maximum(first, last)
    level, within = direction == 0, (origin > LOW) & (origin < HIGH)
    near = numpy.where(level, numpy.where(within, -numpy.inf, numpy.inf), near)
    far = numpy.where(level, numpy.where(within, numpy.inf, -numpy.inf), far)
    axis, met = near.argmax(axis=1), near.max(axis=1) < far.min(axis=1)
    values[~met] = LUMINANCE * strip_met(origin[~met], direction[~met])
    row = numpy.flatnonzero(met)
    origin, direction, axis = origin[row] + near[row, axis[row]][:, None] * direction[row], direction[row].copy(), axis[row]
    each = numpy.arange(len(row))
    along = direction[each, axis]
    # Tape and dots are dark from outside: no light falls on them there.
    covered = (axis == 1) | ((axis == 0) & (along < 0)) | ((axis == 2) & (along < 0) & on_dot(origin))
    share = numpy.where(covered, 0.0, reflectance(numpy.abs(along), GUIDE_INDEX))
    # The lit edge mirrors the strip.
    values[row] += LUMINANCE * share * (axis == 0) * strip_met(origin, direction * [-1.0, 1.0, 1.0])
    enters = ~covered
    origin, direction, axis, along, row = origin[enters], direction[enters] / GUIDE_INDEX, axis[enters], along[enters], row[enters]
    each = numpy.arange(len(row))
    direction[each, axis] = 0.0
    direction[each, axis] = numpy.sign(along) * numpy.sqrt(1 - (direction**2).sum(axis=1))

    def dotted(number: numpy.ndarray, place: numpy.ndarray, weight: numpy.ndarray) -> numpy.ndarray:
        if dots is None:
            return weight * DOT_REFLECTANCE
        values[row[number]] += weight * dots[patch(place)]
        return 0 * weight

    found = followed(origin, direction, 1 - share[enters], generator, dotted)
    values[row] += LUMINANCE * found
    return values


def by_chance(plane: float, gamma: float, rays: int, seed: int = 1) -> tuple[float, float]:
    """Candela by rays to the strip alone."""
    return seen(plane, gamma, rays, seed, None)


def table(planes: numpy.ndarray, polar: numpy.ndarray, dots: numpy.ndarray, rays: int, seed: int) -> numpy.ndarray:
    """Candela of all cells; the half y > 0 stands for both."""
    found = numpy.zeros((len(planes), len(polar)))
    for i in range(len(planes) // 2 + 1):
        for j, gamma in enumerate(polar):
            pole = gamma in (0.0, 180.0)
            cell = (360.0 if pole else CELL[0], CELL[1])
            found[i, j] = found[0, j] if pole and i else seen(float(planes[i]), float(gamma), rays, seed, dots, cell)[0]
            found[-1 - i, j] = found[i, j]
    return found


def expected(paths: int = 4_000_000, rays: int = 600_000, fillings: int = 4) -> Expected:
    """Means over cells, for the strip's images are sharp. Errors are those of fillings with light of their own."""
    planes, polar = numpy.arange(0.0, 360.01, 30.0), numpy.arange(0.0, 180.01, 15.0)
    found = numpy.array([table(planes, polar, filled(paths, k), rays, k) for k in range(fillings)])
    error = found.std(axis=0, ddof=1) / fillings**0.5
    return Expected("light paths to the dots, rays backward to the dots", planes, polar, found.mean(axis=0), error, cell=CELL)

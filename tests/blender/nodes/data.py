"""What varies from texel to texel: float images, so that both engines reckon with the same bits. No Blender needed."""

import numpy

# Texels along a tile's side, and pixels that it takes.
SIDE = 32
# Of each kind there are so many, independent of each other.
COPIES = 3


def _places(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """Coordinates as textures meet them, both signs."""
    return random.uniform(-4.0, 4.0, (count, 3))


def _unit(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """Shares from 0 to 1, the ends among them."""
    values = random.uniform(0.0, 1.0, (count, 3))
    values[random.random((count, 3)) < 0.02] = 0.0
    values[random.random((count, 3)) < 0.02] = 1.0
    return values


def _colours(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """Mostly within 0 to 1; greys, black, bright and negative ones among them."""
    values = random.uniform(0.0, 1.0, (count, 3))
    values[random.random(count) < 0.05] *= 6.0
    values[random.random(count) < 0.05] -= 0.5
    grey = random.random(count) < 0.05
    values[grey] = values[grey, :1]
    values[random.random(count) < 0.03] = 0.0
    return values


def _wide(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """Everything that arithmetic may meet: small and large, both signs, zeros, whole numbers, equals in all copies."""
    values = random.uniform(-3.0, 3.0, (count, 3))
    large = random.random((count, 3)) < 0.1
    values[large] = numpy.sign(values[large]) * 10.0 ** random.uniform(0.5, 4.0, large.sum())
    whole = random.random((count, 3)) < 0.1
    values[whole] = numpy.rint(values[whole])
    values[random.random((count, 3)) < 0.03] = 0.0
    values[::29] = numpy.linspace(-2.0, 2.0, len(values[::29]))[:, None]
    # A zero of its own sign is another number to the arc tangent.
    return values + 0.0


def _positive(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """From a tenth to ten."""
    return 10.0 ** random.uniform(-1.0, 1.0, (count, 3))


def _far(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """Places far from the origin: kilometres."""
    return random.uniform(-3000.0, 3000.0, (count, 3))


def _kelvin(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """Temperatures."""
    return random.uniform(700.0, 13000.0, (count, 3))


def _nanometres(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """Wavelengths around the visible ones."""
    return random.uniform(360.0, 800.0, (count, 3))


def _ramp(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """From below 0 to above 1 in even steps, as ramps and curves are read."""
    return numpy.stack([numpy.linspace(-0.2, 1.2, count)] * 3, axis=1) + numpy.array([0.0, 0.001, -0.001])


def _octaves(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """How much finer each octave is than the one before."""
    return random.uniform(1.2, 3.0, (count, 3))


def _sides(random: numpy.random.Generator, count: int) -> numpy.ndarray:
    """How many sides a polygon has."""
    return random.uniform(2.0, 9.0, (count, 3))


KINDS = {
    "place": _places,
    "unit": _unit,
    "colour": _colours,
    "wide": _wide,
    "positive": _positive,
    "far": _far,
    "kelvin": _kelvin,
    "nanometres": _nanometres,
    "ramp": _ramp,
    "octaves": _octaves,
    "sides": _sides,
}


def texels(name: str) -> numpy.ndarray:
    """The data of a name ("wide 1") as (SIDE, SIDE, 3) float32, the bottom row first."""
    kind, copy = name.split()
    random = numpy.random.default_rng(1000 * sorted(KINDS).index(kind) + int(copy))
    return KINDS[kind](random, SIDE * SIDE).astype("f4").reshape(SIDE, SIDE, 3)

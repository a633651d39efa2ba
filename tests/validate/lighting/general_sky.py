"""The CIE standard general skies by ISO 15469:2004, table 1, in numpy."""

import math

import numpy

# a, b of the gradation; c, d, e of the indicatrix.
PARAMETERS = {
    1: (4.0, -0.70, 0.0, -1.0, 0.00),
    2: (4.0, -0.70, 2.0, -1.5, 0.15),
    3: (1.1, -0.80, 0.0, -1.0, 0.00),
    4: (1.1, -0.80, 2.0, -1.5, 0.15),
    5: (0.0, -1.00, 0.0, -1.0, 0.00),
    6: (0.0, -1.00, 2.0, -1.5, 0.15),
    7: (0.0, -1.00, 5.0, -2.5, 0.30),
    8: (0.0, -1.00, 10.0, -3.0, 0.45),
    9: (-1.0, -0.55, 2.0, -1.5, 0.15),
    10: (-1.0, -0.55, 5.0, -2.5, 0.30),
    11: (-1.0, -0.55, 10.0, -3.0, 0.45),
    12: (-1.0, -0.32, 10.0, -3.0, 0.45),
    13: (-1.0, -0.32, 16.0, -3.0, 0.30),
    14: (-1.0, -0.15, 16.0, -3.0, 0.30),
    15: (-1.0, -0.15, 24.0, -2.8, 0.15),
}
TRADITIONAL_OVERCAST = 16


def relative(kind: int, direction: numpy.ndarray, sun: numpy.ndarray) -> numpy.ndarray:
    """Luminance of a sky type over that of the zenith towards unit vectors (…, 3), z up; zero below the horizon."""
    up = direction[..., 2]
    above = numpy.maximum(up, 1e-9)
    if kind == TRADITIONAL_OVERCAST:
        return numpy.where(up > 0, (1 + 2 * up) / 3, 0.0)
    a, b, c, d, e = PARAMETERS[kind]
    angle = numpy.arccos(numpy.clip(direction @ sun, -1.0, 1.0))
    zenith = math.acos(sun[2])

    def indicatrix(x: numpy.ndarray | float) -> numpy.ndarray:
        return 1 + c * (numpy.exp(d * numpy.asarray(x)) - math.exp(d * math.pi / 2)) + e * numpy.cos(x) ** 2

    gradation = (1 + a * numpy.exp(b / above)) / (1 + a * math.exp(b))
    return numpy.where(up > 0, gradation * indicatrix(angle) / indicatrix(zenith), 0.0)


def horizontal(kind: int, sun: numpy.ndarray, count: int = 400) -> float:
    """Illuminance of open level ground by a sky whose zenith has luminance 1: by Gauss and Legendre over the squared sine of the zenith angle."""
    x, w = numpy.polynomial.legendre.leggauss(count)
    squared, phi = 0.5 * (x + 1), 2 * math.pi * (numpy.arange(2 * count) + 0.5) / (2 * count)
    sine, up = numpy.sqrt(squared)[:, None], numpy.sqrt(1 - squared)[:, None]
    directions = numpy.stack(numpy.broadcast_arrays(sine * numpy.cos(phi), sine * numpy.sin(phi), up), axis=-1)
    return float((relative(kind, directions, sun).mean(axis=1) * w).sum() * 0.5 * math.pi)

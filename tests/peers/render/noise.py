"""How noisy a picture is on the scale of noise thresholds, zone by zone: what `gonio --noise-threshold` estimates, measured against known radiance."""

import numpy
from cost import LUMINANCE

ZONE = 8
CHANNELS = 3.0
# Keeps values near black from counting too much.
DARK = 1e-4


def shown(radiance: numpy.ndarray, white: float) -> numpy.ndarray:
    """What an error is divided by: the root of the sum of the shown channels below white, the sum itself above."""
    value = CHANNELS / white * (radiance @ LUMINANCE)
    divisor: numpy.ndarray = DARK + numpy.where(value < 1.0, numpy.sqrt(numpy.maximum(value, 0.0)), value)
    return divisor


def errors(difference: numpy.ndarray, radiance: numpy.ndarray, white: float) -> numpy.ndarray:
    """The mean square over each zone of a difference in radiance, on the scale of what is shown; (zones down, zones across)."""
    relative = CHANNELS / white * (difference @ LUMINANCE) / shown(radiance, white)
    return zones(relative**2)


def zones(values: numpy.ndarray) -> numpy.ndarray:
    """Means over squares of pixels; sides are multiples of a zone's."""
    height, width = values.shape
    means: numpy.ndarray = values.reshape(height // ZONE, ZONE, width // ZONE, ZONE).mean(axis=(1, 3))
    return means

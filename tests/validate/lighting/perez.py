"""Perez's all-weather sky and luminous efficacies from the papers' tables (Solar Energy 44, 1990, and 50, 1993, with its erratum)."""

import math

import numpy

BOUNDS = (1.065, 1.230, 1.500, 1.950, 2.800, 4.500, 6.200)
# A clearness in each class.
CLASSES = (1.0, 1.15, 1.35, 1.7, 2.3, 3.6, 5.4, 8.0)
# Constant, precipitable water, cosine of the sun's zenith angle, logarithm of the brightness.
DIFFUSE_EFFICACY = (
    (97.24, -0.46, 12.00, -8.91),
    (107.22, 1.15, 0.59, -3.95),
    (104.97, 2.96, -5.53, -8.77),
    (102.39, 5.59, -13.95, -13.90),
    (100.71, 5.94, -22.75, -23.74),
    (106.42, 3.83, -36.15, -28.83),
    (141.88, 1.90, -53.24, -14.03),
    (152.23, 0.35, -45.27, -7.98),
)
# Constant, precipitable water, exp(5.73 z − 5), brightness.
DIRECT_EFFICACY = (
    (57.20, -4.55, -2.98, 117.12),
    (98.99, -3.46, -1.21, 12.38),
    (109.83, -4.90, -1.71, -8.81),
    (110.34, -5.84, -1.99, -4.56),
    (106.36, -3.97, -1.75, -6.16),
    (107.19, -1.25, -1.51, -26.73),
    (105.75, 0.77, -1.26, -34.44),
    (101.18, 1.58, -1.10, -8.29),
)
# For each class four numbers for each of a to e.
LUMINANCE = """
1.3525 -0.2576 -0.2690 -1.4366 -0.7670 0.0007 1.2734 -0.1233 2.8000 0.6004 1.2375 1.0000 1.8734 0.6297 0.9738 0.2809 0.0356 -0.1246 -0.5718 0.9938
-1.2219 -0.7730 1.4148 1.1016 -0.2054 0.0367 -3.9128 0.9156 6.9750 0.1774 6.4477 -0.1239 -1.5798 -0.5081 -1.7812 0.1080 0.2624 0.0672 -0.2190 -0.4285
-1.1000 -0.2515 0.8952 0.0156 0.2782 -0.1812 -4.5000 1.1766 24.7219 -13.0812 -37.7000 34.8438 -5.0000 1.5218 3.9229 -2.6204 -0.0156 0.1597 0.4199 -0.5562
-0.5484 -0.6654 -0.2672 0.7117 0.7234 -0.6219 -5.6812 2.6297 33.3389 -18.3000 -62.2500 52.0781 -3.5000 0.0016 1.1477 0.1062 0.4659 -0.3296 -0.0876 -0.0329
-0.6000 -0.3566 -2.5000 2.3250 0.2937 0.0496 -5.6812 1.8415 21.0000 -4.7656 -21.5906 7.2492 -3.5000 -0.1554 1.4062 0.3988 0.0032 0.0766 -0.0656 -0.1294
-1.0156 -0.3670 1.0078 1.4051 0.2875 -0.5328 -3.8500 3.3750 14.0000 -0.9999 -7.1406 7.5469 -3.4000 -0.1078 -1.0750 1.5702 -0.0672 0.4016 0.3017 -0.4844
-1.0000 0.0211 0.5025 -0.5119 -0.3000 0.1922 0.7023 -1.6317 19.0000 -5.0000 1.2438 -1.9094 -4.0000 0.0250 0.3844 0.2656 1.0468 -0.3788 -2.4517 1.4656
-1.0500 0.0289 0.4260 0.3590 -0.3250 0.1156 0.7781 0.0025 31.0625 -14.5000 -46.1148 55.3750 -7.2312 0.4050 13.3500 0.6234 1.5000 -0.6426 1.8564 0.5636
"""
TABLE = numpy.array([float(word) for word in LUMINANCE.split()]).reshape(8, 5, 4)


def irradiances(clearness: float, brightness: float, zenith: float, air_mass: float, outside: float) -> tuple[float, float]:
    """Direct normal and diffuse horizontal, W/m², of a clearness and a brightness; angles in radians."""
    diffuse = brightness * outside / air_mass
    return diffuse * (clearness - 1.0) * (1.0 + 1.041 * zenith**3), diffuse


def class_of(clearness: float) -> int:
    """From 0, overcast."""
    return sum(clearness >= bound for bound in BOUNDS)


def diffuse_efficacy(clearness: float, brightness: float, zenith: float, water: float = 2.0) -> float:
    """lm/W of the sky's light on a level surface; water in cm."""
    a, b, c, d = DIFFUSE_EFFICACY[class_of(clearness)]
    return a + b * water + c * math.cos(zenith) + d * math.log(brightness)


def direct_efficacy(clearness: float, brightness: float, zenith: float, water: float = 2.0) -> float:
    """lm/W of the sun's light."""
    a, b, c, d = DIRECT_EFFICACY[class_of(clearness)]
    return max(a + b * water + c * math.exp(5.73 * zenith - 5.0) + d * brightness, 0.0)


def relative(clearness: float, brightness: float, zenith: float, up: numpy.ndarray, angle: numpy.ndarray) -> numpy.ndarray:
    """Luminance in a unit of its own by the sine of a direction's height and its angle from the sun."""
    rows = TABLE[class_of(clearness)]
    if 1.065 < clearness < 2.8:
        # Below it the model gives negative luminances.
        brightness = max(brightness, 0.2)
    a, b, c, d, e = rows[:, 0] + rows[:, 1] * zenith + brightness * (rows[:, 2] + rows[:, 3] * zenith)
    if class_of(clearness) == 0:
        c = math.exp((brightness * (rows[2, 0] + rows[2, 1] * zenith)) ** rows[2, 2]) - rows[2, 3]
        d = -math.exp(brightness * (rows[3, 0] + rows[3, 1] * zenith)) + rows[3, 2] + brightness * rows[3, 3]
    result: numpy.ndarray = (1 + a * numpy.exp(b / up)) * (1 + c * numpy.exp(d * angle) + e * numpy.cos(angle) ** 2)
    return result

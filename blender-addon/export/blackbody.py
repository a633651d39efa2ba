# SPDX-License-Identifier: GPL-3.0-or-later
"""Colour of a black body as Blender shows it: linear Rec.709 of luminance 1."""

from bisect import bisect_right

# Temperature in kelvin and colour, read from Blender's own `Light.temperature_color`; between two entries the colour is all but linear in
# the inverse temperature (largest error 0.0024). Outside the ends hold.
KNOTS = (
    (800, 5.4139, 0.0000, 0.0000),
    (850, 5.1923, 0.0000, 0.0000),
    (900, 4.9840, 0.0000, 0.0000),
    (965, 4.7306, 0.0005, 0.0000),
    (1000, 4.6014, 0.0390, 0.0000),
    (1050, 4.4272, 0.0909, 0.0000),
    (1100, 4.2638, 0.1394, 0.0000),
    (1167, 4.0603, 0.1998, 0.0000),
    (1200, 3.9655, 0.2279, 0.0000),
    (1300, 3.7027, 0.3055, 0.0000),
    (1449, 3.3669, 0.4041, 0.0000),
    (1600, 3.0810, 0.4873, 0.0000),
    (1750, 2.8425, 0.5558, 0.0000),
    (1902, 2.6376, 0.6141, 0.0000),
    (2000, 2.5201, 0.6469, 0.0204),
    (2100, 2.4118, 0.6768, 0.0424),
    (2250, 2.2679, 0.7160, 0.0773),
    (2500, 2.0676, 0.7693, 0.1394),
    (2750, 1.9051, 0.8111, 0.2050),
    (3000, 1.7708, 0.8443, 0.2722),
    (3315, 1.6318, 0.8777, 0.3559),
    (3600, 1.5303, 0.8996, 0.4319),
    (4000, 1.4141, 0.9236, 0.5337),
    (4500, 1.3008, 0.9455, 0.6526),
    (5000, 1.2131, 0.9608, 0.7622),
    (5500, 1.1439, 0.9713, 0.8624),
    (6000, 1.0887, 0.9783, 0.9531),
    (6365, 1.0536, 0.9830, 1.0142),
    (7000, 1.0056, 0.9873, 1.1090),
    (8000, 0.9473, 0.9916, 1.2371),
    (9000, 0.9041, 0.9940, 1.3430),
    (10000, 0.8714, 0.9949, 1.4305),
    (11000, 0.8463, 0.9949, 1.5038),
    (12000, 0.8263, 0.9945, 1.5663),
)


def blackbody_colour(kelvin: float) -> tuple[float, float, float]:
    """Linear Rec.709 colour of a temperature."""
    kelvin = min(max(kelvin, KNOTS[0][0]), KNOTS[-1][0])
    upper = min(bisect_right([knot[0] for knot in KNOTS], kelvin), len(KNOTS) - 1)
    (cold, *from_colour), (hot, *to_colour) = KNOTS[upper - 1], KNOTS[upper]
    share = (1.0 / cold - 1.0 / kelvin) / (1.0 / cold - 1.0 / hot)
    return tuple(a + (b - a) * share for a, b in zip(from_colour, to_colour, strict=True))

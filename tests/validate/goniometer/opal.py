"""A chip between a white board and an opal cover: radiosity in the closed half sphere, by Gauss and Legendre over rings.

Within a sphere any two places exchange light alike, dA cos cos / π d² = dA / 4πR². Between a ring of the cover and one of the board the
kernel is summed around. The chip hides nothing. What the cover lets through leaves as from a Lambertian source; afar it adds up over the
places that look there. The cover is convex: outside, nothing comes back.
"""

import numpy
from expected import Expected
from luminaires import BOARD_REFLECTANCE, DOME, LED, LED_DEPTH, LUMENS, OPAL_REFLECTANCE, OPAL_TRANSMITTANCE

TURNS = 1024


def gauss(count: int, low: float, high: float) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Places and weights."""
    x, w = numpy.polynomial.legendre.leggauss(count)
    return low + 0.5 * (high - low) * (x + 1), 0.5 * (high - low) * w


def exchange(ring: numpy.ndarray, height: numpy.ndarray, radius: numpy.ndarray, level: float) -> numpy.ndarray:
    """cos cos / π d² between places (r, z) of the cover and radii of a disk at a height that looks down, mean over the turn."""
    angle = 2 * numpy.pi * (numpy.arange(TURNS) + 0.5) / TURNS
    x = ring[:, None, None] - radius[None, :, None] * numpy.cos(angle)
    y = -radius[None, :, None] * numpy.sin(angle)
    z = height[:, None, None] - level
    square = x * x + y * y + z * z
    # The cover's normal looks inward: −place / R.
    inward = -(ring[:, None, None] * x + height[:, None, None] * z) / DOME
    mean: numpy.ndarray = (numpy.maximum(-inward, 0) * numpy.maximum(-z, 0) / (numpy.pi * square**2)).mean(axis=2)
    return mean


def irradiance(rings: int) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Heights on the cover, and lux there from inside, by two reflections between cover and board."""
    height, share = gauss(rings, -DOME, 0.0)
    # Radii denser towards the rim, where board and cover meet.
    u, du = gauss(rings, 0.0, numpy.pi / 2)
    radius, dr = DOME * numpy.sin(u), DOME * numpy.cos(u) * du
    ring = numpy.sqrt(DOME**2 - height**2)
    cover_area, board_area = 2 * numpy.pi * DOME * share, 2 * numpy.pi * radius * dr
    chip, dchip = gauss(40, 0.0, LED)
    leaving = LUMENS / (numpy.pi * LED**2)
    first = exchange(ring, height, chip, -LED_DEPTH) @ (2 * numpy.pi * chip * dchip) * leaving
    kernel = exchange(ring, height, radius, 0.0)
    within = numpy.full((rings, rings), 1 / (4 * numpy.pi * DOME**2)) * cover_area * OPAL_REFLECTANCE
    onto_board = kernel.T * cover_area * OPAL_REFLECTANCE
    onto_cover = kernel * board_area * BOARD_REFLECTANCE
    system = numpy.block([[numpy.eye(rings) - within, -onto_cover], [-onto_board, numpy.eye(rings)]])
    lux = numpy.linalg.solve(system, numpy.concatenate([first, numpy.zeros(rings)]))
    arrived, sent = (cover_area * first).sum(), LUMENS
    assert abs(arrived / sent - 1) < 1e-3, (arrived, sent)
    return height, lux[:rings]


def intensities(polar: numpy.ndarray, rings: int) -> tuple[numpy.ndarray, float]:
    """Candela, and the share of the flux that leaves."""
    height, lux = irradiance(rings)
    _, share = gauss(rings, -DOME, 0.0)
    luminance = lux * OPAL_TRANSMITTANCE / numpy.pi
    gamma = numpy.radians(polar)[:, None]
    # ∫ max(0, n · ω) around a ring: n · ω = a + b cos φ.
    a = numpy.cos(gamma) * -height / DOME
    b = numpy.maximum(numpy.sin(gamma) * numpy.sqrt(1 - (height / DOME) ** 2), 1e-15)
    edge = numpy.arccos(numpy.clip(-a / b, -1.0, 1.0))
    around = 2 * (a * edge + b * numpy.sin(edge))
    candela = (around * luminance * share * DOME).sum(axis=1)
    ratio = float((lux * share).sum() * 2 * numpy.pi * DOME * OPAL_TRANSMITTANCE / LUMENS)
    return candela, ratio


def expected() -> Expected:
    """The error is that of half as many rings."""
    polar = numpy.arange(0.0, 180.01, 1.0)
    (candela, ratio), (coarse, _) = intensities(polar, 160), intensities(polar, 80)
    how = "radiosity of cover and board, 160 rings each"
    return Expected(how, numpy.zeros(1), polar, candela[None], numpy.abs(candela - coarse)[None], ratio)

"""Years with chosen illuminances in every hour: `gonio annual-metrics` gets coefficients of suns that bring just these."""

import math

import annual_office
import numpy as np

HOUR = np.arange(8760) % 24 + 0.5
USED = (HOUR > 8) & (HOUR < 18)
DISC = math.pi * math.radians(0.2665) ** 2
LIMITS = np.float32([100, 300, 1000, 3000])


def sun_is_up() -> np.ndarray:
    """Hours with a sun by the formulas of Radiance's sun.c, at the place of `annual_office`."""
    day = np.arange(8760) // 24 + 1
    declination = 0.4093 * np.sin(2 * np.pi / 365 * (day - 81))
    adjusted = 0.170 * np.sin(4 * np.pi / 373 * (day - 80)) - 0.129 * np.sin(2 * np.pi / 355 * (day - 8)) + (8.55 - 15) / 15
    turn, latitude = (HOUR + adjusted) * np.pi / 12, math.radians(49.52)
    sine = math.sin(latitude) * np.sin(declination) - math.cos(latitude) * np.cos(declination) * np.cos(turn)
    return np.arcsin(sine) > -math.radians(0.2665)


UP = sun_is_up()
SUNNY = np.flatnonzero(UP & USED)


def factor(lux: np.ndarray, luminance: np.float32) -> np.ndarray:
    """Coefficients that bring these illuminances, to the last bit where there are such."""
    best = (lux / luminance).astype(np.float32)
    for near in (np.nextafter(best, np.float32(0)), np.nextafter(best, np.float32(np.inf))):
        best = np.where(np.abs(near * luminance - lux) < np.abs(best * luminance - lux), near, best)
    return best


def sunlight() -> tuple[int, np.float32]:
    """A normal illuminance of the sun in lx, and its luminance, by which coefficients bring the limits of all figures to the last bit."""
    for lux in range(50_000, 60_000):
        luminance = np.float32(lux / DISC)
        if np.array_equal(factor(LIMITS, luminance) * luminance, LIMITS):
            return lux, luminance
    raise ValueError("no sunlight brings all limits")


LUX, LUMINANCE = sunlight()


def weather() -> str:
    """The same sun in all hours that have one, and next to no sky."""
    return annual_office.wea([LUX * int(up) for up in UP], [0.001 * up for up in UP])


def dark(points: int) -> np.ndarray:
    """Coefficients of Tregenza's patches that bring nothing."""
    return np.zeros((points, 146), np.float32)


def suns(lux: np.ndarray) -> np.ndarray:
    """Coefficients of the suns by illuminances, points × hours."""
    return np.ascontiguousarray(factor(lux.astype(np.float32)[:, UP], LUMINANCE))

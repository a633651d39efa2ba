"""Deviations of renders from their references, and what of them noise explains.

A case is rendered with several seeds. The renders are independent, so the mean deviation over all points has one value a seed, and Student's
distribution tells how far from zero their mean may be. Single points are held against a limit.
"""

import math

import figures
import numpy

SEEDS = range(1, 9)
# A case without bias fails this seldom.
CONFIDENCE = 0.999
# Single precision, tables of colours and the picture of a sky leave this much where there is no noise.
ROUNDING = 1e-4
LIMIT = 0.01
# Points darker than this share of the brightest count by the share.
DARK = 0.01


def student(freedom: int, confidence: float = CONFIDENCE) -> float:
    """The two-sided quantile of Student's distribution, by the trapezoid rule; `freedom` from 3 on."""
    t = numpy.linspace(0.0, 200.0, 2_000_001)
    density = (1.0 + t * t / freedom) ** (-(freedom + 1) / 2)
    scale = math.gamma((freedom + 1) / 2) / (math.sqrt(freedom * math.pi) * math.gamma(freedom / 2))
    inside = numpy.cumsum(0.5 * (density[1:] + density[:-1])) * (t[1] - t[0]) * 2.0 * scale
    return float(t[1:][numpy.searchsorted(inside, confidence)])


def deviations(found: numpy.ndarray, expected: numpy.ndarray) -> numpy.ndarray:
    """Relative deviations of renders (seeds, points) from what is expected (points)."""
    floor = DARK * float(expected.max())
    result: numpy.ndarray = (found - expected) / numpy.maximum(expected, floor)
    return result


def row(section: str, case: str, reference: str, found: numpy.ndarray, expected: numpy.ndarray, limit: float = LIMIT) -> figures.Row:
    """The row of renders (seeds, …) of points with known values (…)."""
    off = deviations(found.reshape(len(found), -1), numpy.asarray(expected, float).reshape(-1))
    each_seed = off.mean(axis=1)
    error = float(each_seed.std(ddof=1)) / math.sqrt(len(each_seed))
    uncertainty = student(len(each_seed) - 1) * error + ROUNDING
    largest = float(numpy.abs(off.mean(axis=0)).max())
    return figures.Row(section, case, reference, off.shape[1], largest, limit, float(each_seed.mean()), uncertainty)


def hold(section: str, case: str, reference: str, found: numpy.ndarray, expected: numpy.ndarray, limit: float = LIMIT) -> None:
    """Records the row of a case and fails where it does not hold."""
    figures.check(row(section, case, reference, found, expected, limit))


def hold_exact(section: str, case: str, reference: str, found: numpy.ndarray, expected: numpy.ndarray, limit: float) -> None:
    """The same for one render without noise."""
    off = deviations(numpy.asarray(found, float).reshape(1, -1), numpy.asarray(expected, float).reshape(-1))
    figures.check(figures.Row(section, case, reference, off.size, float(numpy.abs(off).max()), limit))

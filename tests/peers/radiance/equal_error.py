"""Errors against the reference, curves of error against processor time, and the time that an error takes along a curve."""

import math
from dataclasses import dataclass
from itertools import pairwise
from statistics import median

import numpy
import two_rooms
from measured_by import Measured

GONIO, TRACED, CACHED = "gonio", "Radiance", "Radiance, ambient cache"
# What tables ask for.
ERRORS = (0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002)


@dataclass(frozen=True)
class Setting:
    """An engine's curve (one of the three names above) and the options of a run."""

    curve: str
    options: str


@dataclass(frozen=True)
class Row:
    """A setting's figures over its rounds, errors by grid."""

    setting: Setting
    # The root mean square over points and rounds of the relative deviation.
    errors: dict[str, float]
    # The relative deviation of the grid's mean, the mean over rounds.
    biases: dict[str, float]
    # The median over rounds.
    seconds: float


def row(setting: Setting, rounds: list[Measured], reference: numpy.ndarray) -> Row:
    """The figures of runs of one setting against lux of all points."""
    lux = numpy.array([each.lux for each in rounds])
    squares = two_rooms.each_grid((lux / reference - 1.0) ** 2)
    known = {name: part.mean() for name, part in two_rooms.each_grid(reference).items()}
    biases = {name: float(part.mean() / known[name] - 1.0) for name, part in two_rooms.each_grid(lux).items()}
    errors = {name: float(part.mean() ** 0.5) for name, part in squares.items()}
    return Row(setting, errors, biases, median(each.seconds for each in rounds))


def front(rows: list[Row], curve: str, grid: str) -> list[tuple[float, float]]:
    """Seconds and errors of the settings that no quicker setting of the curve is better than."""
    found: list[tuple[float, float]] = []
    for seconds, error in sorted((row.seconds, row.errors[grid]) for row in rows if row.setting.curve == curve):
        if not found or error < found[-1][1]:
            found.append((seconds, error))
    return found


def seconds_for(points: list[tuple[float, float]], error: float) -> float | None:
    """The least seconds for an error: along the front, straight in logarithms; None where it is not reached."""
    if points and points[0][1] <= error:
        return points[0][0]
    for (quick, coarse), (slow, fine) in pairwise(points):
        if fine <= error:
            share = math.log(coarse / error) / math.log(coarse / fine)
            return math.exp((1 - share) * math.log(quick) + share * math.log(slow))
    return None


@dataclass(frozen=True)
class Equal:
    """Seconds for one error over one grid by curve; None where the curve does not reach it."""

    grid: str
    error: float
    seconds: dict[str, float | None]

    def ratio(self, curve: str) -> float | None:
        """Another curve's seconds over gonio's."""
        ours, theirs = self.seconds[GONIO], self.seconds[curve]
        return theirs / ours if ours and theirs else None


def equals(rows: list[Row]) -> list[Equal]:
    """For each grid the errors that gonio and one of Radiance's curves reach."""
    found = []
    for grid in (each.name for each in two_rooms.GRIDS):
        fronts = {curve: front(rows, curve, grid) for curve in (GONIO, TRACED, CACHED)}
        for error in ERRORS:
            equal = Equal(grid, error, {curve: seconds_for(points, error) for curve, points in fronts.items()})
            if equal.ratio(TRACED) or equal.ratio(CACHED):
                found.append(equal)
    return found

"""What is best known of the rooms: gonio with many samples and the independent tracer, which must agree."""

import sys
from dataclasses import dataclass
from pathlib import Path

import numpy

sys.path.append(str(Path(__file__).resolve().parents[2] / "validate" / "lighting"))

import measured_by  # noqa: E402
import tracer  # noqa: E402
import two_rooms  # noqa: E402
from confidence import student  # noqa: E402

BATCHES = 16
# The runs that are measured have seeds below this one.
FIRST_SEED = 1000
# The mean over points of the squared difference over its variance is about 1 where both are right.
MOST_CHI = 2.0


@dataclass(frozen=True)
class Agreement:
    """Of one grid: the means of gonio and of the tracer with their standard errors (lx), and how far single points are apart."""

    ours: float
    our_error: float
    theirs: float
    their_error: float
    # The mean over points of the squared difference over its variance.
    chi: float
    # Standard errors that the means may be apart (99.9 % confidence).
    most: float

    @property
    def apart(self) -> float:
        """The difference of the means in standard errors."""
        return abs(self.ours - self.theirs) / float(numpy.hypot(self.our_error, self.their_error))

    @property
    def holds(self) -> bool:
        """Whether chance explains the differences."""
        return self.apart < self.most and self.chi < MOST_CHI


@dataclass(frozen=True)
class Reference:
    """Lux of all points, by grid the root mean square of their relative standard errors, and how the two sources of it agree."""

    lux: numpy.ndarray
    errors: dict[str, float]
    agreements: dict[str, Agreement]


def spread(runs: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Mean of independent runs (runs, …) and its variance."""
    return runs.mean(axis=0), runs.var(axis=0, ddof=1) / len(runs)


def agreement(ours: numpy.ndarray, theirs: numpy.ndarray) -> Agreement:
    """Of independent runs (runs, points) of a grid."""
    (our_points, our_variances), (their_points, their_variances) = spread(ours), spread(theirs)
    chi = float(((our_points - their_points) ** 2 / (our_variances + their_variances)).mean())
    (a, a_variance), (b, b_variance) = spread(ours.mean(axis=1)), spread(theirs.mean(axis=1))
    most = student(min(len(ours), len(theirs)) - 1)
    return Agreement(float(a), float(a_variance**0.5), float(b), float(b_variance**0.5), chi, most)


def joined(ours: numpy.ndarray, theirs: numpy.ndarray) -> tuple[numpy.ndarray, float]:
    """The mean of both by their precision over a grid, and the root mean square of its relative standard errors."""
    (a, a_variance), (b, b_variance) = spread(ours), spread(theirs)
    a_error, b_error = float((a_variance / a**2).mean()), float((b_variance / a**2).mean())
    share = b_error / (a_error + b_error)
    return share * a + (1 - share) * b, float((share**2 * a_error + (1 - share) ** 2 * b_error) ** 0.5)


def made(stage: Path, samples: int, seeds: int, paths: int) -> Reference:
    """From `seeds` runs of gonio, 4 or more, with so many samples a point, and `paths` paths of the tracer a point."""
    ours = numpy.array([measured_by.by_gonio(stage, samples, FIRST_SEED + seed).lux for seed in range(seeds)])
    theirs = tracer.traced(max(1, paths // BATCHES), BATCHES, FIRST_SEED)
    both = {name: (part, two_rooms.each_grid(theirs)[name]) for name, part in two_rooms.each_grid(ours).items()}
    found = {name: joined(*pair) for name, pair in both.items()}
    lux = numpy.concatenate([values for values, _ in found.values()])
    return Reference(lux, {name: error for name, (_, error) in found.items()}, {name: agreement(*pair) for name, pair in both.items()})

"""Adaptive against uniform sampling on the scenes of the comparison: the time until the noise is at the threshold, and how even it is then."""

import dataclasses
import math
import statistics
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cache

import noise
import numpy
import pytest
from contest import BENCHMARKS
from cost import LUMINANCE
from description import described
from processor import processor_seconds

gonio = pytest.importorskip("gonio")

from engine_gonio import Engine, colour  # noqa: E402

THRESHOLD = 0.05
# Of the pictures' sides; they stay multiples of a tile's. One thread, so that all seconds are work's.
SCALE, THREADS = 0.25, 1
# Most samples of a pixel; uniform sampling that needs more counts as if these were enough.
MOST = 1 << 11
# Pictures of each kind; the root of their mean square error is what is compared, for that of one alone is noisy itself.
SEEDS = 4
# Adaptive sampling's time as a share of that which uniform sampling takes until its worst zone is at the threshold: in each scene, and in the
# geometric mean of all.
MOST_SHARE, MOST_MEAN_SHARE = 1.05, 0.6
# Of the threshold.
MOST_NOISE = 1.5

pytestmark = [pytest.mark.validate, pytest.mark.timeout(7200)]


@dataclass(frozen=True)
class Pictures:
    """Some pictures of one kind: radiance, mean samples, and the median of their seconds, by the clock and by the processor."""

    radiance: list[numpy.ndarray]
    samples: float
    seconds: float
    processor: float


@dataclass(frozen=True)
class Need:
    """What uniform sampling needs for a noise of its worst zone: samples, seconds by the clock and by the processor."""

    samples: float
    seconds: float
    processor: float


@dataclass(frozen=True)
class Found:
    """Adaptive pictures, the noise of their worst zone, and uniform sampling's needs for the threshold and for that same noise."""

    scene: str
    adaptive: Pictures
    worst: float
    threshold: Need
    same: Need


def pictures(engine: Engine, samples: int, first_seed: int, **settings: float) -> Pictures:
    """`SEEDS` pictures."""
    radiance, mean_samples, seconds, processor = [], [], [], []
    for seed in range(first_seed, first_seed + SEEDS):
        before = processor_seconds()
        film, clock = engine.film(samples, seed, **settings)
        processor.append(processor_seconds() - before)
        seconds.append(clock)
        radiance.append(colour(film))
        mean_samples.append(film.mean_samples)
    return Pictures(radiance, statistics.mean(mean_samples), statistics.median(seconds), statistics.median(processor))


def white_of(engine: Engine) -> float:
    """The radiance that the photographic operator would show as white before it compresses."""
    luminance = colour(engine.film(16, 999, noise_threshold=0.0)[0]) @ LUMINANCE
    return float(numpy.exp(numpy.log(luminance[luminance > 0.0]).mean()) / 0.18)


def worst_zone(each: list[numpy.ndarray], reference: numpy.ndarray, white: float) -> float:
    """The noise of the noisiest zone, from pictures that the reference does not hold."""
    squares = numpy.mean([noise.errors(picture - reference, reference, white) for picture in each], axis=0)
    return math.sqrt(squares.max())


def worst_of_pairs(each: list[numpy.ndarray], reference: numpy.ndarray, white: float) -> float:
    """The same from the pictures' differences from their own mean, free of the reference's noise."""
    mean = numpy.mean(each, axis=0)
    squares = numpy.sum([noise.errors(picture - mean, reference, white) for picture in each], axis=0) / (len(each) - 1)
    return math.sqrt(squares.max())


@cache
def found(scene: str) -> Found:
    """Adaptive pictures, then uniform ones of more and more samples until their worst zone is at the threshold."""
    full = described(scene)
    size = {side: round(SCALE * getattr(full, side)) for side in ("width", "height")}
    engine = Engine(dataclasses.replace(full, **size), THREADS)
    white = white_of(engine)
    adaptive = pictures(engine, MOST, 1, noise_threshold=THRESHOLD, noise_white=white)
    ladder: list[tuple[int, Pictures]] = []
    steps: list[tuple[float, int, float, float]] = []
    samples = 1 << math.floor(math.log2(adaptive.samples))
    while not steps or (steps[-1][0] > THRESHOLD and samples <= MOST):
        ladder.append((samples, pictures(engine, samples, 100 * (len(ladder) + 1), noise_threshold=0.0)))
        samples *= 2
        weights = [samples for samples, _ in ladder]
        reference = numpy.average([numpy.mean(made.radiance, axis=0) for _, made in ladder], axis=0, weights=weights)
        steps = [(worst_of_pairs(made.radiance, reference, white), samples, made.seconds, made.processor) for samples, made in ladder]
    for step in steps:
        print(f"{scene}: uniform {step[1]} samples, worst zone {step[0] / THRESHOLD:.2f} of the threshold, {step[2]:.2f} s")
    worst = worst_zone(adaptive.radiance, reference, white)
    return Found(scene, adaptive, worst, Need(*between(steps, THRESHOLD)), Need(*between(steps, worst)))


def between(steps: list[tuple[float, int, float, float]], worst: float) -> Iterator[float]:
    """What uniform sampling needs for a noise: between two steps along a power law, never more than the last step."""
    table = numpy.log(numpy.array(steps))[::-1]
    for column in table.T[1:]:
        yield float(numpy.exp(numpy.interp(math.log(worst), table[:, 0], column)))


@pytest.mark.parametrize("scene", BENCHMARKS)
def test_no_zone_is_much_noisier_than_the_threshold(scene: str) -> None:
    result = found(scene)
    print(f"{scene}: worst zone {result.worst / THRESHOLD:.2f} of the threshold after {result.adaptive.samples:.0f} samples in the mean")
    assert result.worst <= MOST_NOISE * THRESHOLD


def test_time_to_the_threshold() -> None:
    results = [found(scene) for scene in BENCHMARKS]
    for each in results:
        of_time, of_processor, of_same = shares(each)
        print(f"{each.scene}: adaptive {each.adaptive.samples:.0f} samples in {each.adaptive.seconds:.2f} s", end=", ")
        print(f"uniform {each.threshold.samples:.0f} in {each.threshold.seconds:.2f} s: {of_time:.2f} of the time", end=", ")
        print(f"{of_processor:.2f} of the processor's; {of_same:.2f} to the same worst zone")
    by_clock, by_processor, same = (statistics.geometric_mean(share) for share in zip(*map(shares, results), strict=True))
    print(
        f"geometric mean {by_clock:.2f}, of the processor's time {by_processor:.2f}; to the same worst zone {same:.2f} of the processor's"
    )
    assert by_clock <= MOST_MEAN_SHARE and max(shares(each)[0] for each in results) <= MOST_SHARE


def shares(each: Found) -> tuple[float, float, float]:
    """Of uniform sampling's time to the threshold by the clock and by the processor, and of its processor's time to the same worst zone."""
    used = each.adaptive.processor
    return each.adaptive.seconds / each.threshold.seconds, used / each.threshold.processor, used / each.same.processor

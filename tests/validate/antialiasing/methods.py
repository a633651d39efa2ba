"""Ways to spend rays on a picture, and how far each ends from a reference."""

import time
from dataclasses import dataclass
from functools import cache

import gonio
import numpy
from processor import processor_seconds

# Samples of the two-pass comparison: those that a pixel can end with.
STEPS = (1, 2, 4, 8, 16, 32, 64)
# A channel that is off by more is counted as bad.
BAD = 16.0


@dataclass(frozen=True)
class Picture:
    """8-bit sRGB values (height, width, 3) as floats, rays a pixel, and seconds by the clock and by the processor."""

    shown: numpy.ndarray
    rays: float
    clock: float
    processor: float


@dataclass(frozen=True)
class Errors:
    """Root mean square and mean absolute difference in steps of 8-bit sRGB, and the share of pixels with a channel off by more than `BAD`."""

    rmse: float
    mae: float
    bad: float


def shown(radiance: numpy.ndarray) -> numpy.ndarray:
    """Radiance as 8-bit sRGB shows it, 1 for white, not rounded."""
    x = numpy.clip(radiance, 0.0, 1.0)
    return 255.0 * numpy.where(x <= 0.0031308, 12.92 * x, 1.055 * numpy.maximum(x, 0.0031308) ** (1 / 2.4) - 0.055)


def errors(picture: numpy.ndarray, reference: numpy.ndarray) -> Errors:
    """How far a picture is from another."""
    difference = numpy.abs(picture - reference)
    return Errors(float(numpy.sqrt((difference**2).mean())), float(difference.mean()), float((difference > BAD).any(axis=2).mean()))


class Subject:
    """A scene whose trees are kept from picture to picture."""

    def __init__(self, scene: gonio.Scene) -> None:
        self._scene = scene
        # What is shown as white, so that no small picture has to tell.
        self._scene.set(noise_white=1.0)
        self._previous: gonio.Render | None = None

    def film(self, **settings: object) -> tuple[gonio.Film, float, float]:
        """A film with some settings, and the seconds it took by the clock and by the processor."""
        self._scene.set(**settings)
        render = gonio.Render(self._scene, self._previous)
        before, start = processor_seconds(), time.perf_counter()
        render.wait()
        clock, processor = time.perf_counter() - start, processor_seconds() - before
        assert not render.diagnostics, render.diagnostics
        self._previous = render
        return render.film(), clock, processor

    def antialiased(self, method: str | int) -> Picture:
        """A picture by a name of adaptive antialiasing, or by a regular grid."""
        film, clock, processor = self.film(antialiasing=method)
        rays = float(numpy.asarray(film["sample_count"]).mean())
        return Picture(shown(colour(film)), rays, clock, processor)

    @cache  # noqa: B019 - a subject lives as long as the tests
    def prefixes(self) -> list[numpy.ndarray]:
        """Radiance by the first 1, 2, 4 … samples of one sequence, by a box filter of a pixel's width."""
        self._scene.set(filter="box", filter_width=1.0, antialiasing="sampled", samples=STEPS[-1])
        found = [colour(self.film(sample_range=(0, count))[0]) for count in STEPS]
        self._scene.set(sample_range=None)
        return found

    def two_pass(self, rays: float) -> tuple[numpy.ndarray, float]:
        """What two passes show that spend about so many rays a pixel: one each, then more where the three by three pixels around deviate."""
        prefixes = self.prefixes()
        deviation = local_deviation(shown(prefixes[0]))
        levels = numpy.log2(numpy.asarray(STEPS))

        def chosen(scale: float) -> numpy.ndarray:
            wanted = numpy.log2(numpy.maximum(deviation * scale, 1.0))
            return numpy.clip(numpy.round(wanted), 0, levels[-1]).astype(int)

        low, high = 1e-6, 1e6
        for _ in range(60):
            middle = (low * high) ** 0.5
            low, high = (middle, high) if (2.0 ** chosen(middle)).mean() < rays else (low, middle)
        index = chosen(low)
        picture = numpy.take_along_axis(numpy.stack(prefixes), index[None, :, :, None], axis=0)[0]
        return shown(picture), float((2.0**index).mean())


def colour(film: gonio.Film) -> numpy.ndarray:
    """Radiance (height, width, 3)."""
    return numpy.asarray(film["color"])[..., :3].astype("f8")


def local_deviation(values: numpy.ndarray) -> numpy.ndarray:
    """Standard deviation over three by three pixels, the largest of the channels."""
    padded = numpy.pad(values, ((1, 1), (1, 1), (0, 0)), mode="edge")
    height, width, _ = values.shape
    around = numpy.stack([padded[y : y + height, x : x + width] for y in range(3) for x in range(3)])
    deviation: numpy.ndarray = around.std(axis=0).max(axis=2)
    return deviation

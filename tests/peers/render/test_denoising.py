"""What a denoiser is worth: pictures of 16 samples denoised and raw ones of 256, both held against the converged picture."""

import dataclasses
from collections.abc import Callable
from statistics import mean

import numpy
import pytest
from contest import BENCHMARKS
from cost import LUMINANCE
from description import described

gonio = pytest.importorskip("gonio")
pytest.importorskip("pyoidn")

from engine_gonio import Engine, colour  # noqa: E402

FEW, MANY, CONVERGED = 16, 256, 2048
# Of the pictures' sides: details of a few pixels are lost to any denoiser.
SCALE = 2.0
GUIDED = ["color", "denoising_albedo", "denoising_normal"]
SEEDS = (1, 2, 3)
# Of the five scenes.
LEAST_WON = 4

pytestmark = [pytest.mark.validate, pytest.mark.timeout(3600)]


def display(reference: numpy.ndarray) -> Callable[[numpy.ndarray], numpy.ndarray]:
    """How radiance is shown where this is the picture: the photographic operator and the sRGB curve, 0 to 255."""
    scale = 0.18 / numpy.exp(numpy.log(numpy.maximum(reference @ LUMINANCE, 1e-6)).mean())

    def shown(radiance: numpy.ndarray) -> numpy.ndarray:
        scaled = numpy.maximum(radiance, 0.0) * scale
        luminance = (scaled @ LUMINANCE)[..., None]
        value = numpy.clip(scaled * (1.0 + luminance / 36.0) / (1.0 + luminance), 0.0, 1.0)
        curve: numpy.ndarray = numpy.where(value < 0.0031308, 12.92 * value, 1.055 * value ** (1 / 2.4) - 0.055)
        return 255.0 * curve

    return shown


def distances(scene: str) -> tuple[float, float]:
    """Root mean square differences from the converged picture in steps of 8-bit sRGB: few samples denoised, and many samples raw."""
    full = described(scene)
    size = {side: round(SCALE * getattr(full, side)) for side in ("width", "height")}
    engine = Engine(dataclasses.replace(full, **size), threads=2)
    converged = colour(engine.film(CONVERGED, 1000)[0])
    show = display(converged)

    def distance(film: gonio.Film) -> float:
        return float(numpy.sqrt(((show(colour(film)) - show(converged)) ** 2).mean()))

    denoised = [distance(gonio.denoise(engine.film(FEW, seed, passes=GUIDED)[0])) for seed in SEEDS]
    raw = [distance(engine.film(MANY, seed, passes=["color"])[0]) for seed in SEEDS]
    return mean(denoised), mean(raw)


def test_few_samples_denoised_beat_many_that_are_not() -> None:
    found = {scene: distances(scene) for scene in BENCHMARKS}
    for scene, (denoised, raw) in found.items():
        print(f"{scene}: {denoised:.2f} steps with {FEW} samples denoised, {raw:.2f} with {MANY} samples raw")
    assert sum(denoised < raw for denoised, raw in found.values()) >= LEAST_WON

"""What a denoiser is worth: pictures of 16 samples denoised and raw ones of 256, both held against what they would converge to.

Two raw pictures with different seeds stand for the converged one: the mean product of a picture's differences from both is its mean square
difference from what both have in common.
"""

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

FEW, MANY = 16, 256
# Of the pictures' sides: details of a few pixels are lost to any denoiser.
SCALE = 2.0
GUIDED = ["color", "denoising_albedo", "denoising_normal", "denoising_light"]
SEEDS = (1, 2, 3)
# Among plants thinner than pixels, details are lost that 256 samples show.
WON = ("cornell", "nine_lights", "car", "glass")

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
    raw = [colour(engine.film(MANY, seed, passes=["color"])[0]) for seed in (1000, 1001)]
    show = display(numpy.mean(raw, axis=0))
    first, second = (show(picture) for picture in raw)
    few = [show(colour(gonio.denoise(engine.film(FEW, seed, passes=GUIDED)[0]))) for seed in SEEDS]
    denoised = mean(float(((picture - first) * (picture - second)).mean()) for picture in few)
    return max(denoised, 0.0) ** 0.5, float(((first - second) ** 2).mean() / 2) ** 0.5


def test_few_samples_denoised_beat_many_that_are_not() -> None:
    found = {scene: distances(scene) for scene in BENCHMARKS}
    for scene, (denoised, raw) in found.items():
        print(f"{scene}: {denoised:.2f} steps with {FEW} samples denoised, {raw:.2f} with {MANY} samples raw")
    assert all(found[scene][0] < found[scene][1] for scene in WON)

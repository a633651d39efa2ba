"""The Cornell box, converged, in gonio and in Cycles and Mitsuba: interreflection, glossy and refracted light must agree block by block.

No factor is fitted: all are given the same radiance. Writes the figures to `out/validation-cornell.md`.
"""

import subprocess
import time
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path

import compare
import cornell
import cornell_gonio
import environments
import numpy
import pytest

HERE = Path(__file__).resolve().parent
OUT = environments.ROOT / "out"
# Each rendering is the mean of two; enough samples for the noise bound.
SAMPLES = {"diffuse": 256, "specular": 512, "principled": 512}
SEEDS = (1, 2)
RENDERERS = {"cycles": "bpy50", "mitsuba": "mitsuba"}
PAIRS = [("diffuse", "cycles"), ("diffuse", "mitsuba"), ("specular", "cycles"), ("specular", "mitsuba"), ("principled", "cycles")]
MOST_NOISE = 0.003
MOST_MEDIAN = 0.01
MOST_PERCENTILE95 = 0.03
# Blocks' noise over the root of their number gives 0.04 %; this is beyond four such errors of both.
MOST_MEAN = 0.003
INTRODUCTION = f"""# The Cornell box against other renderers

{cornell.RESOLUTION} × {cornell.RESOLUTION} pixels, {cornell.MAX_BOUNCES} bounces, box filter of one pixel, no clamping.
Differences are per channel over blocks of {compare.BLOCK} × {compare.BLOCK} pixels, |Δ| / (reference + {compare.FLOOR:.0%} of the image's
mean); "image mean" is that of the whole picture's mean. The light has the same radiance everywhere, nothing is fitted. Each
rendering is the mean of two with different seeds, noise the standard error of its blocks (RMS) that follows from those two.
"""

pytestmark = [pytest.mark.validate, pytest.mark.timeout(3600)]


@pytest.fixture(scope="module")
def rows() -> Iterator[list[str]]:
    """Lines of the table, written when all pairs are done."""
    OUT.mkdir(exist_ok=True)
    lines: list[str] = []
    yield lines
    if lines:
        (OUT / "validation-cornell.md").write_text(f"{INTRODUCTION}\n{compare.table(lines)}\n")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """Where renderers put their files."""
    return tmp_path_factory.mktemp("cornell")


def twice(render: Callable[[int], numpy.ndarray], samples: int) -> compare.Measured:
    """Two renderings and their cost."""
    start = time.monotonic()
    first, second = (render(seed) for seed in SEEDS)
    return compare.measured(first, second, samples, time.monotonic() - start)


@cache
def ours(variant: str) -> compare.Measured:
    """A variant in gonio."""
    samples = SAMPLES[variant]
    return twice(lambda seed: cornell_gonio.render(variant, samples, seed), samples)


def theirs(variant: str, other: str, folder: Path) -> compare.Measured:
    """A variant in another renderer; skips where it cannot be had."""
    try:
        python = environments.python_of(RENDERERS[other])
    except environments.Unavailable as reason:
        pytest.skip(f"{other} cannot be installed: {reason}")
    samples = SAMPLES[variant]

    def render(seed: int) -> numpy.ndarray:
        out = folder / f"{variant}-{other}-{seed}.npy"
        command = [str(python), str(HERE / f"cornell_{other}.py"), variant, str(samples), str(seed), str(out)]
        done = subprocess.run(command, capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        image: numpy.ndarray = numpy.load(out)
        return image

    return twice(render, samples)


@pytest.mark.parametrize(("variant", "other"), PAIRS)
def test_blocks_agree(variant: str, other: str, folder: Path, rows: list[str]) -> None:
    """Blocks agree within the noise of both and the tables of energy compensation."""
    reference = theirs(variant, other, folder)
    image = ours(variant)
    found = compare.difference(image.image, reference.image)
    picture = f"validation-cornell-{variant}-{other}.png"
    compare.write_strip(OUT / picture, image.image, reference.image)
    rows.append(compare.row(variant, other, image, reference, found, picture))
    assert max(image.noise, reference.noise) < MOST_NOISE
    assert found.median < MOST_MEDIAN
    assert found.percentile95 < MOST_PERCENTILE95
    assert found.mean < MOST_MEAN

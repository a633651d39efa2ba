"""Whole renders at every SIMD level are the same picture within noise; one thread and two give the same bits.

Each level renders with seeds of its own, several times. Blocks' means are compared with the best level's by Student's t,
the variance pooled over all levels; the family of all blocks, colours and levels has a confidence of 99.9 % (Šidák).
"""

import math
import os
import statistics
from pathlib import Path

import numpy as np
import OpenEXR
import pytest

pytestmark = pytest.mark.validate

EXAMPLES = Path(__file__).resolve().parents[2] / "examples" / "usd"
LEVELS = ["scalar", "sse4.2", "avx2", "avx512"]
SEEDS = 6
BLOCK = 16
CONFIDENCE = 0.999


def rendered(run, stage, path, level, seed, *options):
    """The colour of a small render."""
    done = run(
        "render", stage, "-o", path, "--res", 256, 144, "--spp", 16, "--seed", seed, *options,
        timeout=900, env={**os.environ, "GONIO_SIMD": level},
    )
    assert done.returncode == 0, done.stderr
    return OpenEXR.File(str(path)).channels()["RGBA"].pixels[..., :3].astype("f8")


def blocks(picture):
    """Means of blocks."""
    height, width, colours = picture.shape
    return picture.reshape(height // BLOCK, BLOCK, width // BLOCK, BLOCK, colours).mean(axis=(1, 3))


def as_normal(t, freedom):
    """Student's t as a deviate of the normal distribution; Wallace 1959, within 0.02 for the degrees of freedom here."""
    return (8 * freedom + 1) / (8 * freedom + 3) * np.sqrt(freedom * np.log1p(t * t / freedom))


@pytest.mark.timeout(3600)
@pytest.mark.parametrize("name", ["office", "sundial"])
def test_levels_give_the_same_picture(name, run, tmp_path):
    stage = EXAMPLES / f"{name}.usda"
    means, variances = {}, []
    for row, level in enumerate(LEVELS):
        seeds = range(1 + SEEDS * row, 1 + SEEDS * (row + 1))
        found = np.stack([blocks(rendered(run, stage, tmp_path / f"{level}-{seed}.exr", level, seed)) for seed in seeds])
        means[level] = found.mean(axis=0)
        variances.append(found.var(axis=0, ddof=1))
    freedom = len(LEVELS) * (SEEDS - 1)
    error = np.sqrt(np.mean(variances, axis=0) * 2 / SEEDS)
    # Blocks that one surface of no noise fills, like the sky, still round.
    error = np.maximum(error, 1e-6 * means[LEVELS[-1]])
    tests = (len(LEVELS) - 1) * error.size
    most = statistics.NormalDist().inv_cdf(0.5 + 0.5 * CONFIDENCE ** (1 / tests))
    for level in LEVELS[:-1]:
        t = (means[level] - means[LEVELS[-1]]) / error
        worst = as_normal(np.abs(np.nan_to_num(t)), freedom).max()
        print(f"{name}, {level} against {LEVELS[-1]}: worst block {worst:.2f} of {most:.2f} standard deviations, rms of t {math.sqrt(np.mean(t * t)):.3f}")
        assert worst < most


@pytest.mark.parametrize("level", LEVELS)
def test_one_thread_and_two_give_the_same_bits(level, run, tmp_path):
    stage = EXAMPLES / "office.usda"
    one, two = (rendered(run, stage, tmp_path / f"{threads}.exr", level, 1, "--threads", threads) for threads in (1, 2))
    assert np.array_equal(one, two)

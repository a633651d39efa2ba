"""The same file through Blender's USD export and `gonio render`, and through the add-on: the same picture up to one factor on all light.

The factor is 1 for lamps. Blender writes suns with a quarter of their strength ("approximately matches Karma", says its source).
"""

from pathlib import Path

import blender
import compare
import numpy
import OpenEXR
import pytest
import report

SAMPLES = 512
MOST_MEDIAN = 0.01
FACTORS = {"usd_lamps": 1.0, "usd_sun": 0.25}

pytestmark = [pytest.mark.validate, pytest.mark.timeout(2 * blender.SECONDS)]


@pytest.mark.parametrize("scene", FACTORS)
def test_the_export_looks_the_same(scene: str, tmp_path: Path, run) -> None:
    blender.call("export_usd", tmp_path, scene=scene, samples=SAMPLES)
    reference = numpy.load(tmp_path / f"{scene}.npy")
    height, width, _ = reference.shape
    picture = tmp_path / f"{scene}.exr"
    done = run("render", tmp_path / f"{scene}.usdc", "-o", picture, "--spp", SAMPLES, "--res", width, height, timeout=blender.SECONDS)
    assert done.returncode == 0, done.stderr
    image = OpenEXR.File(str(picture)).channels()["RGBA"].pixels[..., :3].astype("f8")
    factor = image.sum() / reference.sum()
    report.OUT.mkdir(parents=True, exist_ok=True)
    compare.write_strip(report.OUT / f"{scene}.png", image / factor, reference)
    assert factor == pytest.approx(FACTORS[scene], rel=0.01)
    assert compare.difference(image / factor, reference).median < MOST_MEDIAN

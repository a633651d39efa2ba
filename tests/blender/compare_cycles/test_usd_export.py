"""The same file through Blender's USD export and `gonio render`, and through the add-on: the same picture up to one factor on all light.

The factor is 1 for lamps. Blender writes suns with a quarter of their strength ("approximately matches Karma", says its source).
"""

import json
from pathlib import Path

import compare
import numpy
import OpenEXR
import pytest
import report
from conftest import CHILD, pythons, run_child

RENDER = Path(__file__).with_name("render.py")
SAMPLES = 512
SECONDS = 1500
MOST_MEDIAN = 0.01
FACTORS = {"usd_lamps": 1.0, "usd_sun": 0.25}

pytestmark = [pytest.mark.validate, pytest.mark.timeout(2 * SECONDS)]


@pytest.mark.parametrize("scene", FACTORS)
def test_the_export_looks_the_same(scene: str, tmp_path: Path, run) -> None:
    found = pythons()
    if not found:
        pytest.skip("no Python with bpy: pip install bpy in .venv-bpy50, or set GONIO_BPY")
    arguments = {"scene": scene, "samples": SAMPLES, "tmp_path": str(tmp_path)}
    run_child(found[-1], [str(CHILD), str(RENDER), "export_usd", json.dumps(arguments)], seconds=SECONDS)
    reference = numpy.load(tmp_path / f"{scene}.npy")
    height, width, _ = reference.shape
    picture = tmp_path / f"{scene}.exr"
    done = run("render", tmp_path / f"{scene}.usdc", "-o", picture, "--spp", SAMPLES, "--res", width, height, timeout=SECONDS)
    assert done.returncode == 0, done.stderr
    image = OpenEXR.File(str(picture)).channels()["RGBA"].pixels[..., :3].astype("f8")
    factor = image.sum() / reference.sum()
    report.OUT.mkdir(parents=True, exist_ok=True)
    compare.write_strip(report.OUT / f"{scene}.png", image / factor, reference)
    assert factor == pytest.approx(FACTORS[scene], rel=0.01)
    assert compare.difference(image / factor, reference).median < MOST_MEDIAN

"""The same file in Cycles and in Gonio, block by block, scene by scene; `report.py` shows the pictures in `out/compare-cycles/index.html`.

Nothing is fitted. The newest Blender at hand renders; `GONIO_BPY` names another.
"""

from pathlib import Path

import blender
import pytest
import report
from suite import SCENES, Scene

pytestmark = [pytest.mark.validate, pytest.mark.timeout(2 * blender.SECONDS)]


def rendered(scene: Scene, engine: str, folder: Path) -> report.compare.Measured:
    """A scene in one engine, in a Blender of its own."""
    samples = scene.gonio if engine == "GONIO" else scene.cycles
    blender.call("render", folder, theme=scene.theme, scene=scene.name, engine=engine, samples=samples, told=scene.told)
    return report.measured(folder / f"{scene.name}-{engine}.npz", samples)


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_blocks_agree(scene: Scene, tmp_path: Path) -> None:
    reference, image = rendered(scene, "CYCLES", tmp_path), rendered(scene, "GONIO", tmp_path)
    found = report.add(scene, image, reference)
    assert max(image.noise, reference.noise) < report.MOST_NOISE
    assert found.median < report.MOST_MEDIAN
    assert found.percentile95 < report.MOST_PERCENTILE95

"""The same file in Cycles and in Gonio, block by block, scene by scene; `report.py` shows the pictures in `out/compare-cycles/index.html`.

Nothing is fitted. The newest Blender at hand renders; `GONIO_BPY` names another.
"""

import json
from pathlib import Path

import pytest
import report
from conftest import CHILD, pythons, run_child
from suite import SCENES, Scene

RENDER = Path(__file__).with_name("render.py")
SECONDS = 1500

pytestmark = [pytest.mark.validate, pytest.mark.timeout(2 * SECONDS)]


def rendered(scene: Scene, engine: str, folder: Path) -> report.compare.Measured:
    """A scene in one engine, in a Blender of its own."""
    found = pythons()
    if not found:
        pytest.skip("no Python with bpy: pip install bpy in .venv-bpy50, or set GONIO_BPY")
    samples = scene.gonio if engine == "GONIO" else scene.cycles
    arguments = {"theme": scene.theme, "scene": scene.name, "engine": engine, "samples": samples, "tmp_path": str(folder)}
    run_child(found[-1], [str(CHILD), str(RENDER), "render", json.dumps(arguments)], seconds=SECONDS)
    return report.measured(folder / f"{scene.name}-{engine}.npz", samples)


@pytest.mark.parametrize("scene", SCENES, ids=lambda scene: scene.name)
def test_blocks_agree(scene: Scene, tmp_path: Path) -> None:
    reference, image = rendered(scene, "CYCLES", tmp_path), rendered(scene, "GONIO", tmp_path)
    found = report.add(scene, image, reference)
    assert max(image.noise, reference.noise) < report.MOST_NOISE
    assert found.median < report.MOST_MEDIAN
    assert found.percentile95 < report.MOST_PERCENTILE95

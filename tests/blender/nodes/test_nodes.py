"""Shader nodes against Cycles: a few in the ordinary gate, all of them under `validate`.

What the files of `measured` call exact has to stay so. `python tests/blender/nodes/page.py --measure` writes them anew.
"""

from pathlib import Path

import pytest
from conftest import run_alone
from nodes import results

MEASURE = Path(__file__).with_name("measure.py")
SECONDS = 900
# Quick ones of each family, and of each scene but the lit ones.
FEW = [
    *("ShaderNodeMath", "ShaderNodeMapRange", "ShaderNodeVectorRotate", "ShaderNodeCombineColor", "ShaderNodeTexGradient"),
    *("ShaderNodeTexChecker", "ShaderNodeTexNoise", "ShaderNodeTexVoronoi", "ShaderNodeFresnel", "ShaderNodeObjectInfo", "ShaderNodeGroup"),
]


def measured(python: Path, folder: Path, only: list[str] | None) -> None:
    """Measures in one Blender; asserts that nothing has come loose since it was measured last."""
    run_alone(python, MEASURE, "measure", {"tmp_path": folder, "only": only}, seconds=SECONDS)
    (made,) = folder.glob("*.txt")
    _, found = results.read(made)
    _, before = results.read(results.FOLDER / made.name)
    lost = [
        f"{name}, {mode}, {output}: {now['largest']:.1e}"
        for name, modes in found.items()
        for mode, outputs in modes.items()
        for output, now in outputs.items()
        if is_lost(before.get(name, {}).get(mode, {}).get(output), now)
    ]
    assert found and not lost, lost


def is_lost(before: dict | None, now: dict) -> bool:
    """Whether an output was exact and is not any more, by more than samples make of it that lie elsewhere."""
    if before is None or not results.is_exact(before) or results.is_exact(now):
        return False
    return "told" in now or now["largest"] > 2.0 * before["largest"]


def test_a_few_nodes_are_as_exact_as_they_were(blender_python, tmp_path):
    measured(blender_python, tmp_path, FEW)


@pytest.mark.validate
@pytest.mark.timeout(2 * SECONDS)
def test_all_nodes_are_as_exact_as_they_were(blender_python, tmp_path):
    measured(blender_python, tmp_path, None)

"""Rendering the scenes in a Blender of their own."""

import json
from pathlib import Path

import pytest
from conftest import CHILD, pythons, run_child

RENDER = Path(__file__).with_name("render.py")
SECONDS = 1500


def call(function: str, folder: Path, **arguments: str | int) -> None:
    """Runs a function of `render.py`, which writes into a folder, in the newest Blender at hand; skips where there is none."""
    found = pythons()
    if not found:
        pytest.skip("no Python with bpy: pip install bpy in .venv-bpy50, or set GONIO_BPY")
    run_child(found[-1], [str(CHILD), str(RENDER), function, json.dumps({**arguments, "tmp_path": str(folder)})], seconds=SECONDS)

"""Rendering the scenes in a Blender of their own."""

from pathlib import Path

import pytest
from conftest import pythons, run_alone

RENDER = Path(__file__).with_name("render.py")
SECONDS = 1500


def call(function: str, folder: Path, *, file: Path = RENDER, **arguments: str | int) -> None:
    """Runs a function of `render.py` or another file, which writes into a folder, in the newest Blender at hand; skips where there is none."""
    found = pythons()
    if not found:
        pytest.skip("no Python with bpy: pip install bpy in .venv-bpy50, or set GONIO_BPY")
    run_alone(found[-1], file, function, {**arguments, "tmp_path": folder}, seconds=SECONDS)

"""From the zip to pixels with Blender's own extension tool."""

import os
import subprocess
from pathlib import Path

import pytest

LIFE = Path(__file__).with_name("life.py")
SECONDS = 240


def said(python: Path, *arguments: str, environment: dict[str, str] | None = None) -> str:
    """Runs a Python with bpy; what it printed. Fails where it does."""
    ended = subprocess.run(
        [str(python), *arguments], capture_output=True, text=True, timeout=SECONDS, env={**os.environ, **(environment or {})}
    )
    if ended.returncode != 0:
        pytest.fail(f"{arguments[0]} ended with {ended.returncode}\n{ended.stdout[-4000:]}\n{ended.stderr[-8000:]}", pytrace=False)
    return ended.stdout


def test_the_zip_is_valid(blender_python, extension_zip):
    package = Path(said(blender_python, "-c", "import importlib.util; print(importlib.util.find_spec('bpy').origin)").strip())
    tool = str(next(package.parent.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py")))
    assert "Success" in said(blender_python, tool, "validate", str(extension_zip))


def test_installs_renders_and_uninstalls(blender_python, extension_zip, tmp_path):
    # The wheel comes from the zip: one that is installed in the environment must not stand in.
    environment = {"BLENDER_USER_RESOURCES": str(tmp_path / "user"), "PYTHONPATH": ""}
    said(blender_python, str(LIFE), str(extension_zip), str(tmp_path), environment=environment)
    assert (tmp_path / "picture.png").stat().st_size > 1000
    left = [path for path in Path(tmp_path / "user").rglob("*") if path.name in ("gonio", "blender_manifest.toml")]
    assert left == []

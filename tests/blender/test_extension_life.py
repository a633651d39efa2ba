"""From the zip to pixels with Blender's own extension tool."""

import subprocess
from pathlib import Path

from conftest import CHILD, run_child

LIFE = CHILD.with_name("life.py")


def test_the_zip_is_valid(blender_python, extension_zip):
    find = "import importlib.util; print(importlib.util.find_spec('bpy').origin)"
    package = Path(subprocess.run([str(blender_python), "-c", find], capture_output=True, text=True, timeout=120, check=True).stdout.strip())
    tool = str(next(package.parent.glob("*/scripts/addons_core/bl_pkg/cli/blender_ext.py")))
    said = run_child(blender_python, [tool, "validate", str(extension_zip)])
    assert "Success" in said


def test_installs_renders_and_uninstalls(blender_python, extension_zip, tmp_path):
    # The wheel comes from the zip: one that is installed in the environment must not stand in.
    environment = {"BLENDER_USER_RESOURCES": str(tmp_path / "user"), "PYTHONPATH": ""}
    run_child(blender_python, [str(LIFE), str(extension_zip), str(tmp_path)], environment=environment)
    assert (tmp_path / "picture.png").stat().st_size > 1000
    left = [path for path in Path(tmp_path / "user").rglob("*") if path.name in ("gonio", "blender_manifest.toml")]
    assert left == []

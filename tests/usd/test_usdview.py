"""The usdview plugin: the view of a stage as a command line of gonio. usdview itself is not in the package usd-core."""

import importlib.util
import json
import pathlib
import subprocess
import types

import pictures
import pytest

PLUGIN = pathlib.Path(__file__).resolve().parents[2] / "examples" / "usdview" / "gonio_usdview"


@pytest.fixture
def view():
    spec = importlib.util.spec_from_file_location("gonio_usdview_view", PLUGIN / "view.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def api_of(stage, frame=None):
    """As much of usdview's API as the view needs: a stage, a time, and a camera over it."""
    from pxr import Gf, Usd

    camera = Gf.Camera()
    camera.transform = Gf.Matrix4d().SetLookAt(Gf.Vec3d(0, 4, 6), Gf.Vec3d(0, 0.5, 0), Gf.Vec3d(0, 1, 0)).GetInverse()
    camera.horizontalAperture, camera.verticalAperture, camera.focalLength = 20, 20, 30
    return types.SimpleNamespace(
        stage=stage, frame=Usd.TimeCode.Default() if frame is None else Usd.TimeCode(frame), currentGfCamera=camera
    )


def rendered(view, api, folder):
    line, picture = view.command(api, folder, (24, 24), samples=2)
    done = subprocess.run(line, capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
    return picture


def test_the_plugin_is_described():
    said = json.loads((PLUGIN / "plugInfo.json").read_text())
    assert list(said["Plugins"][0]["Info"]["Types"]) == ["gonio_usdview.GonioContainer"]
    assert "class GonioContainer" in (PLUGIN / "__init__.py").read_text()


def test_a_saved_stage_is_read_from_its_file(view, room, tmp_path):
    from pxr import Usd

    stage = Usd.Stage.Open(str(room))
    line, _ = view.command(api_of(stage), tmp_path, (24, 24))
    assert str(room) in line and "--frames" not in line
    (tmp_path / "session.usda").unlink()
    from_view = rendered(view, api_of(stage, 3), tmp_path)
    assert pictures.png_size(from_view) == (24, 24)


def test_edits_that_are_not_saved_are_rendered(view, room, tmp_path):
    from pxr import Usd

    stage = Usd.Stage.Open(str(room))
    (tmp_path / "a").mkdir()
    before = rendered(view, api_of(stage), tmp_path / "a").read_bytes()
    stage.GetPrimAtPath("/Ball").SetActive(False)
    try:
        (tmp_path / "b").mkdir()
        line, picture = view.command(api_of(stage), tmp_path / "b", (24, 24), samples=2)
        assert str(room) not in line
        assert subprocess.run(line, capture_output=True, timeout=60).returncode == 0
        assert picture.read_bytes() != before
    finally:
        stage.GetRootLayer().Reload()

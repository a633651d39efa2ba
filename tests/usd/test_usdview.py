"""The usdview plugin: the view of a stage as a command line of gonio, its menu and its window.

usdview itself is not in the package usd-core: as much of it as plugins see is played here, by the names in usdview's own sources.
"""

import importlib.util
import json
import os
import pathlib
import subprocess
import sys
import time
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


class Played:
    """usdview's side of a plugin: a registry of commands, and menus that call them with the API."""

    def __init__(self, api):
        self.api, self.commands, self.menus = api, {}, {}

    def registerCommandPlugin(self, name, label, callback, description=""):
        self.commands[name] = types.SimpleNamespace(displayName=label, run=lambda: callback(self.api))
        return self.commands[name]

    def findOrCreateMenu(self, name):
        return types.SimpleNamespace(addItem=lambda command, shortcut=None: self.menus.setdefault(name, []).append((command, shortcut)))


class Deferred:
    """A module that is imported once one of its functions is called."""

    def __init__(self, name, package):
        self._name, self._package = name, package

    def __getattr__(self, function):
        return lambda *values: getattr(importlib.import_module(self._name, self._package), function)(*values)


def play_usdview(qt):
    """The modules of usdview that the plugin imports, with a container that imports late, as usdview's does."""
    from pxr import Tf

    class PluginContainer:
        def deferredImport(self, name):
            return Deferred(name, self.__module__)

    PluginContainer.__module__ = "pxr.Usdviewq.plugin"
    PluginContainer.__qualname__ = "PluginContainer"
    modules = {name: types.ModuleType(name) for name in ("pxr.Usdviewq", "pxr.Usdviewq.plugin", "pxr.Usdviewq.qt")}
    modules["pxr.Usdviewq.plugin"].PluginContainer = PluginContainer
    vars(modules["pxr.Usdviewq.qt"]).update(qt)
    sys.modules.update(modules)
    return Tf.Type.Define(PluginContainer)


@pytest.fixture(scope="module")
def container():
    """The plugin's container, found as usdview finds it: through the plugin registry, by plugInfo.json."""
    os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
    pytest.importorskip("PySide6.QtWidgets", reason="usdview's windows need Qt: pip install PySide6-Essentials", exc_type=ImportError)
    from pxr import Plug
    from PySide6 import QtCore, QtGui, QtWidgets

    application = QtWidgets.QApplication.instance() or QtWidgets.QApplication(["usdview"])
    base = play_usdview({"QtCore": QtCore, "QtGui": QtGui, "QtWidgets": QtWidgets})
    sys.path.insert(0, str(PLUGIN.parent))
    try:
        Plug.Registry().RegisterPlugins(str(PLUGIN))
        (found,) = Plug.Registry.GetAllDerivedTypes(base)
        Plug.Registry().GetPluginForType(found).Load()
        yield found.pythonClass()
    finally:
        sys.path.remove(str(PLUGIN.parent))
        for name in [name for name in sys.modules if name.startswith(("pxr.Usdviewq", "gonio_usdview"))]:
            del sys.modules[name]
        application.processEvents()


def clicked(container, api):
    """Chooses the menu's entry; gives the window that opens."""
    played = Played(api)
    container.registerPlugins(played, api)
    container.configureView(played, played)
    ((command, shortcut),) = played.menus["gonio"]
    assert command.displayName == "Render View" and shortcut
    command.run()
    (window,) = [child for child in api.qMainWindow.children() if type(child).__name__ == "PictureWindow"]
    return window


def window_api(stage, size):
    from PySide6.QtWidgets import QMainWindow

    api = api_of(stage)
    api.qMainWindow, api.viewportSize = QMainWindow(), size
    return api


def until(condition, seconds=60):
    from PySide6.QtWidgets import QApplication

    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not come about"
        QApplication.processEvents()
        time.sleep(0.01)


def test_the_menu_opens_a_window_with_the_picture(container, room):
    from pxr import Usd

    api = window_api(Usd.Stage.Open(str(room)), (480, 320))
    window = clicked(container, api)
    assert window.isVisible() and "reads the stage" in window._label.text()
    until(lambda: not window._label.pixmap().isNull())
    assert window._label.pixmap().size().toTuple() == (480, 320)
    assert window._label.width() >= 480 and window._label.height() >= 320
    folder, process = pathlib.Path(window._folder.name), window._process
    window.close()
    assert process.poll() is not None and not folder.exists()


def test_the_window_says_what_went_wrong(container, tmp_path):
    from pxr import Usd

    stage = Usd.Stage.Open(str(pictures.room(tmp_path / "room.usda")))
    (tmp_path / "room.usda").write_text("#usda 1.0\n((((")
    window = clicked(container, window_api(stage, (0, 0)))
    until(lambda: "gonio: error: " in window._label.text())
    assert "room.usda" in window._label.text()
    window.close()

"""`gonio view`: its pictures, its probe, what it does when files are saved, and its window, drawn without a screen."""

import os
import pathlib
import signal
import subprocess
import time

import numpy as np
import pictures
import pytest
from failures import fails

os.environ.setdefault("QT_QPA_PLATFORM", "offscreen")
pytest.importorskip("PySide6.QtWidgets", reason="the window needs Qt: pip install PySide6-Essentials", exc_type=ImportError)

from gonio.view.keys import DEEDS, list_of_keys  # noqa: E402
from gonio.view.session import Session, Wish  # noqa: E402
from gonio.view.show import Show  # noqa: E402
from gonio.view.window import Window  # noqa: E402
from PySide6.QtCore import QPoint, Qt  # noqa: E402
from PySide6.QtTest import QTest  # noqa: E402
from PySide6.QtWidgets import QApplication  # noqa: E402

CHOICES = {
    "resolution": None,
    "samples": 8,
    "show": "picture",
    "exposure": 0.0,
    "tonemap": None,
    "scale_max": None,
    "scale_steps": 10,
    "scale_log": None,
    "screenshot": None,
    "after": 1,
}
SIZE = (60, 40)


@pytest.fixture(scope="module")
def application():
    return QApplication.instance() or QApplication(["gonio"])


def until(condition, seconds=60):
    """Runs Qt's loop until something holds."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it did not come about"
        QApplication.processEvents()
        time.sleep(0.005)


class Seat:
    """A stage that is shown, and what was told of it."""

    def __init__(self, stage, *words, **choices):
        self.show = Show(["gonio", "view", str(stage), *words], stage.parent, {**CHOICES, "stage": stage.name, **choices})
        self.failures, self.opened, self.shots, self.warnings = [], [], [], []
        self.show.failed.connect(self.failures.append)
        self.show.opened.connect(lambda seen, _is_first: self.opened.append(seen))
        self.show.arrived.connect(self.shots.append)
        self.show.warned.connect(self.warnings.extend)
        self.show.resize(SIZE)
        self.show.reload()

    def finished(self):
        """The next picture with all its samples."""
        self.shots.clear()
        until(lambda: self.shots and self.shots[-1].is_finished)
        return self.shots[-1]

    def mean(self, name="luminance"):
        return float(np.asarray(self.finished().film[name]).mean())


@pytest.fixture
def seat(application):
    seats = []

    def take(stage, *words, **choices):
        seats.append(Seat(stage, *words, **choices))
        return seats[-1]

    yield take
    for one in seats:
        one.show.close()


@pytest.fixture
def own_room(tmp_path):
    return pictures.room(tmp_path / "room.usda")


def test_pictures_become_finer(seat, room):
    sitting = seat(room)
    first = sitting.finished()
    assert sitting.shots[0].factor >= 1 and not sitting.shots[0].is_fine
    assert first.factor == 1 and first.film.size == SIZE and first.film.samples == 8
    assert not sitting.failures


def test_the_camera_turns_and_comes_back(seat, room):
    sitting = seat(room)
    before = sitting.finished()
    sitting.show.move(lambda camera: camera.orbited(0.5, 0.0))
    turned = sitting.finished()
    assert sitting.show.viewpoint.number == -1 and turned.wish.camera["origin"]["name"] == "free camera"
    # The first move turns about what was in the middle.
    depth = np.asarray(before.film["depth"])[SIZE[1] // 2, SIZE[0] // 2, 0]
    assert sitting.show.viewpoint.free.distance == pytest.approx(depth)
    assert not np.array_equal(np.asarray(before.film["color"]), np.asarray(turned.film["color"]))
    sitting.show.choose_camera(0)
    again = sitting.finished()
    assert np.array_equal(np.asarray(before.film["color"]), np.asarray(again.film["color"]))


def test_everything_is_framed(seat, room):
    sitting = seat(room)
    sitting.finished()
    sitting.show.frame_all()
    seen = np.asarray(sitting.finished().film["primId"])[..., 0] >= 0
    assert seen.any() and not seen[0].any() and not seen[-1].any() and not seen[:, 0].any() and not seen[:, -1].any()


def test_the_probe_reads_what_is_rendered(seat, room, picture):
    sitting = seat(room)
    sitting.finished()
    passes = "color,luminance,illuminance,depth,primId"
    rendered = picture(room, "--aov", passes, "--res", *SIZE, spp=8)
    names = [name for name, _ in sitting.show.seen.placements]
    for across, down in ((0.5, 0.5), (0.1, 0.9), (0.4, 0.6), (0.7, 0.6)):
        x, y = int(across * SIZE[0]), int(down * SIZE[1])
        found = sitting.show.probe(across, down)
        assert (found.x, found.y) == (x, y)
        assert found.luminance == pytest.approx(rendered["Luminance"][y, x], rel=1e-3)
        assert found.illuminance == pytest.approx(rendered["Illuminance"][y, x], rel=1e-3)
        assert found.rgb == pytest.approx([rendered[name][y, x] for name in "RGB"], rel=1e-2)
        assert found.depth == pytest.approx(rendered["depth.Z"][y, x], rel=1e-3)
        assert found.prim == names[round(float(rendered["primId"][y, x]))]
    assert {"/Floor", "/Box", "/Ball"} <= set(names)
    assert sitting.show.probe(1.5, 0.5) is None


def test_the_sky_is_nothing(seat, room):
    sitting = seat(room)
    sitting.finished()
    found = sitting.show.probe(0.01, 0.01)
    assert found.prim is None and found.depth is None and found.illuminance is None


def test_the_exposure_is_held(seat, own_room):
    sitting = seat(own_room)
    shot = sitting.finished()
    bright = np.frombuffer(sitting.show.look.paint(shot.film).tobytes(), np.uint8).astype(int)
    sitting.show.change_look(is_automatic=False)
    held = np.frombuffer(sitting.show.look.paint(shot.film).tobytes(), np.uint8).astype(int)
    assert np.array_equal(bright, held)
    own_room.write_text(own_room.read_text().replace("intensity = 400", "intensity = 40"))
    shot = sitting.finished()
    assert np.frombuffer(sitting.show.look.paint(shot.film).tobytes(), np.uint8).mean() < 0.7 * held.mean()


def test_saved_stages_are_read_anew(seat, own_room):
    sitting = seat(own_room)
    before = sitting.mean()
    own_room.write_text(own_room.read_text().replace("intensity = 400", "intensity = 800"))
    assert sitting.mean() == pytest.approx(2.0 * before, rel=1e-3)


def png(path, level):
    """A grey picture of 4 × 4 pixels."""
    pictures.write_png(path, np.full((4, 4, 1), level))


TILED = """
def Mesh "Wall" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-9, -9, 0), (9, -9, 0), (9, 9, 0), (-9, 9, 0)]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    rel material:binding = </Shining>
}
def Material "Shining"
{
    token outputs:surface.connect = </Shining/S.outputs:surface>
    def Shader "S"
    {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0, 0, 0)
        color3f inputs:emissiveColor.connect = </Shining/T.outputs:rgb>
        token outputs:surface
    }
    def Shader "T"
    {
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @./tile.<UDIM>.png@
        token inputs:sourceColorSpace = "raw"
        float2 inputs:st.connect = </Shining/P.outputs:result>
        float3 outputs:rgb
    }
    def Shader "P"
    {
        uniform token info:id = "UsdPrimvarReader_float2"
        string inputs:varname = "st"
        float2 outputs:result
    }
}
"""


def test_saved_textures_are_noticed(seat, tmp_path):
    stage = pictures.stage(tmp_path / "stage.usda", TILED, pictures.camera())
    tile = tmp_path / "tile.1001.png"
    png(tile, 200)
    sitting = seat(stage)
    before = sitting.mean()
    until(lambda: str(tile) in sitting.show._watcher._known)
    png(tile, 50)
    assert sitting.mean() == pytest.approx(0.25 * before, rel=1e-2)


def test_saved_layers_are_noticed(seat, tmp_path):
    layer = pictures.room(tmp_path / "layer.usda")
    stage = tmp_path / "stage.usda"
    stage.write_text(f"#usda 1.0\n(\n    subLayers = [@{layer.name}@]\n    metersPerUnit = 1\n)\n")
    sitting = seat(stage)
    before = sitting.mean()
    until(lambda: str(layer) in sitting.show._watcher._known)
    layer.write_text(layer.read_text().replace("intensity = 400", "intensity = 200"))
    assert sitting.mean() == pytest.approx(0.5 * before, rel=1e-3)


def test_a_free_camera_stays_where_it_is(seat, own_room):
    sitting = seat(own_room)
    sitting.finished()
    sitting.show.move(lambda camera: camera.orbited(0.5, 0.1))
    eye = sitting.show.viewpoint.free.eye
    sitting.finished()
    own_room.write_text(own_room.read_text().replace("intensity = 400", "intensity = 800"))
    until(lambda: len(sitting.opened) == 2)
    sitting.finished()
    assert sitting.show.viewpoint.free.eye == eye


def test_a_broken_save_leaves_the_picture(seat, own_room):
    sitting = seat(own_room)
    shot, text = sitting.finished(), own_room.read_text()
    own_room.write_text(text[:-40] + "((((")
    until(lambda: sitting.failures)
    assert "room.usda" in sitting.failures[0] and sitting.show.stage_problem == sitting.failures[0]
    assert sitting.show.shot is shot and len(sitting.opened) == 1
    # It can be looked at from elsewhere meanwhile.
    sitting.show.move(lambda camera: camera.nearer(0.8))
    sitting.finished()
    own_room.write_text(text)
    until(lambda: len(sitting.opened) == 2)
    assert sitting.show.stage_problem == ""
    sitting.finished()


def test_a_crash_of_the_library_leaves_the_window(seat, own_room):
    sitting = seat(own_room)
    sitting.finished()
    text = own_room.read_text()
    deep = own_room.parent / "deep.usda"
    deep.write_text('#usda 1.0\ndef "D"\n{\n    custom int[] a = ' + "[" * 200_000 + "]" * 200_000 + "\n}\n")
    own_room.write_text(text + '\ndef "A" (prepend references = @deep.usda@</D>) {}\n')
    until(lambda: sitting.failures)
    assert sitting.failures[0].startswith("the USD library broke down (SIG")
    own_room.write_text(text)
    until(lambda: len(sitting.opened) == 2)


def test_a_newer_view_ends_the_older_render(seat, room):
    sitting = seat(room, samples=1 << 20)
    until(lambda: any(shot.is_fine for shot in sitting.shots))
    older = sitting.shots[-1].wish
    sitting.show.move(lambda camera: camera.orbited(0.5, 0.0))
    until(lambda: sitting.shots[-1].wish is not older)
    assert not any(shot.is_finished for shot in sitting.shots)


def test_a_session_ends_at_once(room):
    import gonio
    from gonio.view.camera import through

    scene = gonio.load_usd(room)
    shots = []
    session = Session(shots.append)
    camera = through(scene.to_dict()["cameras"][0], 1.5)
    passes = ("color", "luminance")
    session.show(Wish(scene, camera, (600, 400), 1 << 20, passes, passes))
    until(lambda: any(shot.is_fine for shot in shots))
    session.close()
    assert not shots[-1].is_finished


def test_frames(seat, tmp_path):
    stage = tmp_path / "moving.usda"
    head = pictures.HEADER.format(metres=1, up="Y").replace("(\n", "(\n    startTimeCode = 1\n    endTimeCode = 3\n", 1)
    stage.write_text(head + pictures.ROOM + pictures.MOVING + pictures.camera())
    sitting = seat(stage)
    window = Window(sitting.show, "moving", None)
    window.show()
    first = sitting.mean()
    assert window.frames.isVisible() and sitting.show.frame == 1
    window.next_frame()
    window.next_frame()
    until(lambda: sitting.show.seen.about["frame"] == 3)
    assert sitting.mean() == pytest.approx(4.0 * first, rel=0.02)
    window.next_frame()
    assert sitting.show.frame == 3


def test_stages_without_light_take_a_lamp_along(seat, tmp_path):
    sitting = seat(pictures.stage(tmp_path / "dark.usda", pictures.ROOM, pictures.camera()))
    sitting.finished()
    assert sitting.show.look.operator == "none"
    sitting.show.move(lambda camera: camera.orbited(2.0, 0.0))
    wish = sitting.finished().wish
    assert wish.headlight[1]["transform"] == wish.camera["transform"]


def test_the_window_follows_mouse_and_keys(seat, room, tmp_path):
    sitting = seat(room, samples=2)
    window = Window(sitting.show, "room", (240, 160))
    window.show()
    sitting.finished()
    assert window.canvas.pixels == (240, 160) and not window.frames.isVisible()
    eye = sitting.show.viewpoint.description(1.5)["transform"]["columns"][3]
    for button, keys in (
        (Qt.MouseButton.LeftButton, Qt.KeyboardModifier.NoModifier),
        (Qt.MouseButton.LeftButton, Qt.KeyboardModifier.AltModifier),
        (Qt.MouseButton.MiddleButton, Qt.KeyboardModifier.AltModifier),
        (Qt.MouseButton.RightButton, Qt.KeyboardModifier.NoModifier),
    ):
        QTest.mousePress(window.canvas, button, keys, QPoint(60, 40))
        QTest.mouseMove(window.canvas, QPoint(60, 40))
        drag(window.canvas, QPoint(80, 50), button, keys)
        QTest.mouseRelease(window.canvas, button, keys, QPoint(80, 50))
        moved = sitting.show.viewpoint.description(1.5)["transform"]["columns"][3]
        assert moved != eye
        eye = moved
    window.home()
    sitting.finished()
    assert sitting.show.viewpoint.number == 0
    window.canvas.pointed.emit(0.5, 0.5)
    assert "cd/m²" in window.reading.text() and " lx" in window.reading.text() and " m " in window.reading.text()
    window.show_illuminance()
    sitting.show.measure(False)
    window.show_luminance()
    window.brighter()
    assert sitting.show.look.show == "luminance" and sitting.show.look.stops == pytest.approx(1 / 3)
    window.reset_exposure()
    window.write_picture(str(tmp_path / "picture.exr"))
    window.write_picture(str(tmp_path / "picture.png"))
    assert pictures.read(tmp_path / "picture.exr")["Luminance"].shape == (160, 240)
    assert pictures.png_size(tmp_path / "picture.png")[0] >= 240


def drag(widget, to, button, keys):
    """A move with a button down, which QTest's own has not."""
    from PySide6.QtCore import QEvent, QPointF
    from PySide6.QtGui import QMouseEvent

    at = QPointF(to)
    event = QMouseEvent(QEvent.Type.MouseMove, at, widget.mapToGlobal(at), Qt.MouseButton.NoButton, button, keys)
    QApplication.sendEvent(widget, event)


def test_messages_have_a_panel(seat, tmp_path):
    sitting = seat(pictures.stage(tmp_path / "broken.usda", pictures.ROOM, pictures.BROKEN, pictures.LAMP, pictures.camera()))
    window = Window(sitting.show, "broken", (120, 80))
    window.show()
    sitting.finished()
    assert window.messages_dock.isVisible()
    assert any("/Broken" in window.messages.item(row).text() for row in range(window.messages.count()))
    window.toggle_messages()
    assert not window.messages_dock.isVisible()


def test_help_lists_what_there_is():
    said = list_of_keys()
    for deed in DEEDS:
        assert callable(getattr(Window, deed.call)) and deed.keys in said
    keys = [deed.keys for deed in DEEDS]
    assert len(set(keys)) == len(keys)


def test_screenshots(run, room, tmp_path):
    for show in ("picture", "luminance", "illuminance"):
        done = run("view", room, "--res", 120, 80, "--show", show, "--screenshot", tmp_path / f"{show}.png", "--after", 2)
        assert done.returncode == 0 and done.stderr == "", done.stderr
        width, height = pictures.png_size(tmp_path / f"{show}.png")
        assert width > 300 and height > 100
    assert len({(tmp_path / f"{show}.png").read_bytes() for show in ("picture", "luminance", "illuminance")}) == 3


@pytest.mark.parametrize("text", ["#usda 1.0\n((((", None])
def test_a_screenshot_of_what_cannot_be_read(run, tmp_path, text):
    stage = tmp_path / "stage.usda"
    if text is not None:
        stage.write_text(text)
    assert "stage.usda" in fails(run, "view", stage, "--screenshot", tmp_path / "shot.png")
    assert pictures.png_size(tmp_path / "shot.png")


def test_help_reads_well(run):
    done = run("view", "--help")
    assert done.returncode == 0 and "pip install PySide6-Essentials" in done.stdout and "--screenshot" in done.stdout


def test_without_qt_a_line_says_what_to_do(run, room, tmp_path):
    (tmp_path / "PySide6.py").write_text("raise ImportError('no such thing')\n")
    environment = {**os.environ, "PYTHONPATH": os.pathsep.join([str(tmp_path), os.environ.get("PYTHONPATH", "")])}
    assert "pip install PySide6-Essentials" in fails(lambda *words: run(*words, env=environment), "view", room)


def test_without_a_display_a_line_says_so(run, room):
    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM")
    environment = {name: value for name, value in os.environ.items() if name not in hidden}
    assert "no display" in fails(lambda *words: run(*words, env=environment), "view", room)


def test_wrong_words_are_told_before_a_window_opens(run, room):
    assert "filmic" in fails(run, "view", room, "--tonemap", "filmic")
    assert run("view", room, "--after", 3).returncode == 2


def test_ctrl_c_ends_it(command, room):
    with subprocess.Popen([*command, "view", str(room), "--spp", "1048576"], stderr=subprocess.PIPE, text=True) as process:
        # It has opened its window once it has started the other process.
        children = pathlib.Path(f"/proc/{process.pid}/task/{process.pid}/children")
        end = time.monotonic() + 60
        while children.exists() and not children.read_text().strip() and time.monotonic() < end:
            time.sleep(0.05)
        time.sleep(0.5)
        process.send_signal(signal.SIGINT)
        said = process.communicate(timeout=60)[1]
    assert process.returncode == 130, said

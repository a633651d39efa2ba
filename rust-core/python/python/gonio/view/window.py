"""The window around the picture: panels, menus and messages."""

from __future__ import annotations

from pathlib import Path
from typing import Any

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QAction, QCloseEvent, QKeySequence
from PySide6.QtWidgets import QDockWidget, QFileDialog, QLabel, QListWidget, QMainWindow, QMessageBox, QScrollArea, QWidget

from .._gonio import Error
from .canvas import Canvas
from .frames import Frames
from .keys import DEEDS, list_of_keys
from .look import Look
from .panel import Panel
from .probe import words
from .session import Shot
from .show import Show
from .stage import Seen

# A change of size is over once nothing came for so many milliseconds.
SETTLING = 60
THIRD = 1.0 / 3.0
# Height of the messages at first, pixels.
MESSAGES = 90
# Width and height of the screen that are left to what is around the window.
AROUND = (40, 80)


class Window(QMainWindow):
    """Shows what a `Show` brings, and tells it what the user wants."""

    def __init__(self, show: Show, name: str, size: tuple[int, int] | None) -> None:
        super().__init__()
        self.setWindowTitle(f"{name} – gonio")
        self._show, self._size = show, size
        self._at = (-1.0, -1.0)
        # Whether the messages came by themselves, and may go so.
        self._told_by_itself = False
        self._build()
        self._connect()
        self._fit(*(size or (960, 540)))

    def _build(self) -> None:
        self.canvas = Canvas()
        self.setCentralWidget(self.canvas)
        self.canvas.say(note="gonio reads the stage …")
        self.panel = Panel(self._show.look, self._show.samples)
        # Small windows scroll it.
        scrolling = QScrollArea(widgetResizable=True)
        scrolling.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        scrolling.setWidget(self.panel)
        scrolling.setMinimumWidth(self.panel.sizeHint().width() + scrolling.verticalScrollBar().sizeHint().width())
        self._dock("View", scrolling, Qt.DockWidgetArea.RightDockWidgetArea)
        self.messages = QListWidget()
        self.messages.setWordWrap(True)
        self.messages_dock = self._dock("Messages", self.messages, Qt.DockWidgetArea.BottomDockWidgetArea)
        self.messages_dock.hide()
        self.frames = Frames()
        self.addToolBar(Qt.ToolBarArea.BottomToolBarArea, self.frames)
        self.reading, self._progress = QLabel(), QLabel()
        self.statusBar().addWidget(self.reading, 1)
        self.statusBar().addPermanentWidget(self._progress)
        self._settling = QTimer(self, singleShot=True, interval=SETTLING)
        self._actions: dict[str, QAction] = {}
        menus: dict[str, Any] = {}
        for deed in DEEDS:
            if deed.menu not in menus:
                menus[deed.menu] = self.menuBar().addMenu(deed.menu)
            action = self._actions[deed.call] = QAction(deed.words, self)
            action.setShortcut(QKeySequence(deed.keys))
            if deed.is_on is not None:
                action.setCheckable(True)
                action.setChecked(deed.is_on)
            action.triggered.connect(lambda _is_on=False, call=deed.call: getattr(self, call)())
            menus[deed.menu].addAction(action)

    def _dock(self, title: str, content: QWidget, area: Qt.DockWidgetArea) -> QDockWidget:
        dock = QDockWidget(title, self)
        dock.setWidget(content)
        self.addDockWidget(area, dock)
        return dock

    def _connect(self) -> None:
        show, canvas, panel = self._show, self.canvas, self.panel
        canvas.turned.connect(lambda across, up: show.move(lambda camera: camera.orbited(across, up)))
        canvas.moved.connect(lambda across, up: show.move(lambda camera: camera.moved(across, up)))
        canvas.neared.connect(lambda factor: show.move(lambda camera: camera.nearer(factor)))
        canvas.pointed.connect(self._point)
        canvas.resized.connect(self._settling.start)
        self._settling.timeout.connect(lambda: show.resize(canvas.pixels))
        panel.looked.connect(show.set_look)
        panel.camera_chosen.connect(show.choose_camera)
        panel.coarseness_chosen.connect(show.choose_coarseness)
        panel.samples_chosen.connect(show.choose_samples)
        self.frames.chosen.connect(show.read)
        show.reading_began.connect(lambda: self._progress.setText("reading …"))
        show.opened.connect(self._open)
        show.failed.connect(self._fail)
        show.warned.connect(self._warn)
        show.arrived.connect(self._take)
        show.looked.connect(self._take_look)
        show.viewed.connect(self._take_view)

    def _fit(self, width: int, height: int) -> None:
        """As large as shows so many pixels, as far as the screen has room."""
        ratio = self.devicePixelRatioF()
        room = self.screen().availableGeometry()
        hint, picture = self.sizeHint(), self.canvas.sizeHint()
        beside = (hint.width() - picture.width(), hint.height() - picture.height())
        rooms = (room.width() - AROUND[0] - beside[0], room.height() - AROUND[1] - beside[1])
        sides = (width / ratio, height / ratio)
        scale = 1.0 if self._size else max(0.1, min(1.0, rooms[0] / sides[0], rooms[1] / sides[1]))
        self.resize(round(sides[0] * scale) + beside[0], round(sides[1] * scale) + beside[1])

    def _open(self, seen: Seen, is_first: bool) -> None:
        if is_first and self._size is None and not self.isMaximized():
            self._fit(*seen.about["resolution"])
        self.frames.take(seen.frames, seen.about["frame"])
        self.messages.clear()
        self.messages.addItems([("⚠ " if warns else "") + text for warns, text in seen.messages])
        if any(warns for warns, _ in seen.messages):
            self._show_messages()
        elif self._told_by_itself:
            self.messages_dock.hide()
            self._told_by_itself = False
        self.canvas.say(note="gonio renders …")
        self._show.resize(self.canvas.pixels)

    def _show_messages(self) -> None:
        if not self.messages_dock.isVisible():
            self._told_by_itself = True
            self.messages_dock.show()
            self.resizeDocks([self.messages_dock], [MESSAGES], Qt.Orientation.Vertical)

    def _warn(self, warnings: list[tuple[str, str]]) -> None:
        self.messages.addItems([f"⚠ {origin}: {message}" for origin, message in warnings])
        if warnings:
            self._show_messages()

    def _fail(self, message: str) -> None:
        """Tells what is wrong; the picture stays."""
        self.canvas.say(banner=message)
        self.messages.insertItem(0, f"⚠ {message}")
        self._show_messages()
        self._progress.setText("")

    def _take(self, shot: Shot) -> None:
        self.canvas.say(banner=self._show.stage_problem)
        coarse = f", 1/{shot.factor} of the resolution" if shot.factor > 1 else ""
        done = ", finished" if shot.is_finished else ""
        self._progress.setText(f"{shot.film.samples} of {shot.wish.samples} samples, {shot.seconds:.1f} s{coarse}{done}")
        self._paint()

    def _take_look(self, look: Look) -> None:
        self.panel.take(look)
        self._paint()

    def _take_view(self) -> None:
        viewpoint, seen = self._show.viewpoint, self._show.seen
        self.canvas.set_gate(viewpoint.gate)
        if seen is not None:
            self.panel.take_cameras(seen.names_of_cameras, viewpoint.number)

    def _paint(self) -> None:
        """Shows the latest film as it is to look now."""
        shot, look = self._show.shot, self._show.look
        if shot is None or look.show not in ("picture", *shot.film.passes):
            return
        picture = look.paint(shot.film)
        self.canvas.show_picture(picture, None if look.show == "picture" else picture.legend(self.canvas.legend_height))
        self._point(*self._at)

    def _point(self, across: float, down: float) -> None:
        self._at = (across, down)
        found = self._show.probe(across, down)
        self.reading.setText("" if found is None else words(found))

    def closeEvent(self, event: QCloseEvent) -> None:
        """Ends all that runs beside the window."""
        self._show.close()
        super().closeEvent(event)

    # What menus and keys do, by the table in `keys`.

    def reload(self) -> None:
        """Reads the stage once more."""
        self._show.reload()

    def save_picture(self) -> None:
        """Asks for a file and writes what is shown."""
        if self._show.shot is None:
            return
        kinds = "All passes (*.exr);;As shown (*.png);;As shown (*.jpg)"
        path, kind = QFileDialog.getSaveFileName(self, "Save Picture", "picture.exr", kinds)
        if path:
            self.write_picture(path if Path(path).suffix else path + kind[kind.index("*") + 1 : -1])

    def write_picture(self, path: str) -> None:
        """Writes what is shown; tells where that cannot be done."""
        assert self._show.shot is not None
        try:
            self._show.look.write(self._show.shot.film, path)
            self.statusBar().showMessage(f"{path} is written", 4000)
        except Error as error:
            QMessageBox.warning(self, "Save Picture", str(error))

    def show_picture(self) -> None:
        """Shows the colours."""
        self._show.change_look(show="picture")

    def show_luminance(self) -> None:
        """Shows luminance in false colour."""
        self._show.change_look(show="luminance")

    def show_illuminance(self) -> None:
        """Shows illuminance in false colour."""
        self._show.change_look(show="illuminance")

    def brighter(self) -> None:
        """A third of a stop."""
        self._show.change_look(stops=self._show.look.stops + THIRD)

    def darker(self) -> None:
        """A third of a stop."""
        self._show.change_look(stops=self._show.look.stops - THIRD)

    def reset_exposure(self) -> None:
        """No stops, and the automatic exposure."""
        self._show.change_look(stops=0.0, is_automatic=True)

    def toggle_automatic(self) -> None:
        """Holds the exposure, or lets it follow the picture."""
        self._show.change_look(is_automatic=not self._show.look.is_automatic)

    def measure_lux(self) -> None:
        """Whether illuminance under the cursor is rendered."""
        self._show.measure(self._actions["measure_lux"].isChecked())

    def toggle_messages(self) -> None:
        """Shows or hides them."""
        if self.messages_dock.isVisible():
            self.messages_dock.hide()
        else:
            self._show_messages()
        self._told_by_itself = False

    def frame_all(self) -> None:
        """Shows everything, from the same side."""
        self._show.frame_all()

    def home(self) -> None:
        """Looks through the stage's own choice of a camera."""
        self._show.viewpoint.home()
        self._show.refresh()

    def next_camera(self) -> None:
        """Looks through the stage's next camera."""
        self._show.viewpoint.next()
        self._show.refresh()

    def previous_frame(self) -> None:
        """Goes a frame back."""
        self.frames.step(-1)

    def next_frame(self) -> None:
        """Goes a frame on."""
        self.frames.step(1)

    def show_keys(self) -> None:
        """Lists mouse and keys."""
        box = QMessageBox(QMessageBox.Icon.NoIcon, "Keys", list_of_keys(), QMessageBox.StandardButton.Close, self)
        box.open()

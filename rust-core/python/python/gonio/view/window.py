"""The window around the picture: panels, menus and messages."""

from __future__ import annotations

from typing import Any

from PySide6.QtCore import Qt, QTimer
from PySide6.QtGui import QAction, QCloseEvent, QKeySequence
from PySide6.QtWidgets import QDockWidget, QLabel, QListWidget, QScrollArea

from .canvas import Canvas
from .deeds import Deeds
from .keys import DEEDS
from .look import Look
from .panel import Panel
from .probe import words
from .session import Shot
from .show import Show
from .stage import Seen

# A change of size is over once nothing came for so many milliseconds.
SETTLING = 60
# Width and height of the screen that are left to what is around the window.
AROUND = (40, 80)


class Window(Deeds):
    """Shows what a `Show` brings, and tells it what the user wants."""

    def __init__(self, show: Show, name: str, size: tuple[int, int] | None) -> None:
        super().__init__(show)
        self.setWindowTitle(f"{name} – gonio")
        self._size = size
        self._at = (-1.0, -1.0)
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
        dock = QDockWidget("View", self)
        dock.setWidget(scrolling)
        self.addDockWidget(Qt.DockWidgetArea.RightDockWidgetArea, dock)
        self.messages = QListWidget()
        self.messages.setWordWrap(True)
        self.messages_dock.setWidget(self.messages)
        self.addDockWidget(Qt.DockWidgetArea.BottomDockWidgetArea, self.messages_dock)
        self.messages_dock.hide()
        self.addToolBar(Qt.ToolBarArea.BottomToolBarArea, self.frames)
        self.reading, self._progress = QLabel(), QLabel()
        self.statusBar().addWidget(self.reading, 1)
        self.statusBar().addPermanentWidget(self._progress)
        self._settling = QTimer(self, singleShot=True, interval=SETTLING)
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
        self.frames.take(seen.frames, seen.about["frame"])
        if is_first and self._size is None and not self.isMaximized():
            self._fit(*seen.about["resolution"])
        self.messages.clear()
        self.messages.addItems([("⚠ " if warns else "") + text for warns, text in seen.messages])
        if any(warns for warns, _ in seen.messages):
            self.show_messages()
        elif self._told_by_itself:
            self.messages_dock.hide()
            self._told_by_itself = False
        self.canvas.say(note="gonio renders …")
        self._show.resize(self.canvas.pixels)

    def _warn(self, warnings: list[tuple[str, str]]) -> None:
        self.messages.addItems([f"⚠ {origin}: {message}" for origin, message in warnings])
        if warnings:
            self.show_messages()

    def _fail(self, message: str) -> None:
        """Tells what is wrong; the picture stays."""
        self.canvas.say(banner=message)
        self.messages.insertItem(0, f"⚠ {message}")
        self.show_messages()
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

"""Qt's loop: until the window is closed, or until the screenshot is written."""

from __future__ import annotations

import os
import signal
import sys
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from PySide6.QtCore import QMessageLogContext, QTimer, QtMsgType, qInstallMessageHandler
from PySide6.QtWidgets import QApplication

from .session import Shot
from .show import Show
from .window import Window

# How often Python may look at Ctrl-C, which Qt's loop does not let through; ms.
LOOK_EVERY = 100
INTERRUPTED = 130
# Qt draws what has just changed in its next rounds; ms.
DRAWING = 150


def run(command: Sequence[str], folder: str | os.PathLike[str], choices: Mapping[str, Any]) -> int:
    """Opens the window and waits; gives the exit status."""
    qInstallMessageHandler(_say)
    application = QApplication.instance() or QApplication([sys.argv[0]])
    show = Show(command, folder, choices)
    window = Window(show, Path(choices["stage"]).name, choices["resolution"])
    screenshot = None
    if choices["screenshot"] is not None:
        # Signals alone do not keep it.
        screenshot = Screenshot(window, show, choices["screenshot"], min(choices["after"], choices["samples"]))
    before = signal.signal(signal.SIGINT, lambda *_: application.exit(INTERRUPTED))
    ticking = QTimer()
    ticking.timeout.connect(lambda: None)
    ticking.start(LOOK_EVERY)
    show.reload()
    window.show()
    try:
        return int(application.exec())
    finally:
        signal.signal(signal.SIGINT, before)
        del screenshot
        window.close()


def _say(_kind: QtMsgType, _context: QMessageLogContext, text: str) -> None:
    """What Qt has to say, but that windows nobody sees have no limits of their size."""
    if "propagateSizeHints" not in text:
        sys.stderr.write(f"gonio: Qt: {text}\n")


class Screenshot:
    """Writes what the window shows once the picture has its samples, or once it is known that there is none, and ends the loop."""

    def __init__(self, window: Window, show: Show, path: str | os.PathLike[str], samples: int) -> None:
        self._window, self._path, self._samples = window, os.fspath(path), samples
        self._is_done = False
        show.arrived.connect(self._look)
        show.failed.connect(self._fail)

    def _look(self, shot: Shot) -> None:
        if shot.is_fine and shot.film.samples >= self._samples:
            self._write(0)

    def _fail(self, message: str) -> None:
        sys.stderr.write(f"gonio: error: {message}\n")
        self._write(1)

    def _write(self, status: int) -> None:
        if not self._is_done:
            self._is_done = True
            QTimer.singleShot(DRAWING, lambda: self._grab(status))

    def _grab(self, status: int) -> None:
        if not self._window.grab().save(self._path, "PNG"):
            sys.stderr.write(f"gonio: error: {self._path}: the picture cannot be written\n")
            status = 1
        QApplication.exit(status)

"""A window with the picture, which becomes clearer while gonio renders."""

import subprocess
import tempfile

from pxr.Usdviewq.qt import QtCore, QtGui, QtWidgets

from .view import command

# How often the window looks for a new picture, ms.
LOOK_EVERY = 300


class PictureWindow(QtWidgets.QDialog):
    """Shows the file as soon as there is one, and ends the render when it is closed."""

    def __init__(self, parent, line, picture, folder):
        super().__init__(parent)
        self.setWindowTitle("gonio")
        self._label = QtWidgets.QLabel("gonio reads the stage …")
        layout = QtWidgets.QVBoxLayout(self)
        layout.addWidget(self._label)
        self._folder, self._picture, self._shown = folder, picture, None
        self._process = subprocess.Popen(line, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        self._timer = QtCore.QTimer(self)
        self._timer.timeout.connect(self._look)
        self._timer.start(LOOK_EVERY)

    def _look(self):
        ended = self._process.poll() is not None
        if self._picture.exists() and self._picture.stat().st_mtime_ns != self._shown:
            self._shown = self._picture.stat().st_mtime_ns
            self._label.setPixmap(QtGui.QPixmap(str(self._picture)))
            # The window was made for a line of words.
            self.resize(self.sizeHint())
        elif ended and self._shown is None:
            self._label.setText(self._process.stderr.read())
        if ended:
            self._timer.stop()

    def done(self, result):
        self._timer.stop()
        self._process.terminate()
        self._process.communicate()
        self._folder.cleanup()
        super().done(result)


def render(api):
    """Render the current view."""
    folder = tempfile.TemporaryDirectory(prefix="gonio-")
    line, picture = command(api, folder.name, size(api))
    PictureWindow(api.qMainWindow, line, picture, folder).show()


def size(api):
    """Width and height of the view in pixels."""
    width, height = api.viewportSize
    # There is no view where usdview runs without its renderer.
    return (int(width), int(height)) if width > 0 and height > 0 else (960, 540)

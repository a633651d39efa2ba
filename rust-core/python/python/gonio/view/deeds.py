"""What the menus and keys of the window do, by the table in `keys`."""

from __future__ import annotations

from pathlib import Path

from PySide6.QtCore import Qt
from PySide6.QtGui import QAction
from PySide6.QtWidgets import QDockWidget, QFileDialog, QMainWindow, QMessageBox

from .._gonio import Error
from .frames import Frames
from .keys import list_of_keys
from .show import Show

THIRD = 1.0 / 3.0
# Height of the messages at first, pixels.
MESSAGES = 90


class Deeds(QMainWindow):
    """The part of a window that is called from its menus; the rest fills it."""

    def __init__(self, show: Show) -> None:
        super().__init__()
        self._show = show
        self.frames = Frames()
        self.messages_dock = QDockWidget("Messages", self)
        # Whether the messages came by themselves, and may go so.
        self._told_by_itself = False
        # The entries of the menus by the names of what they call.
        self._actions: dict[str, QAction] = {}

    def show_messages(self) -> None:
        """Shows them, as high as a few lines."""
        if not self.messages_dock.isVisible():
            self._told_by_itself = True
            self.messages_dock.show()
            self.resizeDocks([self.messages_dock], [MESSAGES], Qt.Orientation.Vertical)

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
        except (Error, OSError) as error:
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
            self.show_messages()
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

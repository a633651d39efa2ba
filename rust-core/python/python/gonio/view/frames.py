"""The slider of frames, for stages that move."""

from __future__ import annotations

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QDoubleSpinBox, QSlider, QToolBar


class Frames(QToolBar):
    """`chosen` tells of a frame that the user wants."""

    chosen = Signal(float)

    def __init__(self) -> None:
        super().__init__("Frames")
        self.setObjectName("Frames")
        self._slider = QSlider(Qt.Orientation.Horizontal)
        self._number = QDoubleSpinBox(decimals=2)
        # Half a number is no wish.
        self._number.setKeyboardTracking(False)
        self._slider.valueChanged.connect(self._choose)
        self._number.valueChanged.connect(self._choose)
        self.addWidget(self._slider)
        self.addWidget(self._number)
        self.hide()

    def take(self, frames: tuple[float, float] | None, frame: float | None) -> None:
        """Shows the frames that there are, and the one that is shown; tells nobody."""
        self.setVisible(frames is not None)
        if frames is None or frame is None:
            return
        blockers = [QSignalBlocker(self._slider), QSignalBlocker(self._number)]
        first, last = frames
        self._slider.setRange(round(first), round(last))
        self._number.setRange(min(first, frame), max(last, frame))
        self._slider.setValue(round(frame))
        self._number.setValue(frame)
        del blockers

    def step(self, frames: int) -> None:
        """Goes so many frames on, as far as there are any."""
        if self.isVisible():
            self._number.setValue(self._number.value() + frames)

    def _choose(self, frame: float) -> None:
        blockers = [QSignalBlocker(self._slider), QSignalBlocker(self._number)]
        self._slider.setValue(round(frame))
        self._number.setValue(frame)
        del blockers
        self.chosen.emit(float(frame))

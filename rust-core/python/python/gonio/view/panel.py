"""The controls beside the picture."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import replace

from PySide6.QtCore import QSignalBlocker, Qt, Signal
from PySide6.QtWidgets import QCheckBox, QComboBox, QDoubleSpinBox, QFormLayout, QHBoxLayout, QLabel, QSlider, QSpinBox, QWidget

from .look import OPERATORS, Look

SHOWN = {"picture": "Picture", "luminance": "Luminance, cd/m²", "illuminance": "Illuminance, lx"}
OPERATOR_WORDS = {"photographic": "Photographic", "local": "Photographic, local", "ev100": "Fixed, by EV", "none": "None"}
FREE = "Free camera"
# By the entry of the menu: pixels each way that become one while the view moves; 0 for what comes in time.
COARSENESS = {"In time": 0, "Full": 1, "1/2": 2, "1/4": 4, "1/8": 8}
# The slider's steps in a stop, and its stops to each side.
STEPS_A_STOP, STOPS = 6, 10


class Panel(QWidget):
    """Shows a `Look` and the cameras, and tells what the user wants of them."""

    looked = Signal(object)
    # The number of a camera of the stage, −1 for the free one.
    camera_chosen = Signal(int)
    coarseness_chosen = Signal(int)
    samples_chosen = Signal(int)

    def __init__(self, look: Look, samples: int) -> None:
        super().__init__()
        self._look = look
        self._form = QFormLayout(self)
        self._camera = self._combo([FREE], lambda number: self.camera_chosen.emit(number - 1))
        self._form.addRow("Camera", self._camera)
        self._show = self._combo(SHOWN.values(), lambda number: self._change(show=[*SHOWN][number]))
        self._form.addRow("Show", self._show)
        self._operator = self._combo([OPERATOR_WORDS[name] for name in OPERATORS], lambda number: self._change(operator=OPERATORS[number]))
        self._form.addRow("Tone mapping", self._operator)
        self._add_exposure()
        self._add_scale()
        self._coarse = self._combo(COARSENESS, lambda number: self.coarseness_chosen.emit([*COARSENESS.values()][number]))
        self._form.addRow("While moving", self._coarse)
        self._samples = QSpinBox(minimum=1, maximum=1 << 20, value=samples)
        self._samples.setKeyboardTracking(False)
        self._samples.valueChanged.connect(self.samples_chosen)
        self._form.addRow("Samples", self._samples)
        self.take(look)

    def _combo(self, words: Sequence[str] | object, chosen: Callable[[int], object]) -> QComboBox:
        box = QComboBox()
        box.addItems([*words])  # type: ignore[misc]
        box.setSizeAdjustPolicy(QComboBox.SizeAdjustPolicy.AdjustToMinimumContentsLengthWithIcon)
        box.setMinimumContentsLength(14)
        box.activated.connect(chosen)
        return box

    def _add_exposure(self) -> None:
        self._stops = QSlider(Qt.Orientation.Horizontal)
        self._stops.setRange(-STOPS * STEPS_A_STOP, STOPS * STEPS_A_STOP)
        self._stops_text = QLabel()
        self._stops.valueChanged.connect(lambda value: self._change(stops=value / STEPS_A_STOP))
        row = QHBoxLayout()
        row.addWidget(self._stops)
        row.addWidget(self._stops_text)
        self._form.addRow("Exposure", row)
        self._automatic = QCheckBox("automatic")
        self._automatic.toggled.connect(lambda is_on: self._change(is_automatic=is_on))
        self._form.addRow("", self._automatic)
        self._ev = QDoubleSpinBox(minimum=-20.0, maximum=40.0, decimals=2, singleStep=0.5, prefix="EV ")
        self._ev.setKeyboardTracking(False)
        self._ev.valueChanged.connect(lambda value: self._change(ev=value))
        self._form.addRow("EV 100", self._ev)

    def _add_scale(self) -> None:
        self._max = QDoubleSpinBox(minimum=0.0, maximum=1e9, decimals=1, singleStep=100.0)
        self._max.setSpecialValueText("by the picture")
        self._max.setKeyboardTracking(False)
        self._max.valueChanged.connect(lambda value: self._change(scale_max=value or None))
        self._form.addRow("Scale up to", self._max)
        self._logarithmic = QCheckBox("logarithmic, 3 decades")
        self._logarithmic.toggled.connect(lambda is_on: self._change(decades=3.0 if is_on else None))
        self._form.addRow("", self._logarithmic)
        self._contours = QCheckBox("lines")
        self._contours.toggled.connect(lambda is_on: self._change(contours=is_on))
        self._form.addRow("", self._contours)

    def _change(self, **changes: object) -> None:
        look = replace(self._look, **changes)  # type: ignore[arg-type]
        if look != self._look:
            self.looked.emit(look)

    def take(self, look: Look) -> None:
        """Shows this look; tells nobody."""
        self._look = look
        blockers = [QSignalBlocker(part) for part in (self._stops, self._automatic, self._ev, self._max, self._logarithmic, self._contours)]
        self._show.setCurrentIndex([*SHOWN].index(look.show))
        self._operator.setCurrentIndex(OPERATORS.index(look.operator))
        self._stops.setValue(round(look.stops * STEPS_A_STOP))
        self._stops_text.setText(f"{look.stops:+.2f}")
        self._automatic.setChecked(look.is_automatic)
        self._ev.setValue(look.ev)
        self._max.setValue(look.scale_max or 0.0)
        self._logarithmic.setChecked(look.decades is not None)
        self._contours.setChecked(look.contours)
        is_picture = look.show == "picture"
        for shown in (self._operator, self._stops, self._stops_text):
            shown.setEnabled(is_picture)
        self._automatic.setEnabled(is_picture and look.operator != "none")
        self._ev.setEnabled(is_picture and look.operator == "ev100" and not look.is_automatic)
        for part in (self._max, self._logarithmic, self._contours):
            part.setEnabled(not is_picture)
        del blockers

    def take_cameras(self, names: Sequence[str], chosen: int) -> None:
        """Shows the cameras and the one that is looked through, −1 for the free one."""
        if [self._camera.itemText(number) for number in range(self._camera.count())] != [FREE, *names]:
            self._camera.clear()
            self._camera.addItems([FREE, *names])
        self._camera.setCurrentIndex(chosen + 1)

"""The picture in the window: drawn as large as the window, turned and moved with the mouse."""

from __future__ import annotations

from PySide6.QtCore import QPointF, QRect, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QImage, QMouseEvent, QPainter, QPaintEvent, QResizeEvent, QWheelEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from .._gonio import Picture

# What a drag over the whole height turns, radians.
TURN = 3.2
# The distance after a drag over the whole height, and after a click of the wheel.
NEARER = 8.0
WHEEL = 0.88
# A click of the wheel in Qt's units.
CLICK = 120.0
BACKGROUND = QColor(38, 38, 38)
SHADE = QColor(0, 0, 0, 110)
BANNER = QColor(120, 24, 24, 225)
# Height of the legend over the window's, and its distance from the corner in pixels.
LEGEND, BORDER = 0.6, 12


class Canvas(QWidget):
    """Shows a picture and a legend; `turned`, `moved`, `neared` are drags in shares of the height, `pointed` is where the cursor is."""

    # Radians about the vertical and over it.
    turned = Signal(float, float)
    # Shares of the height.
    moved = Signal(float, float)
    # Factor on the distance.
    neared = Signal(float)
    # The cursor in shares of the width and height; negative where it has left.
    pointed = Signal(float, float)
    resized = Signal()

    def __init__(self) -> None:
        super().__init__()
        self.setMouseTracking(True)
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(64, 64)
        self._image: QImage | None = None
        self._legend: QImage | None = None
        self._banner = ""
        self._note = ""
        # Width over height of what a render would show; None for all of it.
        self._gate: float | None = None
        self._last: QPointF | None = None

    @property
    def pixels(self) -> tuple[int, int]:
        """Width and height in pixels of the screen."""
        ratio = self.devicePixelRatioF()
        return max(1, round(self.width() * ratio)), max(1, round(self.height() * ratio))

    @property
    def aspect(self) -> float:
        """Width over height."""
        width, height = self.pixels
        return width / height

    @property
    def legend_height(self) -> int:
        """For a legend that has room here, pixels."""
        return round(self.pixels[1] * LEGEND)

    @property
    def banner(self) -> str:
        """What stands over the picture."""
        return self._banner

    def show_picture(self, picture: Picture | None, legend: Picture | None = None) -> None:
        """Shows this from now on."""
        self._image = None if picture is None else image_of(picture)
        self._legend = None if legend is None else image_of(legend)
        self.update()

    def say(self, banner: str = "", note: str = "") -> None:
        """Words over the picture that say what is wrong, and a note where there is no picture."""
        self._banner, self._note = banner, note
        self.update()

    def set_gate(self, aspect: float | None) -> None:
        """The shape outside of which the picture is shaded."""
        self._gate = aspect
        self.update()

    def sizeHint(self) -> QSize:
        """As wide as pictures usually are."""
        return QSize(960, 540)

    def paintEvent(self, _event: QPaintEvent) -> None:
        """Draws all of it."""
        painter = QPainter(self)
        painter.fillRect(self.rect(), BACKGROUND)
        if self._image is not None:
            painter.drawImage(self.rect(), self._image)
            self._draw_gate(painter)
        elif self._note:
            painter.setPen(Qt.GlobalColor.lightGray)
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap, self._note)
        if self._legend is not None:
            self._draw_legend(painter, self._legend)
        if self._banner:
            self._draw_banner(painter)
        painter.end()

    def _draw_gate(self, painter: QPainter) -> None:
        if self._gate is None:
            return
        width, height = float(self.width()), float(self.height())
        inner_width, inner_height = min(width, height * self._gate), min(height, width / self._gate)
        across, down = 0.5 * (width - inner_width), 0.5 * (height - inner_height)
        if max(across, down) < 1.0:
            return
        shades = [QRectF(0, 0, across, height), QRectF(width - across, 0, across, height)]
        shades += [QRectF(0, 0, width, down), QRectF(0, height - down, width, down)]
        for shade in shades:
            painter.fillRect(shade, SHADE)
        painter.setPen(QColor(220, 220, 220, 150))
        painter.drawRect(QRectF(across, down, inner_width - 1.0, inner_height - 1.0))

    def _draw_legend(self, painter: QPainter, legend: QImage) -> None:
        ratio = self.devicePixelRatioF()
        size = QSize(round(legend.width() / ratio), round(legend.height() / ratio))
        painter.drawImage(QRect(BORDER, self.height() - BORDER - size.height(), size.width(), size.height()), legend)

    def _draw_banner(self, painter: QPainter) -> None:
        room = self.rect().adjusted(BORDER, 8, -BORDER, 0)
        flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignTop | Qt.TextFlag.TextWordWrap | Qt.TextFlag.TextWrapAnywhere
        words = painter.boundingRect(room, flags, self._banner)
        painter.fillRect(QRect(0, 0, self.width(), words.height() + 16), BANNER)
        painter.setPen(Qt.GlobalColor.white)
        painter.drawText(room, flags, self._banner)

    def resizeEvent(self, _event: QResizeEvent) -> None:
        """Another size wants another picture."""
        self.resized.emit()

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """A drag begins."""
        self._last = event.position()

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """A drag ends with its last button."""
        if event.buttons() == Qt.MouseButton.NoButton:
            self._last = None

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """The cursor, and a drag where a button is down."""
        at = event.position()
        self.pointed.emit(at.x() / self.width(), at.y() / self.height())
        if self._last is None or event.buttons() == Qt.MouseButton.NoButton:
            return
        across, down = (at.x() - self._last.x()) / self.height(), (at.y() - self._last.y()) / self.height()
        self._last = at
        buttons, keys = event.buttons(), event.modifiers()
        is_left = bool(buttons & Qt.MouseButton.LeftButton)
        if buttons & Qt.MouseButton.MiddleButton or (is_left and keys & Qt.KeyboardModifier.ShiftModifier):
            self.moved.emit(-across, down)
        elif buttons & Qt.MouseButton.RightButton or (is_left and keys & Qt.KeyboardModifier.ControlModifier):
            self.neared.emit(NEARER ** (down - across))
        elif is_left:
            self.turned.emit(-across * TURN, down * TURN)

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Nearer and further; with Alt some systems turn the wheel sideways."""
        clicks = (event.angleDelta().y() or event.angleDelta().x()) / CLICK
        if clicks:
            self.neared.emit(WHEEL**clicks)

    def leaveEvent(self, _event: object) -> None:
        """Nothing is pointed at."""
        self.pointed.emit(-1.0, -1.0)


def image_of(picture: Picture) -> QImage:
    """An opaque picture as Qt has it."""
    width, height = picture.size
    # Qt looks at the bytes as long as the image lives.
    return QImage(picture.tobytes(), width, height, 4 * width, QImage.Format.Format_RGBX8888).copy()

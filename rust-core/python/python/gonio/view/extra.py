"""Qt, which the extra `view` brings, and a screen for it."""

from __future__ import annotations

import importlib
import os
import sys

from .._gonio import UnsupportedError


def require(*, headless: bool) -> None:
    """Raises `gonio.UnsupportedError` with the remedy where no window can be opened; `headless` ones are drawn without a display."""
    try:
        importlib.import_module("PySide6.QtWidgets")
    except ImportError as error:
        raise UnsupportedError(f"the window needs Qt: pip install PySide6-Essentials ({error})") from error
    if _has_display():
        return
    if not headless:
        raise UnsupportedError("there is no display to open a window on (DISPLAY and WAYLAND_DISPLAY are not set); --screenshot needs none")
    os.environ["QT_QPA_PLATFORM"] = "offscreen"


def _has_display() -> bool:
    """Whether Qt, which ends the process where it finds no screen, can be asked."""
    if not sys.platform.startswith("linux"):
        return True
    return any(os.environ.get(name) for name in ("DISPLAY", "WAYLAND_DISPLAY", "QT_QPA_PLATFORM"))

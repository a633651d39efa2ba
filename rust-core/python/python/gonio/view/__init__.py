"""`gonio view`: a window that shows a stage, with cd/m² and lux under the cursor. What the extra `view` brings; see docs/view.md."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any

from . import extra

__all__ = ["run"]


def run(words: Sequence[str], folder: str | os.PathLike[str], choices: Mapping[str, Any]) -> int:
    """Opens the window for a command line and waits until it is closed; gives the exit status.

    `words` are those of `gonio view`, the program's name first, and `folder` is where their relative paths start; `choices` are what the
    window begins with. Raises `gonio.UnsupportedError` without Qt or without a display.
    """
    extra.require(headless=choices["screenshot"] is not None)
    from .application import run as run_window

    return run_window(words, folder, choices)

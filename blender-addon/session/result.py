# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's render results while they are written."""

from collections.abc import Iterator
from contextlib import contextmanager

# Seconds between two looks at ESC.
POLL = 0.04


@contextmanager
def open_result(engine, size: tuple[int, int], layer: str, view: str = "") -> Iterator:
    """A result that is ended whatever happens: one left open crashes Blender later. Without a view it is of the only one."""
    result = engine.begin_result(0, 0, *size, layer=layer, **({"view": view} if view else {}))
    whole = False
    try:
        yield result
        whole = True
    finally:
        engine.end_result(result, cancel=not whole)

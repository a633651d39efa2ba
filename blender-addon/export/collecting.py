# SPDX-License-Identifier: GPL-3.0-or-later
"""Python's search for cycles, put off while many objects are made."""

import gc
from contextlib import contextmanager


@contextmanager
def put_off():
    """A walk over a large scene makes many objects and no cycles; to search all of them again and again takes longer than the walk."""
    was_on = gc.isenabled()
    gc.disable()
    try:
        yield
    finally:
        if was_on:
            gc.enable()

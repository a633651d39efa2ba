# SPDX-License-Identifier: GPL-3.0-or-later
"""What tells one state of a file from the next, for what is kept of it."""

import os


def file_version(path):
    """Time of change and size; raises OSError where there is no file."""
    state = os.stat(path)
    return state.st_mtime_ns, state.st_size

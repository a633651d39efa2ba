# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings that name a file, or something that the renderer knows by that name."""

from pathlib import Path

import bpy


def file_or_name(asked, owner, read, known):
    """What a data-block asks for: `read` of the bytes and the name of a file, else `known` by its name."""
    path = Path(bpy.path.abspath(asked, library=owner.library))
    return read(path.read_bytes(), path.name) if path.is_file() else known(asked)

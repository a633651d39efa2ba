# SPDX-License-Identifier: GPL-3.0-or-later
"""What the head of a picture's file says of what Blender makes of it: asked for itself, Blender decodes the picture and keeps it."""

import io
import struct
from typing import NamedTuple

from .image_files import kind_of

# Bytes of a PNG before its chunks, and of a chunk before and after what is in it.
SIGNATURE, CHUNK_HEAD, CHUNK_END = 8, 8, 4
# What a PNG's pixels are made of.
GREY, COLOURS, COLOURS_AND_ALPHA = 0, 2, 6


class Header(NamedTuple):
    """The file's format as `kind_of` has it, and what is in it; None where only Blender knows."""

    kind: str | None = None
    is_float: bool | None = None
    has_alpha: bool | None = None


def header_of_file(path):
    """The header of a file; one that says nothing where it cannot be read."""
    try:
        with open(path, "rb") as file:
            return header_of(file)
    except OSError:
        return Header()


def header_of_bytes(content):
    """The header of a file that is in memory."""
    return header_of(io.BytesIO(content))


def header_of(file):
    """The header of an open file."""
    kind = kind_of(file.read(16))
    if kind == "PNG":
        return Header(kind, *_of_png(file))
    if kind == "JPEG":
        return Header(kind, False, False)
    return Header(kind, True if kind in ("HDR", "OPEN_EXR") else None)


def _of_png(file):
    """Whether it is of floats, and has alpha."""
    file.seek(SIGNATURE)
    parts = set()
    depth = pixels = None
    while len(head := file.read(CHUNK_HEAD)) == CHUNK_HEAD:
        length, name = struct.unpack(">I4s", head)
        if name == b"IHDR":
            content = file.read(length)
            if len(content) < 10:
                return None, None
            depth, pixels = content[8], content[9]
            length = 0
        parts.add(name)
        if name in (b"IDAT", b"tRNS"):
            break
        file.seek(length + CHUNK_END, io.SEEK_CUR)
    # Blender makes floats of sixteen bits, and alpha of colours that are said to be transparent.
    if depth is None or depth > 8 or b"IDAT" not in parts:
        return False if depth is not None and depth <= 8 else None, None
    return False, {GREY: False, COLOURS: False, COLOURS_AND_ALPHA: True}.get(pixels)

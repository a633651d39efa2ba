# SPDX-License-Identifier: GPL-3.0-or-later
"""The files behind Blender's images: which frame of a sequence, what is in it, and pixels that only Blender can read."""

import os
import re
import struct
import zlib

import bpy
import numpy as np

# How files begin that gonio reads itself; of others Blender gives the pixels.
_SIGNATURES = {b"\x89PNG": "PNG", b"\xff\xd8": "JPEG", b"#?": "HDR", b"\x76\x2f\x31\x01": "OPEN_EXR", b"BM": "BMP"}


def kind_of(head):
    """Blender's name of the format that a file's first bytes tell, where gonio reads it as Blender does; None for others."""
    if head[:4] == b"RIFF" and head[8:12] == b"WEBP":
        return "WEBP"
    return next((kind for start, kind in _SIGNATURES.items() if head.startswith(start)), None)


def path_of(image, user=None, frame=None):
    """The absolute path of an image's file; of a sequence that of a scene's frame."""
    raw = image.filepath_raw
    if image.source == "SEQUENCE" and user is not None and frame is not None:
        raw = _numbered(raw, frame_of(user, frame))
    elif user is not None and image.source != "TILED":
        raw = image.filepath_from_user(image_user=user)
    return os.path.normpath(bpy.path.abspath(raw, library=image.library)) if raw else ""


def frame_of(user, frame):
    """Which picture of a sequence or a movie a scene's frame shows."""
    length = user.frame_duration
    if length <= 0:
        return 0
    place = frame - user.frame_start + 1
    place = (place - 1) % length + 1 if user.use_cyclic else min(max(place, 0), length)
    return place + user.frame_offset


def _numbered(path, number):
    """A path with another number in the place of the last one of its name."""
    folder, name = os.path.split(path)
    stem, ending = os.path.splitext(name)
    found = re.match(r"(.*?)(\d+)(\D*)$", stem)
    if found is None:
        return path
    before, digits, after = found.groups()
    return os.path.join(folder, f"{before}{number:0{len(digits)}d}{after}{ending}")


def pixels_of(image):
    """Pixels as Blender keeps them: (height, width, 4), the bottom row first."""
    width, height = image.size
    channels = max(1, image.channels)
    flat = np.empty(width * height * channels, dtype=np.float32)
    image.pixels.foreach_get(flat)
    pixels = flat.reshape(height, width, channels)
    if channels < 3:
        alpha = pixels[..., 1:] if channels == 2 else np.ones_like(pixels)
        return np.concatenate([np.repeat(pixels[..., :1], 3, axis=-1), alpha], axis=-1)
    return pixels if channels == 4 else np.concatenate([pixels, np.ones_like(pixels[..., :1])], axis=-1)


def bytes_of(pixels):
    """Pixels of an image of bytes as those."""
    return np.round(np.clip(pixels, 0.0, 1.0) * 255.0).astype(np.uint8)


def png_of(values):
    """A PNG file of bytes (height, width, 4), the bottom row first."""
    height, width = values.shape[:2]
    rows = np.zeros((height, 1 + 4 * width), dtype=np.uint8)
    rows[:, 1:] = values[::-1].reshape(height, -1)

    def chunk(name, content):
        return struct.pack(">I", len(content)) + name + content + struct.pack(">I", zlib.crc32(name + content))

    header = struct.pack(">IIBBBBB", width, height, 8, 6, 0, 0, 0)
    parts = (chunk(b"IHDR", header), chunk(b"IDAT", zlib.compress(rows.tobytes(), 1)), chunk(b"IEND", b""))
    return b"\x89PNG\r\n\x1a\n" + b"".join(parts)


def pixels_of_frame(image, number):
    """As `pixels_of`, of one picture of a movie: an image shows the one that was scaled last."""
    copy = image.copy()
    try:
        copy.scale(*image.size, frame=number)
        return pixels_of(copy)
    finally:
        bpy.data.images.remove(copy)


def pixels_of_file(image, path, alpha_mode=None):
    """As `pixels_of`, of one file, read as the image says or with another alpha mode, and whether they are floats; None where it cannot be read."""
    try:
        single = bpy.data.images.load(path, check_existing=False)
    except RuntimeError:
        return None, False
    try:
        single.colorspace_settings.name = image.colorspace_settings.name
        single.alpha_mode = alpha_mode or image.alpha_mode
        return pixels_of(single) if single.size[0] else None, single.is_float
    finally:
        bpy.data.images.remove(single)

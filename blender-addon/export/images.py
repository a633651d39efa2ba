# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender images as gonio textures: files, packed bytes, tiles, pixels that exist in memory only."""

import os

import bpy
import numpy as np

from ..file_version import file_version

# Blender's names of colour spaces -> gonio's. Data is taken as it is.
COLOUR_SPACES = {
    "sRGB": "srgb_texture",
    "Non-Color": "raw",
    "Linear Rec.709": "lin_rec709",
    "Linear": "lin_rec709",
    "Linear BT.709": "lin_rec709",
    "Linear Rec.2020": "lin_rec2020",
    "ACEScg": "ACEScg",
    "ACES2065-1": "ACES2065-1",
    "Display P3": "srgb_displayp3",
    "Linear DCI-P3 D65": "lin_displayp3",
    "Working Space": "lin_rec709",
    "scene_linear": "lin_rec709",
}
# File formats that gonio reads itself; of others Blender gives the pixels.
READABLE = {"PNG", "JPEG", "HDR", "OPEN_EXR", "OPEN_EXR_MULTILAYER"}
# File formats that keep colours multiplied by alpha.
PREMULTIPLIED = {"OPEN_EXR", "OPEN_EXR_MULTILAYER"}


class Images:
    """Numbers of the scene's textures, kept from one export to the next."""

    def __init__(self, scene, slots):
        self._scene, self._slots = scene, slots
        # Owner of a picture that changes -> what its pixels were, and which of its two places they have.
        self._changing = {}

    def texture(self, image, user, report):
        """The number of an image as it is at this frame; None, with a report line, where there is nothing to show."""
        key, make = self._source(image, user, report)
        if key is None:
            return None
        number, is_new = self._slots.take((*key, self._colour_space(image, report)))
        if is_new:
            fields, buffers = make()
            space = "raw" if "pixels" in buffers else self._colour_space(image, report)
            description = {"origin": {"name": image.name, "file": _path(image)}, "colour_space": space, **fields}
            self._slots.place(self._scene.put_texture, number, description, **buffers)
        return number

    def baked(self, owner, name, pixels):
        """The number of a picture that was computed: (rows, columns, 4), linear, the top row first."""
        key = ("baked", *owner, hash(pixels.tobytes()))
        number, is_new = self._slots.take(key)
        if is_new:
            description = {"origin": {"name": name, "file": ""}, "colour_space": "raw"}
            self._slots.place(self._scene.put_texture, number, description, pixels=pixels)
        return number

    def changing(self, owner, name, pixels):
        """The number of a picture that is computed anew as its owner is edited: (rows, columns, 4), linear, the top row first.

        It has two places in turn: what shows it is seen to change by the number, and no picture is left behind.
        """
        mark = hash(pixels.tobytes())
        before, turn = self._changing.get(owner, (mark, 0))
        turn = turn if before == mark else 1 - turn
        self._changing[owner] = (mark, turn)
        number, is_new = self._slots.take(("changing", *owner, turn))
        if is_new or before != mark:
            description = {"origin": {"name": name, "file": ""}, "colour_space": "raw"}
            self._slots.place(self._scene.put_texture, number, description, pixels=pixels)
        return number

    @staticmethod
    def has_alpha(image):
        """Whether the file can have an alpha channel at all."""
        return image.depth not in (8, 16, 24, 48, 96)

    @staticmethod
    def stores_premultiplied(image):
        """Whether colours are stored multiplied by alpha."""
        return image.file_format in PREMULTIPLIED

    @staticmethod
    def _colour_space(image, report):
        name = image.colorspace_settings.name
        if name not in COLOUR_SPACES:
            report.add("Image", image.name, f"colour space '{name}' is not supported; sRGB is taken for bytes, linear Rec.709 for floats")
            return "lin_rec709" if image.is_float else "srgb_texture"
        return COLOUR_SPACES[name]

    def _source(self, image, user, report):
        """A key that changes with the pixels, and a function that gives the source: fields of the description, and buffers beside it."""
        if image.source in ("GENERATED", "VIEWER", "MOVIE") or image.is_dirty:
            return self._pixels(image, user, report)
        if image.source == "TILED":
            return self._tiled(image, report)
        if image.packed_file is not None and image.file_format not in READABLE:
            return self._pixels(image, user, report)
        if image.packed_file is not None:
            packed = image.packed_file
            name = image.filepath or f"{image.name}.{image.file_format.lower()}"
            key = ("packed", image.session_uid, packed.size)
            return key, lambda: ({}, {"data": (os.path.basename(name), bytes(packed.data))})
        path = _path(image, user)
        if not path or not os.path.isfile(path):
            report.add("Image", image.name, f"the file '{path or image.filepath}' was not found", severity="ERROR")
            return None, None
        if image.file_format not in READABLE:
            return self._pixels(image, user, report)
        return ("file", path, *file_version(path)), lambda: ({"source": {"File": path}}, {})

    def _tiled(self, image, report):
        path = bpy.path.abspath(image.filepath_raw, library=image.library)
        present = [path.replace("<UDIM>", str(tile.number)) for tile in image.tiles]
        if "<UDIM>" not in path or not any(os.path.isfile(tile) for tile in present):
            if len(image.packed_files):
                report.add("Image", image.name, "packed tiles are not supported; unpack the image", severity="ERROR")
            else:
                report.add("Image", image.name, f"no tile of '{path}' was found", severity="ERROR")
            return None, None
        stamp = tuple(os.stat(tile).st_mtime_ns for tile in present if os.path.isfile(tile))
        return ("tiles", path, stamp), lambda: ({"source": {"File": path}}, {})

    def _pixels(self, image, user, report):
        width, height = image.size
        if width == 0 or height == 0:
            report.add("Image", image.name, "the image has no pixels", severity="ERROR")
            return None, None
        pixels = linear_pixels(image)
        key = ("pixels", image.session_uid, hash(pixels.tobytes()))
        return key, lambda: ({}, {"pixels": np.ascontiguousarray(pixels[::-1])})


def linear_pixels(image):
    """Pixels as (height, width, 4), linear, the bottom row first."""
    width, height = image.size
    channels = max(1, image.channels)
    flat = np.empty(width * height * channels, dtype=np.float32)
    image.pixels.foreach_get(flat)
    pixels = flat.reshape(height, width, channels)
    if channels < 3:
        alpha = pixels[..., 1:] if channels == 2 else np.ones_like(pixels)
        pixels = np.concatenate([np.repeat(pixels[..., :1], 3, axis=-1), alpha], axis=-1)
    elif channels == 3:
        pixels = np.concatenate([pixels, np.ones_like(pixels[..., :1])], axis=-1)
    if not image.is_float and COLOUR_SPACES.get(image.colorspace_settings.name, "srgb_texture").startswith("srgb"):
        colour = pixels[..., :3]
        low = colour / 12.92
        high = ((np.maximum(colour, 0.0) + 0.055) / 1.055) ** 2.4
        pixels = np.concatenate([np.where(colour <= 0.04045, low, high), pixels[..., 3:]], axis=-1)
    return np.ascontiguousarray(pixels, dtype=np.float32)


def _path(image, user=None):
    """The absolute path of the file at the frame of the image user."""
    raw = image.filepath_from_user(image_user=user) if user is not None else image.filepath_raw
    return os.path.normpath(bpy.path.abspath(raw, library=image.library)) if raw else ""

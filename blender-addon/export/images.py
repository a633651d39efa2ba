# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender images as gonio textures: files, packed bytes, tiles, pixels that exist in memory only."""

import os

import bpy
import numpy as np

from ..file_version import file_version
from .colour_management import gonio_name, pixels_to_rec709, working_space
from .image_files import bytes_of, frame_of, path_of, pixels_of, pixels_of_file, pixels_of_frame, png_of
from .image_header import Header, header_of_bytes, header_of_file

# File formats that keep colours multiplied by alpha.
PREMULTIPLIED = {"OPEN_EXR", "OPEN_EXR_MULTILAYER"}
# In the place of a file's format: pixels as Blender keeps them, of floats multiplied by alpha.
MEMORY = "MEMORY"
# Sources whose pixels are in memory only.
IN_MEMORY = {"GENERATED", "VIEWER"}
# Of bytes of sRGB, by what of them is multiplied by alpha.
SPACES = {None: "srgb_texture", "codes": "srgb_codes_times_alpha", "light": "srgb_light_times_alpha"}


class Images:
    """Numbers of the scene's textures, kept from one export to the next."""

    def __init__(self, scene, slots):
        self._scene, self._slots = scene, slots
        # The scene's, which says which picture of a sequence or a movie is shown; and whether there is any.
        self.frame, self._is_animated = None, False
        # By the image's number in the session: the format of its file, and who used it last.
        self._kinds, self._users = {}, {}
        # What heads of files say, by which file or packed bytes these are of.
        self._headers = {}
        # Owner of a picture that changes -> what its pixels were, and which of its two places they have.
        self._changing = {}

    def go_to(self, frame):
        """Shows the pictures of a scene's frame; gives whether some of them may be others than before."""
        changed = self._is_animated and frame != self.frame
        self.frame = frame
        return changed

    def texture(self, image, user, report):
        """The number of an image as it is at this frame; None, with a report line, where there is nothing to show."""
        self._users[image.session_uid] = user
        self._is_animated |= image.source in ("SEQUENCE", "MOVIE")
        key, make = self._source(image, user, report)
        if key is None:
            return None
        number, is_new = self._slots.take((*key, image.colorspace_settings.name, working_space()))
        if is_new:
            fields, buffers = make()
            space = "raw" if "pixels" in buffers else self._colour_space(image, report)
            description = {"origin": {"name": image.name, "file": path_of(image)}, "colour_space": space, **fields}
            self._slots.place(self._scene.put_texture, number, description, **buffers)
        return number

    def of_bytes(self, image, user, report, product):
        """The number of an image of sRGB's bytes that bytes give, their "codes" or their "light" multiplied by alpha if asked for; None where it
        is of another kind than one picture."""
        if image.source not in ("FILE", "GENERATED"):
            return None
        self._users[image.session_uid] = user
        key, make = self._source(image, user, report)
        if key is None:
            return None
        if key[0] not in ("file", "packed"):
            if not (image.size[0] and image.size[1]):
                return None
            name = f"{os.path.basename(image.filepath) or image.name}.png"

            def make():
                return {}, {"data": (name, png_of(bytes_of(_stored(image))))}

        elif product is None:
            return self.texture(image, user, report)
        number, is_new = self._slots.take(("bytes", product, *key))
        if is_new:
            fields, buffers = make()
            description = {"origin": {"name": image.name, "file": path_of(image)}, "colour_space": SPACES[product], **fields}
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

    def has_alpha(self, image):
        """Whether the file can have an alpha channel at all."""
        told = self._header(image).has_alpha
        return image.depth not in (8, 16, 24, 48, 96) if told is None else told

    def is_float(self, image):
        """Whether Blender has floats of it, not bytes."""
        told = self._header(image).is_float
        return image.is_float if told is None else told

    def _header(self, image):
        """What the head of an image's file says."""
        if image.source != "FILE" or image.is_dirty:
            return Header()
        if image.packed_file is not None:
            return self._header_of_packed(image)
        try:
            return self._header_of_file(path_of(image))
        except OSError:
            return Header()

    def _header_of_file(self, path):
        key = (path, *file_version(path))
        if key not in self._headers:
            self._headers[key] = header_of_file(path)
        return self._headers[key]

    def _header_of_packed(self, image):
        key = (image.session_uid, image.packed_file.size)
        if key not in self._headers:
            self._headers[key] = header_of_bytes(image.packed_file.data)
        return self._headers[key]

    def stores_premultiplied(self, image):
        """Whether colours are stored multiplied by alpha."""
        kind = self._kinds.get(image.session_uid, image.file_format)
        return image.is_float if kind == MEMORY else kind in PREMULTIPLIED

    def is_seen_through(self, image, report):
        """Whether an image has pixels that are not opaque."""
        pixels = self.linear(image, report)
        return pixels is not None and bool((pixels[..., 3] < 1.0).any())

    def linear(self, image, report):
        """Pixels as (height, width, 4), linear Rec.709, the bottom row first; None where there are none."""
        user = self._users.get(image.session_uid)
        if image.source == "SEQUENCE":
            pixels, is_float = pixels_of_file(image, path_of(image, user, self.frame))
        elif not (image.size[0] and image.size[1]):
            return None
        elif image.source == "MOVIE" and user is not None and self.frame is not None:
            pixels, is_float = pixels_of_frame(image, frame_of(user, self.frame)), image.is_float
        else:
            pixels, is_float = _stored(image), image.is_float
        return None if pixels is None else _linear(pixels, image, is_float, report)

    @staticmethod
    def _colour_space(image, report):
        name = image.colorspace_settings.name
        known = gonio_name(name)
        if known is None:
            report.add("Image", image.name, f"colour space '{name}' is not supported; sRGB is taken for bytes, linear Rec.709 for floats")
            return "lin_rec709" if image.is_float else "srgb_texture"
        return known

    def _source(self, image, user, report):
        """A key that changes with the pixels, and a function that gives the source: fields of the description, and buffers beside it."""
        if image.source == "TILED":
            return self._tiled(image, report)
        is_known = gonio_name(image.colorspace_settings.name) is not None
        if image.source in IN_MEMORY or image.source == "MOVIE" or image.is_dirty:
            return self._pixels(image, report)
        if image.packed_file is not None and image.source == "FILE":
            return self._packed(image, report) if is_known and not self._is_remade(image) else self._pixels(image, report)
        path = path_of(image, user, self.frame)
        if not path or not os.path.isfile(path):
            report.add("Image", image.name, f"the file '{path or image.filepath}' was not found", severity="ERROR")
            return None, None
        kind = self._header_of_file(path).kind
        if kind is None or not is_known:
            return self._pixels(image, report)
        self._kinds[image.session_uid] = kind
        return ("file", path, *file_version(path)), lambda: ({"source": {"File": path}}, {})

    def _is_remade(self, image):
        """Whether Blender changes what a packed file holds as it unpacks it: floats are multiplied by alpha, bytes divided by it."""
        modes = ("STRAIGHT", "PREMUL") if self.is_float(image) else ("PREMUL",)
        return image.alpha_mode in modes and self.has_alpha(image)

    def _packed(self, image, report):
        packed = image.packed_file
        kind = self._header_of_packed(image).kind
        if kind is None:
            return self._pixels(image, report)
        self._kinds[image.session_uid] = kind
        name = image.filepath or f"{image.name}.{kind.lower()}"
        return ("packed", image.session_uid, packed.size), lambda: ({}, {"data": (os.path.basename(name), bytes(packed.data))})

    def _tiled(self, image, report):
        if image.is_dirty:
            report.add("Image", image.name, "what was painted on its tiles and not saved is not seen")
        path = bpy.path.abspath(image.filepath_raw, library=image.library)
        packed = {each.tile_number: each.packed_file for each in image.packed_files}
        if packed:
            sizes = tuple((number, file.size) for number, file in packed.items())
            name = os.path.basename(path) or f"{image.name}.<UDIM>"
            key = ("packed tiles", image.session_uid, sizes)
            return key, lambda: ({}, {"data": (name, {number: bytes(file.data) for number, file in packed.items()})})
        present = [path.replace("<UDIM>", str(tile.number)) for tile in image.tiles]
        if "<UDIM>" not in path or not any(os.path.isfile(tile) for tile in present):
            report.add("Image", image.name, f"no tile of '{path}' was found", severity="ERROR")
            return None, None
        lost = ", ".join(os.path.basename(tile) for tile in present if not os.path.isfile(tile))
        if lost:
            report.add("Image", image.name, f"{lost} was not found; the colour of missing images is shown there", severity="ERROR")
        stamp = tuple(os.stat(tile).st_mtime_ns for tile in present if os.path.isfile(tile))
        return ("tiles", path, stamp), lambda: ({"source": {"File": path}}, {})

    def _pixels(self, image, report):
        pixels = self.linear(image, report)
        if pixels is None:
            report.add("Image", image.name, "the image has no pixels", severity="ERROR")
            return None, None
        self._kinds[image.session_uid] = MEMORY
        key = ("pixels", image.session_uid, hash(pixels.tobytes()))
        return key, lambda: ({}, {"pixels": np.ascontiguousarray(pixels[::-1])})


def _stored(image):
    """Pixels as Cycles takes them: bytes of a file that it opens itself are as the file has them, whatever it is said to hold."""
    is_own = image.source == "FILE" and image.packed_file is None and not image.is_dirty
    if is_own and not image.is_float and image.alpha_mode == "PREMUL":
        pixels, _ = pixels_of_file(image, path_of(image), alpha_mode="STRAIGHT")
        if pixels is not None:
            return pixels
    return pixels_of(image)


def _linear(pixels, image, is_float, report):
    """Blender's pixels of an image in linear Rec.709: floats are in the working space, bytes in the image's own."""
    space = image.colorspace_settings.name
    if image.colorspace_settings.is_data:
        return pixels
    if not is_float and gonio_name(space) == "srgb_texture":
        colour = pixels[..., :3]
        high = ((np.maximum(colour, 0.0) + 0.055) / 1.055) ** 2.4
        pixels[..., :3] = np.where(colour <= 0.04045, colour / 12.92, high)
    elif not pixels_to_rec709(pixels, working_space() if is_float else space):
        report.add("Image", image.name, f"colour space '{space}' is not supported; its numbers are taken as linear Rec.709")
    return pixels

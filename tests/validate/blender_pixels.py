"""Reading pictures inside Blender, for scripts that run there."""

from pathlib import Path

import bpy
import numpy


def pixels(path: Path) -> numpy.ndarray:
    """A rendered EXR file as an array, top row first."""
    picture = bpy.data.images.load(str(path))
    picture.colorspace_settings.name = "Non-Color"
    width, height = picture.size
    values = numpy.empty(width * height * picture.channels, "f4")
    picture.pixels.foreach_get(values)
    bpy.data.images.remove(picture)
    return values.reshape(height, width, -1)[::-1, :, :3].astype("f8")

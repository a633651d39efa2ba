# SPDX-License-Identifier: GPL-3.0-or-later
"""What a light's photometric settings say, for its panel and for the export."""

from functools import lru_cache
from math import degrees
from pathlib import Path

import bpy
import gonio


def is_photometric(light) -> bool:
    """Whether a light's strength is stated in photometric units."""
    return light.gonio.use_photometry


def file_of(light):
    """The path of a light's file, what tells its versions apart, lamp set and tilt, or None; raises OSError where there is none."""
    settings = light.gonio
    if not settings.use_photometry or not settings.file or light.type == "SUN":
        return None
    path = Path(bpy.path.abspath(settings.file, library=light.library))
    state = path.stat()
    return str(path), state.st_mtime_ns, state.st_size, settings.lamp_set, degrees(settings.tilt)


def goniogram(light):
    """Description and warnings of the light's file, or None without one; raises OSError and gonio.Error."""
    found = file_of(light)
    return None if found is None else _goniogram(*found)


def figures(light):
    """The figures of the light's file, or None without one; raises OSError and gonio.Error."""
    found = file_of(light)
    return None if found is None else _figures(*found)


# Exports and panels ask again and again.
@lru_cache(maxsize=64)
def _goniogram(path, _time, _size, lamp_set, tilt):
    return gonio.read_goniogram(Path(path).read_bytes(), path, lamp_set=lamp_set, tilt=tilt)


@lru_cache(maxsize=64)
def _figures(path, _time, _size, lamp_set, tilt):
    return gonio.goniogram_figures(Path(path).read_bytes(), path, lamp_set=lamp_set, tilt=tilt)

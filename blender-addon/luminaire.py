# SPDX-License-Identifier: GPL-3.0-or-later
"""What a light's photometric settings say, for its panel and for the export."""

import re
from functools import lru_cache
from math import degrees
from pathlib import Path

import bpy
import gonio

from .file_version import file_version

# An IES file's line with the name of a file of tilt factors; what it means is the reader's business, here it is looked at for changes.
TILT_LINE = re.compile(rb"^[ \t]*TILT[ \t]*=[ \t]*(.*?)[ \t]*\r?$", re.IGNORECASE | re.MULTILINE)


def is_photometric(light) -> bool:
    """Whether a light's strength is stated in photometric units."""
    return light.gonio.use_photometry


def file_of(light):
    """The path of a light's file, what tells its versions apart, lamp set and tilt, or None; raises OSError where there is none."""
    settings = light.gonio
    if not settings.use_photometry or not settings.file or light.type == "SUN":
        return None
    path = Path(bpy.path.abspath(settings.file, library=light.library))
    version = file_version(path)
    return str(path), (version, _version_beside(path, version)), settings.lamp_set, degrees(settings.tilt)


def goniogram(light):
    """Description and warnings of the light's file, or None without one; raises OSError and gonio.Error."""
    found = file_of(light)
    return None if found is None else _goniogram(*found)


def figures(light):
    """The figures of the light's file, or None without one; raises OSError and gonio.Error."""
    found = file_of(light)
    return None if found is None else _figures(*found)


def _version_beside(path, version):
    """The version of the file of tilt factors, or None without one."""
    name = _tilt_file(path, version)
    try:
        return file_version(path.with_name(name)) if name else None
    except (OSError, ValueError):
        # The reader says what is wrong with it.
        return None


# Exports and panels ask again and again.
@lru_cache(maxsize=64)
def _tilt_file(path, _version):
    """What the file says of its tilt: a file's name, or a word that is none's."""
    line = TILT_LINE.search(path.read_bytes())
    return line.group(1).decode("latin-1") if line else None


@lru_cache(maxsize=64)
def _goniogram(path, _version, lamp_set, tilt):
    return gonio.read_goniogram(Path(path).read_bytes(), path, lamp_set=lamp_set, tilt=tilt)


@lru_cache(maxsize=64)
def _figures(path, _version, lamp_set, tilt):
    return gonio.goniogram_figures(Path(path).read_bytes(), path, lamp_set=lamp_set, tilt=tilt)

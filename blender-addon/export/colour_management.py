# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's colour spaces and gonio's: the working space of the file, and the spaces of images, by OpenColorIO's configuration.

Gonio reckons in linear Rec.709. Colours of sockets, lamps and attributes come in through `to_rec709`, passes go out through `to_working`.
"""

import os
from functools import cache

import bpy
import numpy as np

REC709 = "Linear Rec.709"
# Blender's names of colour spaces -> gonio's. Data is taken as it is.
COLOUR_SPACES = {
    "sRGB": "srgb_texture",
    "Non-Color": "raw",
    "Raw": "raw",
    REC709: "lin_rec709",
    "Linear": "lin_rec709",
    "Linear BT.709": "lin_rec709",
    "Linear Rec.709 (sRGB)": "lin_rec709",
    "Linear Rec.2020": "lin_rec2020",
    "ACEScg": "ACEScg",
    "ACES2065-1": "ACES2065-1",
    "Display P3": "srgb_displayp3",
    "Linear DCI-P3 D65": "lin_displayp3",
    "Linear CIE-XYZ D65": "lin_ciexyzd65",
    "Linear CIE-XYZ E": "ciexyz",
    "Rec.1886": "g24_rec709",
}
# Names of the working space itself.
WORKING = ("Working Space", "scene_linear")
# What configurations call linear Rec.709.
_REC709_NAMES = (REC709, "Linear Rec.709 (sRGB)", "lin_rec709", "Utility - Linear - Rec.709", "Utility - Linear - sRGB", "Linear")
# Where there is no OpenColorIO: to linear Rec.709 by the Bradford transform, as all its configurations have it.
_MATRICES = {
    "ACEScg": ((1.705051, -0.621792, -0.083259), (-0.130256, 1.140805, -0.010548), (-0.024003, -0.128969, 1.152972)),
    "Linear Rec.2020": ((1.660491, -0.587641, -0.072850), (-0.124550, 1.132900, -0.008349), (-0.018151, -0.100579, 1.118730)),
}


def working_space():
    """The name of the space in which Blender keeps colours: the file's own since 5.0, before that the configuration's."""
    of_file = getattr(bpy.data, "colorspace", None)
    if of_file is not None:
        return of_file.working_space
    if not os.environ.get("OCIO"):
        return REC709
    space = _config() and _config().getColorSpace("scene_linear")
    return space.getName() if space else REC709


def gonio_name(name):
    """Gonio's name of an image's colour space; None for spaces that it does not know."""
    return COLOUR_SPACES.get(working_space() if name in WORKING else name)


def to_rec709(colour):
    """Linear Rec.709 of a colour in the working space; what follows its three numbers passes."""
    matrix = _matrix(working_space())
    return tuple(colour) if matrix is None else (*(float(x) for x in matrix @ np.array(colour[:3])), *colour[3:])


def colours_to_rec709(colours):
    """As `to_rec709`, of an array (N, 4)."""
    matrix = _matrix(working_space())
    if matrix is not None:
        colours[:, :3] = colours[:, :3] @ matrix.T
    return colours


def pixels_to_rec709(pixels, space):
    """Pixels (..., 3 or 4) of a space as linear Rec.709, in place; whether that could be done."""
    processor = _processor(space)
    if processor is not None:
        flat = np.ascontiguousarray(pixels[..., :3], dtype=np.float32).reshape(-1, 3)
        processor.applyRGB(flat)
        pixels[..., :3] = flat.reshape(*pixels.shape[:-1], 3)
        return True
    matrix = _matrix(space)
    if matrix is not None:
        pixels[..., :3] = pixels[..., :3] @ matrix.T
    return matrix is not None or space == REC709


def to_working(flat, channels):
    """Flat float32 pixels of 3 or 4 channels in linear Rec.709, as the working space has them."""
    matrix = _matrix(working_space())
    if matrix is None:
        return flat
    pixels = flat.reshape(-1, channels).copy()
    pixels[:, :3] = pixels[:, :3] @ np.linalg.inv(matrix).T.astype(np.float32)
    return pixels.ravel()


@cache
def _config():
    """Blender's configuration or the one that the environment names; None without OpenColorIO."""
    getattr(bpy.utils, "expose_bundled_modules", lambda: None)()
    try:
        import PyOpenColorIO as ocio
    except ImportError:
        return None
    path = os.environ.get("OCIO") or os.path.join(bpy.utils.system_resource("DATAFILES", path="colormanagement"), "config.ocio")
    try:
        return ocio.Config.CreateFromFile(path)
    except ocio.Exception:
        return None


@cache
def _processor(space):
    """From a space to linear Rec.709; None where the configuration does not have both."""
    config = _config()
    linear = config and next((name for name in _REC709_NAMES if config.getColorSpace(name)), None)
    if not linear or not config.getColorSpace(space):
        return None
    return config.getProcessor(space, linear).getDefaultCPUProcessor()


@cache
def _matrix(space):
    """From a linear space to linear Rec.709; None where that is the identity or unknown."""
    if space == REC709:
        return None
    processor = _processor(space)
    if processor is None:
        return np.array(_MATRICES[space]) if space in _MATRICES else None
    matrix = np.array([processor.applyRGB(axis) for axis in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))]).T
    return None if np.allclose(matrix, np.eye(3), atol=1e-5) else matrix

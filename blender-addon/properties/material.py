# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of materials that Blender itself has no place for."""

import bpy
from bpy.props import StringProperty

from .tag import tag_data


class GonioMaterialSettings(bpy.types.PropertyGroup):
    metal: StringProperty(
        name="Metal",
        description="What metallic parts of the material are made of, in place of their colours: a name such as gold, Al, brass or Au-McPeak, or a file "
        "of wavelengths, n and k",
        subtype="FILE_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
        update=tag_data,
    )
    glass: StringProperty(
        name="Glass",
        description="What refracting parts of the material are made of, in place of their IOR: a name such as N-BK7, water, diamond or acrylic, or a file "
        "of wavelengths and n",
        subtype="FILE_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
        update=tag_data,
    )
    spectrum: StringProperty(
        name="Spectrum",
        description="Spectrum of what the material emits, whose colour takes the place of its own: a name such as LED-B3, FL11 or 2700K, or a file of "
        "nanometres and power, SPDX",
        subtype="FILE_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
        update=tag_data,
    )

# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of a view layer that Blender itself has no switch for."""

import bpy
from bpy.props import BoolProperty

from .tag import tag_passes


class GonioViewLayerSettings(bpy.types.PropertyGroup):
    """Gonio's own passes."""

    use_pass_luminance: BoolProperty(
        name="Luminance",
        description="Luminance of what the camera sees, in cd/m², not scaled by any exposure",
        default=False,
        update=tag_passes,
    )
    use_pass_illuminance: BoolProperty(
        name="Illuminance",
        description="Illuminance in lux on the first surface that is not a mirror, by light from all bounces",
        default=False,
        update=tag_passes,
    )
    use_pass_albedo: BoolProperty(
        name="Albedo", description="Share of light that the first surface reflects or transmits", default=False, update=tag_passes
    )
    denoising_store_passes: BoolProperty(
        name="Denoising Data",
        description="Normal and albedo that guide the compositor's Denoise node",
        default=False,
        update=tag_passes,
    )
    pass_debug_sample_count: BoolProperty(
        name="Sample Count", description="Samples that each pixel has, over the most it may have", default=False, update=tag_passes
    )

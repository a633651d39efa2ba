# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of a view layer that Blender itself has no switch for."""

import bpy

from .switch import switch
from .tag import tag_passes


class GonioViewLayerSettings(bpy.types.PropertyGroup):
    """Gonio's own passes."""

    use_pass_luminance: switch("Luminance", "Luminance of what the camera sees, in cd/m², not scaled by any exposure", tag_passes)
    use_pass_illuminance: switch(
        "Illuminance", "Illuminance in lux on the first surface that is not a mirror, by light from all bounces", tag_passes
    )
    use_pass_luminance_false_color: switch(
        "Luminance in False Color", "Luminance in the steps of the scene's False Color panel, with a legend", tag_passes
    )
    use_pass_illuminance_false_color: switch(
        "Illuminance in False Color", "Illuminance in the steps of the scene's False Color panel, with a legend", tag_passes
    )
    use_pass_albedo: switch("Albedo", "Share of light that the first surface reflects or transmits", tag_passes)
    denoising_store_passes: switch("Denoising Data", "Normal and albedo that guide the compositor's Denoise node", tag_passes)
    pass_debug_sample_count: switch("Sample Count", "Samples that each pixel has, over the most it may have", tag_passes)

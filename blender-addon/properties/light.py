# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of lights that Blender itself has no place for."""

import bpy

from .switch import switch
from .tag import tag_data


class GonioLightSettings(bpy.types.PropertyGroup):
    """Settings of one light."""

    is_portal: switch("Portal", "The area light gives no light; it marks an opening through which the world's light is sampled", tag_data)

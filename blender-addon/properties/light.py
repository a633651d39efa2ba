# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of lights that Blender itself has no place for."""

import bpy
from bpy.props import BoolProperty

from .tag import tag_data


class GonioLightSettings(bpy.types.PropertyGroup):
    """Settings of one light."""

    is_portal: BoolProperty(
        name="Portal",
        description="The area light gives no light; it marks an opening through which the world's light is sampled",
        default=False,
        update=tag_data,
    )

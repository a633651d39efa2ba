# SPDX-License-Identifier: GPL-3.0-or-later
"""What *Add → Light* has while Gonio is the engine."""

import bpy

from .base import ENGINE


def _draw(self, context) -> None:
    if context.engine == ENGINE:
        self.layout.separator()
        self.layout.operator("gonio.hang_luminaire", text="Luminaire File...", icon="LIGHT_AREA")


def register() -> None:
    bpy.types.VIEW3D_MT_light_add.append(_draw)


def unregister() -> None:
    bpy.types.VIEW3D_MT_light_add.remove(_draw)

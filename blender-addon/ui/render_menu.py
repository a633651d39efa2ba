# SPDX-License-Identifier: GPL-3.0-or-later
"""What the Render menu has while Gonio is the engine."""

import bpy

from .base import ENGINE


def _draw(self, context) -> None:
    if context.engine == ENGINE:
        self.layout.separator()
        self.layout.operator("gonio.render_by_wavelength", icon="COLOR")


def register() -> None:
    bpy.types.TOPBAR_MT_render.append(_draw)


def unregister() -> None:
    bpy.types.TOPBAR_MT_render.remove(_draw)

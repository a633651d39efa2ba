# SPDX-License-Identifier: GPL-3.0-or-later
"""The render engine that Blender sees."""

import bpy

from .render_engine import GonioRenderEngine


def register() -> None:
    bpy.utils.register_class(GonioRenderEngine)


def unregister() -> None:
    bpy.utils.unregister_class(GonioRenderEngine)

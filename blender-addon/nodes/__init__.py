# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader nodes that Blender does not have."""

import bpy

from . import measured

CLASSES = (measured.GonioShaderNodeMeasured,)
MENU = "NODE_MT_category_shader_shader"


def _draw_menu(self, context):
    if context.space_data.shader_type == "OBJECT":
        for node in CLASSES:
            entry = self.layout.operator("node.add_node", text=node.bl_label)
            entry.type, entry.use_transform = node.bl_idname, True


def register() -> None:
    for node in CLASSES:
        bpy.utils.register_class(node)
    getattr(bpy.types, MENU).append(_draw_menu)


def unregister() -> None:
    getattr(bpy.types, MENU).remove(_draw_menu)
    for node in reversed(CLASSES):
        bpy.utils.unregister_class(node)

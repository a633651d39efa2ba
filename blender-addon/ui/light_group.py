# SPDX-License-Identifier: GPL-3.0-or-later
"""Light groups: those of a view layer, and which one an object's or the world's light belongs to."""

from bpy.types import Panel

from .base import GonioPanel
from .passes import LayerPanel


class GONIO_VIEWLAYER_PT_passes_lightgroups(LayerPanel, Panel):
    bl_label = "Light Groups"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_passes(self, layout, layer):
        row = layout.row()
        row.template_list("UI_UL_list", "lightgroups", layer, "lightgroups", layer, "active_lightgroup_index", rows=3)
        buttons = row.column(align=True)
        buttons.operator("scene.view_layer_add_lightgroup", icon="ADD", text="")
        buttons.operator("scene.view_layer_remove_lightgroup", icon="REMOVE", text="")
        layout.operator("scene.view_layer_add_used_lightgroups", text="Add All That Are Used")


class GONIO_OBJECT_PT_lightgroup(GonioPanel, Panel):
    bl_label = "Light Group"
    bl_context = "object"
    bl_parent_id = "OBJECT_PT_shading"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        _draw_group(self.layout, context, context.object)


class GONIO_WORLD_PT_lightgroup(GonioPanel, Panel):
    bl_label = "Light Group"
    bl_context = "world"
    bl_parent_id = "GONIO_WORLD_PT_settings"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return context.world is not None and super().poll(context)

    def draw(self, context):
        self.layout.use_property_split = True
        _draw_group(self.layout, context, context.world)


def _draw_group(layout, context, owner) -> None:
    layout.prop_search(owner, "lightgroup", context.view_layer, "lightgroups", text="Light Group", results_are_suggestions=True)


PANELS = (GONIO_VIEWLAYER_PT_passes_lightgroups, GONIO_OBJECT_PT_lightgroup, GONIO_WORLD_PT_lightgroup)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Materials."""

from bpy.types import Panel

from .base import GonioPanel, draw_shader


class MaterialPanel(GonioPanel):
    """A panel of the material tab."""

    bl_context = "material"

    @classmethod
    def poll(cls, context):
        return context.material is not None and not context.material.grease_pencil and super().poll(context)


class GONIO_MATERIAL_PT_surface(MaterialPanel, Panel):
    bl_label = "Surface"

    def draw(self, context):
        self.layout.use_property_split = True
        if not draw_shader(self.layout, context.material, "OUTPUT_MATERIAL", "Surface"):
            self.layout.prop(context.material, "diffuse_color")


class NodesPanel(MaterialPanel):
    """A panel of materials that have nodes."""

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.material.node_tree is not None


class GONIO_MATERIAL_PT_volume(NodesPanel, Panel):
    bl_label = "Volume"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        draw_shader(self.layout, context.material, "OUTPUT_MATERIAL", "Volume")


class GONIO_MATERIAL_PT_displacement(NodesPanel, Panel):
    bl_label = "Displacement"

    def draw(self, context):
        self.layout.use_property_split = True
        draw_shader(self.layout, context.material, "OUTPUT_MATERIAL", "Displacement")
        self.layout.prop(context.material, "displacement_method", text="Method")


class GONIO_MATERIAL_PT_settings(MaterialPanel, Panel):
    bl_label = "Settings"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.layout.prop(context.material, "pass_index")
        self.layout.prop(context.material, "use_transparent_shadow")
        self.layout.prop(context.material.gonio, "metal")
        self.layout.prop(context.material.gonio, "glass")
        self.layout.prop(context.material.gonio, "spectrum")


PANELS = (GONIO_MATERIAL_PT_surface, GONIO_MATERIAL_PT_volume, GONIO_MATERIAL_PT_displacement, GONIO_MATERIAL_PT_settings)

# SPDX-License-Identifier: GPL-3.0-or-later
"""Passes of a view layer."""

import bpy
from bpy.types import Panel

from .base import GonioPanel


class LayerPanel(GonioPanel):
    """A panel of the view layer tab."""

    bl_context = "view_layer"
    bl_parent_id = "GONIO_VIEWLAYER_PT_passes"

    def draw(self, context):
        self.layout.use_property_split = True
        self.layout.use_property_decorate = False
        self.draw_passes(self.layout, context.view_layer)


class GONIO_VIEWLAYER_PT_filter(GonioPanel, Panel):
    bl_label = "Filter"
    bl_context = "view_layer"
    bl_options = {"DEFAULT_CLOSED"}

    def draw(self, context):
        layout, layer = self.layout, context.view_layer
        layout.use_property_split = True
        layout.use_property_decorate = False
        column = layout.column(heading="Include")
        column.prop(layer, "use_sky", text="Environment")
        column.prop(layer, "use_solid", text="Surfaces")
        column.prop(layer, "use_strand", text="Hair")
        column.prop(layer, "use_volumes", text="Volumes")
        blurred = column.row()
        blurred.active = layer.id_data.render.use_motion_blur
        blurred.prop(layer, "use_motion_blur", text="Motion Blur")


class GONIO_VIEWLAYER_PT_override(GonioPanel, Panel):
    bl_label = "Override"
    bl_context = "view_layer"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        # Blender has such a panel itself since 5.0.
        return super().poll(context) and not hasattr(bpy.types, "VIEWLAYER_PT_override")

    def draw(self, context):
        layout, layer = self.layout, context.view_layer
        layout.use_property_split = True
        layout.use_property_decorate = False
        layout.prop(layer, "material_override")
        layout.prop(layer, "world_override")
        layout.prop(layer, "samples")


class GONIO_VIEWLAYER_PT_passes(GonioPanel, Panel):
    bl_label = "Passes"
    bl_context = "view_layer"

    def draw(self, context):
        pass


class GONIO_VIEWLAYER_PT_passes_photometry(LayerPanel, Panel):
    bl_label = "Photometry"

    def draw_passes(self, layout, layer):
        column = layout.column(heading="Include")
        column.prop(layer.gonio, "use_pass_luminance", text="Luminance (cd/m²)")
        column.prop(layer.gonio, "use_pass_illuminance", text="Illuminance (lx)")
        column = layout.column(heading="False Color")
        column.prop(layer.gonio, "use_pass_luminance_false_color", text="Luminance")
        column.prop(layer.gonio, "use_pass_illuminance_false_color", text="Illuminance")
        asked = layer.gonio.use_pass_luminance_false_color or layer.gonio.use_pass_illuminance_false_color
        if asked and changes_colors(layer.id_data.view_settings):
            layout.label(text="The view transform changes these colors", icon="INFO")
            layout.label(text="They are true under Standard, without a look, exposure or gamma", icon="BLANK1")


class GONIO_VIEWLAYER_PT_passes_data(LayerPanel, Panel):
    bl_label = "Data"

    def draw_passes(self, layout, layer):
        column = layout.column(heading="Include")
        for switch, text in (
            ("use_pass_combined", "Combined"),
            ("use_pass_z", "Z"),
            ("use_pass_mist", "Mist"),
            ("use_pass_position", "Position"),
            ("use_pass_normal", "Normal"),
            ("use_pass_uv", "UV"),
        ):
            column.prop(layer, switch, text=text)
        row = column.row()
        # Nothing is blurred where it has values.
        row.active = not is_blurred(layer)
        row.prop(layer, "use_pass_vector", text="Vector")
        column = layout.column(heading="Indexes")
        column.prop(layer, "use_pass_object_index")
        column.prop(layer, "use_pass_material_index")
        column = layout.column(heading="Guides")
        column.prop(layer.gonio, "use_pass_albedo")
        column.prop(layer.gonio, "denoising_store_passes")
        column = layout.column(heading="Debug")
        column.prop(layer.gonio, "pass_debug_sample_count")
        if hasattr(layer, "cycles") and hasattr(layer.cycles, "pass_render_time"):
            column.prop(layer.cycles, "pass_render_time")


class GONIO_VIEWLAYER_PT_passes_light(LayerPanel, Panel):
    bl_label = "Light"

    def draw_passes(self, layout, layer):
        for lobe in ("diffuse", "glossy", "transmission"):
            row = layout.column(heading=lobe.title()).row(align=True)
            for part, text in (("direct", "Direct"), ("indirect", "Indirect"), ("color", "Color")):
                row.prop(layer, f"use_pass_{lobe}_{part}", text=text, toggle=True)
        column = layout.column(heading="Other")
        column.prop(layer, "use_pass_emit", text="Emission")
        column.prop(layer, "use_pass_environment")
        column.prop(layer, "use_pass_ambient_occlusion", text="Ambient Occlusion")
        if hasattr(layer, "cycles"):
            column.prop(layer.cycles, "use_pass_shadow_catcher")


class GONIO_VIEWLAYER_PT_passes_cryptomatte(LayerPanel, Panel):
    bl_label = "Cryptomatte"

    def draw_passes(self, layout, layer):
        column = layout.column(heading="Include")
        for kind in ("object", "material", "asset"):
            column.prop(layer, f"use_pass_cryptomatte_{kind}", text=kind.title())
        column = layout.column()
        column.active = any(getattr(layer, f"use_pass_cryptomatte_{kind}") for kind in ("object", "material", "asset"))
        column.prop(layer, "pass_cryptomatte_depth", text="Levels")


class GONIO_VIEWLAYER_PT_passes_aov(LayerPanel, Panel):
    bl_label = "Shader AOV"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_passes(self, layout, layer):
        row = layout.row()
        row.template_list("VIEWLAYER_UL_aov", "aovs", layer, "aovs", layer, "active_aov_index", rows=3)
        buttons = row.column(align=True)
        buttons.operator("scene.view_layer_add_aov", icon="ADD", text="")
        buttons.operator("scene.view_layer_remove_aov", icon="REMOVE", text="")
        if layer.active_aov is not None and not layer.active_aov.is_valid:
            layout.label(text="Another pass has this name", icon="ERROR")


def is_blurred(layer) -> bool:
    """Whether a view layer blurs what moves."""
    return layer.id_data.render.use_motion_blur and layer.use_motion_blur


def changes_colors(view) -> bool:
    """Whether a scene's view settings show display colors, such as those of a false-color pass, as others."""
    return view.view_transform != "Standard" or view.look != "None" or view.exposure != 0.0 or view.gamma != 1.0 or view.use_curve_mapping


PANELS = (
    GONIO_VIEWLAYER_PT_filter,
    GONIO_VIEWLAYER_PT_override,
    GONIO_VIEWLAYER_PT_passes,
    GONIO_VIEWLAYER_PT_passes_data,
    GONIO_VIEWLAYER_PT_passes_light,
    GONIO_VIEWLAYER_PT_passes_photometry,
    GONIO_VIEWLAYER_PT_passes_cryptomatte,
    GONIO_VIEWLAYER_PT_passes_aov,
)

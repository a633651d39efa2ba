# SPDX-License-Identifier: GPL-3.0-or-later
"""Baking, where Cycles has it."""

from bpy.types import Panel

from .base import RenderPanel

# Kinds that are the same from everywhere.
UNSEEN = {"AO", "POSITION", "NORMAL", "UV", "ROUGHNESS", "ILLUMINANCE", "ENVIRONMENT"}
LOBES = {"DIFFUSE", "GLOSSY", "TRANSMISSION"}


def _multires(scene):
    """The owner of the switch for multiresolution baking, and its name: another since 5.0."""
    settings = scene.render.bake
    return (settings, "use_multires") if hasattr(settings, "use_multires") else (scene.render, "use_bake_multires")


def _is_multires(scene) -> bool:
    owner, name = _multires(scene)
    return getattr(owner, name)


class GONIO_RENDER_PT_bake(RenderPanel, Panel):
    bl_label = "Bake"
    bl_options = {"DEFAULT_CLOSED"}

    def draw_settings(self, layout, scene):
        owner, name = _multires(scene)
        if _is_multires(scene):
            layout.operator("object.bake_image", icon="RENDER_STILL")
            layout.prop(owner, name, text="Bake from Multires")
            layout.prop(*(owner, "type") if owner == scene.render.bake else (owner, "bake_type"))
            return
        kind = scene.gonio.bake_type
        if kind == "ILLUMINANCE":
            layout.operator("gonio.bake_illuminance", icon="RENDER_STILL", text="Bake")
        else:
            layout.operator("object.bake", icon="RENDER_STILL").type = kind
        layout.prop(owner, name, text="Bake from Multires")
        layout.prop(scene.gonio, "bake_type")
        if kind not in UNSEEN:
            row = layout.row()
            row.active = scene.camera is not None
            row.prop(scene.render.bake, "view_from")
        if kind == "COMBINED" or kind in {"EMIT", *LOBES}:
            layout.prop(scene.gonio, "use_denoising")


class GONIO_RENDER_PT_bake_influence(RenderPanel, Panel):
    bl_label = "Influence"
    bl_parent_id = "GONIO_RENDER_PT_bake"

    @classmethod
    def poll(cls, context):
        kind = context.scene.gonio.bake_type
        return super().poll(context) and not _is_multires(context.scene) and kind in {"NORMAL", "COMBINED", *LOBES}

    def draw_settings(self, layout, scene):
        settings, kind = scene.render.bake, scene.gonio.bake_type
        if kind == "NORMAL":
            layout.prop(settings, "normal_space", text="Space")
            column = layout.column(align=True)
            for name, text in (("normal_r", "Swizzle R"), ("normal_g", "G"), ("normal_b", "B")):
                column.prop(settings, name, text=text)
            return
        column = layout.column(heading="Lighting" if kind == "COMBINED" else "Contributions", align=True)
        column.prop(settings, "use_pass_direct")
        column.prop(settings, "use_pass_indirect")
        if kind != "COMBINED":
            column.prop(settings, "use_pass_color")
            return
        column = layout.column(heading="Contributions", align=True)
        column.active = settings.use_pass_direct or settings.use_pass_indirect
        for name in ("use_pass_diffuse", "use_pass_glossy", "use_pass_transmission", "use_pass_emit"):
            column.prop(settings, name)


class GONIO_RENDER_PT_bake_selected_to_active(RenderPanel, Panel):
    bl_label = "Selected to Active"
    bl_parent_id = "GONIO_RENDER_PT_bake"
    bl_options = {"DEFAULT_CLOSED"}

    @classmethod
    def poll(cls, context):
        return super().poll(context) and not _is_multires(context.scene)

    def draw_header(self, context):
        self.layout.prop(context.scene.render.bake, "use_selected_to_active", text="")

    def draw_settings(self, layout, scene):
        settings = scene.render.bake
        layout.active = settings.use_selected_to_active
        layout.prop(settings, "use_cage", text="Cage")
        if settings.use_cage:
            layout.prop(settings, "cage_object")
        extrusion = layout.column()
        extrusion.active = not settings.use_cage or settings.cage_object is None
        extrusion.prop(settings, "cage_extrusion", text="Extrusion")
        layout.prop(settings, "max_ray_distance")


class GONIO_RENDER_PT_bake_output(RenderPanel, Panel):
    bl_label = "Output"
    bl_parent_id = "GONIO_RENDER_PT_bake"

    def draw_settings(self, layout, scene):
        settings = scene.render.bake
        if not _is_multires(scene):
            layout.prop(settings, "target")
        if settings.target == "IMAGE_TEXTURES":
            layout.prop(settings, "use_clear", text="Clear Image")


class GONIO_RENDER_PT_bake_output_margin(RenderPanel, Panel):
    bl_label = "Margin"
    bl_parent_id = "GONIO_RENDER_PT_bake_output"

    @classmethod
    def poll(cls, context):
        return super().poll(context) and context.scene.render.bake.target == "IMAGE_TEXTURES"

    def draw_settings(self, layout, scene):
        settings, kind = scene.render.bake, scene.gonio.bake_type
        if not (kind == "UV" or (kind == "NORMAL" and settings.normal_space == "TANGENT")):
            layout.prop(settings, "margin_type", text="Type")
        layout.prop(settings, "margin", text="Size")


PANELS = (
    GONIO_RENDER_PT_bake,
    GONIO_RENDER_PT_bake_influence,
    GONIO_RENDER_PT_bake_selected_to_active,
    GONIO_RENDER_PT_bake_output,
    GONIO_RENDER_PT_bake_output_margin,
)

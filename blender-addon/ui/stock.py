# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's own panels that fit Gonio as they are."""

import bpy

from .base import ENGINE

# Panels for all engines that Gonio has its own of (Blender draws those that another engine showed before above new ones), or whose settings
# it does not read.
EXCLUDED = (
    "DATA_PT_distance",
    "DATA_PT_falloff_curve",
    "DATA_PT_cone",
    "DATA_PT_light",
    "DATA_PT_spot",
    "DATA_PT_volume_render",
    "EEVEE_MATERIAL_PT_viewport_settings",
    "NODE_DATA_PT_light",
    "NODE_DATA_PT_spot",
    "PHYSICS_PT_fluid_domain_render",
    "RENDER_PT_bake",
    "RENDER_PT_freestyle",
    "RENDER_PT_gpencil",
    "RENDER_PT_grease_pencil",
    "RENDER_PT_simplify",
    "VIEWLAYER_PT_filter",
    "VIEWLAYER_PT_freestyle",
    "VIEWLAYER_PT_layer_passes",
    "MATERIAL_PT_freestyle",
)
# Panels of single engines that fit.
INCLUDED = {
    "DATA_PT_camera_dof",
    "DATA_PT_camera_dof_aperture",
    "EEVEE_MATERIAL_PT_context_material",
    "MATERIAL_PT_preview",
    "MATERIAL_PT_custom_props",
    "OBJECT_PT_shadow_terminator",
    "OBJECT_PT_visibility",
    "VIEWLAYER_PT_override",
    "WORLD_PT_context_world",
    "WORLD_PT_custom_props",
}


def _panels():
    for panel in bpy.types.Panel.__subclasses__():
        engines, name = getattr(panel, "COMPAT_ENGINES", ()), panel.__name__
        if name in INCLUDED or ("BLENDER_RENDER" in engines and not name.startswith(EXCLUDED)):
            yield panel


def register() -> None:
    for panel in _panels():
        panel.COMPAT_ENGINES.add(ENGINE)


def unregister() -> None:
    for panel in _panels():
        panel.COMPAT_ENGINES.discard(ENGINE)

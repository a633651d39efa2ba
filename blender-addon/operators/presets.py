# SPDX-License-Identifier: GPL-3.0-or-later
"""Operators that keep the settings of a panel as a preset of the user's."""

from bl_operators.presets import AddPresetBase
from bpy.types import Operator

SCENE = "gonio = bpy.context.scene.gonio"


def _of_gonio(*names: str) -> list[str]:
    return [f"gonio.{name}" for name in names]


class GONIO_OT_sampling_preset_add(AddPresetBase, Operator):
    """Add or remove a preset of the samples of final renders"""

    bl_idname = "gonio.sampling_preset_add"
    bl_label = "Add Sampling Preset"
    preset_menu = "GONIO_PT_sampling_presets"
    preset_subdir = "gonio/sampling"
    preset_defines = [SCENE]
    preset_values = _of_gonio("use_adaptive_sampling", "samples", "adaptive_threshold", "adaptive_min_samples", "time_limit", "use_denoising")


class GONIO_OT_viewport_sampling_preset_add(AddPresetBase, Operator):
    """Add or remove a preset of the viewport's samples"""

    bl_idname = "gonio.viewport_sampling_preset_add"
    bl_label = "Add Viewport Sampling Preset"
    preset_menu = "GONIO_PT_viewport_sampling_presets"
    preset_subdir = "gonio/viewport_sampling"
    preset_defines = [SCENE]
    preset_values = _of_gonio(
        "use_preview_adaptive_sampling",
        "preview_samples",
        "preview_adaptive_threshold",
        "preview_adaptive_min_samples",
        "use_preview_denoising",
        "preview_denoising_start_sample",
        "use_preview_direct_light",
    )


class GONIO_OT_light_paths_preset_add(AddPresetBase, Operator):
    """Add or remove a preset of bounces and caustics"""

    bl_idname = "gonio.light_paths_preset_add"
    bl_label = "Add Light Paths Preset"
    preset_menu = "GONIO_PT_light_paths_presets"
    preset_subdir = "gonio/light_paths"
    preset_defines = [SCENE]
    preset_values = _of_gonio(
        "max_bounces",
        "diffuse_bounces",
        "glossy_bounces",
        "transmission_bounces",
        "volume_bounces",
        "transparent_max_bounces",
        "caustics",
        "caustics_reflective",
        "caustics_refractive",
    )


class GONIO_OT_performance_preset_add(AddPresetBase, Operator):
    """Add or remove a preset of threads, persistent data and memory of textures"""

    bl_idname = "gonio.performance_preset_add"
    bl_label = "Add Performance Preset"
    preset_menu = "GONIO_PT_performance_presets"
    preset_subdir = "gonio/performance"
    preset_defines = [SCENE, "render = bpy.context.scene.render"]
    preset_values = ["render.threads_mode", "render.use_persistent_data", *_of_gonio("texture_memory")]


CLASSES = (
    GONIO_OT_sampling_preset_add,
    GONIO_OT_viewport_sampling_preset_add,
    GONIO_OT_light_paths_preset_add,
    GONIO_OT_performance_preset_add,
)

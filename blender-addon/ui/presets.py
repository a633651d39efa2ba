# SPDX-License-Identifier: GPL-3.0-or-later
"""Presets of samples, light paths and performance, in the headers of their panels as Cycles has them."""

from pathlib import Path

import bpy
from bl_ui.utils import PresetPanel
from bpy.types import Panel

from .base import ENGINE

# Has the folder `presets` of those that come with the extension.
FOLDER = str(Path(__file__).resolve().parents[1])


class GonioPresetPanel(PresetPanel):
    """A panel that lists presets; `preset_subdir` is their folder below `presets`."""

    COMPAT_ENGINES = {ENGINE}
    preset_operator = "script.execute_preset"


class GONIO_PT_sampling_presets(GonioPresetPanel, Panel):
    bl_label = "Sampling Presets"
    preset_subdir = "gonio/sampling"
    preset_add_operator = "gonio.sampling_preset_add"


class GONIO_PT_viewport_sampling_presets(GonioPresetPanel, Panel):
    bl_label = "Viewport Sampling Presets"
    preset_subdir = "gonio/viewport_sampling"
    preset_add_operator = "gonio.viewport_sampling_preset_add"


class GONIO_PT_light_paths_presets(GonioPresetPanel, Panel):
    bl_label = "Light Paths Presets"
    preset_subdir = "gonio/light_paths"
    preset_add_operator = "gonio.light_paths_preset_add"


class GONIO_PT_performance_presets(GonioPresetPanel, Panel):
    bl_label = "Performance Presets"
    preset_subdir = "gonio/performance"
    preset_add_operator = "gonio.performance_preset_add"


PANELS = (GONIO_PT_sampling_presets, GONIO_PT_viewport_sampling_presets, GONIO_PT_light_paths_presets, GONIO_PT_performance_presets)


def register() -> None:
    bpy.utils.register_preset_path(FOLDER)


def unregister() -> None:
    bpy.utils.unregister_preset_path(FOLDER)

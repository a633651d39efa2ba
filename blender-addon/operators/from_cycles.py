# SPDX-License-Identifier: GPL-3.0-or-later
"""Takes over what a file says to Cycles."""

import bpy

from .. import report
from ..export import limits
from .polling import can_run

# Gonio's names of scene settings, with Cycles' where they differ.
SCENE = {
    name: name
    for name in (
        "samples",
        "preview_samples",
        "use_adaptive_sampling",
        "adaptive_threshold",
        "adaptive_min_samples",
        "use_preview_adaptive_sampling",
        "preview_adaptive_threshold",
        "preview_adaptive_min_samples",
        "use_denoising",
        "use_preview_denoising",
        "preview_denoising_start_sample",
        "time_limit",
        "seed",
        "use_animated_seed",
        "max_bounces",
        "diffuse_bounces",
        "glossy_bounces",
        "transmission_bounces",
        "volume_bounces",
        "transparent_max_bounces",
        "film_exposure",
        "caustics_reflective",
        "caustics_refractive",
        "use_sample_subset",
        "sample_offset",
        "sample_subset_length",
        "film_transparent_glass",
        "film_transparent_roughness",
        "pixel_filter_type",
        "filter_width",
    )
} | {"clamp_direct": "sample_clamp_direct", "clamp_indirect": "sample_clamp_indirect"}
VIEW_LAYER = {name: name for name in ("denoising_store_passes", "pass_debug_sample_count")}
LIGHT = {"is_portal": "is_portal"}


def take_over(owner, names: dict[str, str]) -> list[str]:
    """Copies settings of one data-block from Cycles' to Gonio's; returns the names of those that changed."""
    cycles = getattr(owner, "cycles", None)
    changed = []
    for name, source in names.items():
        if cycles is not None and hasattr(cycles, source) and getattr(owner.gonio, name) != getattr(cycles, source):
            setattr(owner.gonio, name, getattr(cycles, source))
            changed.append(name)
    return changed


def _marks_caustics(scene) -> bool:
    """Whether Cycles is to look for shadow caustics: a light and something that casts them are marked."""
    lights = [each for each in scene.objects if each.type == "LIGHT" and getattr(each.data.cycles, "is_caustics_light", False)]
    return bool(lights) and any(getattr(each.cycles, "is_caustics_caster", False) for each in scene.objects)


def left_behind(context) -> report.Report:
    """A report of what the file says to Cycles and Gonio does not follow."""
    told = report.Report()
    limits.of_file(context.scene, context.view_layer, told)
    return told


class GONIO_OT_settings_from_cycles(bpy.types.Operator):
    """Take sampling, light paths, film, passes and portals over from what this file says to Cycles"""

    bl_idname = "gonio.settings_from_cycles"
    bl_label = "Take Settings from Cycles"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return can_run(cls, (context.scene is not None and hasattr(context.scene, "cycles"), "The add-on Cycles is not enabled"))

    def execute(self, context):
        changed = take_over(context.scene, SCENE)
        if _marks_caustics(context.scene) and context.scene.gonio.caustics != "ON":
            context.scene.gonio.caustics = "ON"
            changed.append("caustics")
        if getattr(context.scene.cycles, "use_guiding", False) and context.scene.gonio.guiding == "OFF":
            context.scene.gonio.guiding = "ON"
            changed.append("guiding")
        for layer in context.scene.view_layers:
            changed += take_over(layer, VIEW_LAYER)
        lights = {each.data for each in context.scene.objects if each.type == "LIGHT"}
        for light in lights:
            if light.library is None:
                changed += take_over(light, LIGHT)
        taken = f"{len(changed)} settings taken over from Cycles" if changed else "All settings are Cycles' already"
        told = left_behind(context)
        report.publish(told)
        names = list(dict.fromkeys(line.first.message.partition(":")[0] for line in told.counted))
        self.report({"INFO"} if not names else {"WARNING"}, taken + (f"; not carried over: {', '.join(names)}" if names else ""))
        return {"FINISHED"}

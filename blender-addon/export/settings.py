# SPDX-License-Identifier: GPL-3.0-or-later
"""Render settings: those of `scene.gonio`, by Cycles' names, and Blender's own."""

import bpy

from ..properties.followed import followed
from ..units import LUMENS_PER_WATT

FILTERS = {"BOX": "box", "GAUSSIAN": "gaussian", "BLACKMAN_HARRIS": "blackman-harris", "TENT": "tent"}
# Whole widths in pixels a unit of Cycles' filter width: its windows reach a width to either side, its Gaussian's deviation is a quarter of it.
WIDTHS = {"gaussian": 1.5, "blackman-harris": 2.0, "tent": 1.0}
CAUSTICS = {"AUTO": "auto", "ON": "on", "OFF": "off"}
GUIDING = {"OFF": "off", "ON": "on", "AUTO": "auto"}
# Samples that are summed together.
BLOCK = 16
# Darker films are as noisy as this one.
LEAST_EXPOSURE = 1e-6
# Exponents of the way into the mist, as Cycles has them.
FALLOFFS = {"QUADRATIC": 2.0, "LINEAR": 1.0, "INVERSE_QUADRATIC": 0.5}


def settings(depsgraph, *, width, height, crop, preview, passes, aspect=(1.0, 1.0)):
    """The arguments of `gonio.Scene.set`; `aspect` is a pixel's width and height."""
    scene = depsgraph.scene
    render, own = scene.render, getattr(scene, "gonio", None)

    def ask(name, usual):
        return getattr(own, name, usual)

    prefix = "preview_" if preview else ""
    samples = ask("preview_samples", 1024) or 1 << 24 if preview else ask("samples", 128)
    shape = FILTERS.get(ask("pixel_filter_type", "BLACKMAN_HARRIS"), "blackman-harris")
    arguments = {
        "width": int(width),
        "height": int(height),
        "crop": crop,
        "pixel_aspect": 1.0 if preview else aspect[0] / aspect[1],
        "samples": int(samples),
        "noise_threshold": _noise_threshold(ask, prefix, int(samples)),
        "min_samples": int(ask(f"{prefix}adaptive_min_samples", 0)),
        # Noise counts by what is shown as white in Blender's units.
        "noise_white": LUMENS_PER_WATT / max(float(ask("film_exposure", 1.0)), LEAST_EXPOSURE),
        "seed": int(ask("seed", 0)) + (scene.frame_current if ask("use_animated_seed", False) else 0),
        # What moves under the mouse does not wait for learning.
        "guiding": "off" if preview else GUIDING.get(ask("guiding", "OFF"), "off"),
        "spectral": bool(ask("spectral", False)),
        "caustics": CAUSTICS.get(ask("caustics", "AUTO"), "auto"),
        "reflective_caustics": bool(ask("caustics_reflective", True)),
        "refractive_caustics": bool(ask("caustics_refractive", True)),
        "clear_roughness": _clear_roughness(own),
        "max_bounces": int(ask("max_bounces", 12)),
        "max_diffuse_bounces": int(ask("diffuse_bounces", 4)),
        "max_glossy_bounces": int(ask("glossy_bounces", 4)),
        "max_transmission_bounces": int(ask("transmission_bounces", 12)),
        "max_volume_bounces": int(ask("volume_bounces", 0)),
        "max_transparent_bounces": int(ask("transparent_max_bounces", 8)),
        # Limits are in Blender's units, the scene's radiances in cd/m².
        "clamp_direct": float(ask("clamp_direct", 0.0)) * LUMENS_PER_WATT,
        "clamp_indirect": float(ask("clamp_indirect", 0.0)) * LUMENS_PER_WATT,
        "filter": shape,
        # A box is one pixel wide, as in Cycles.
        "filter_width": float(ask("filter_width", 1.5)) * WIDTHS[shape] if shape in WIDTHS else 1.0,
        "time_limit": 0.0 if preview else float(ask("time_limit", 0.0)),
        "threads": int(render.threads) if render.threads_mode == "FIXED" else 0,
        "texture_memory": int(ask("texture_memory", 0)) << 20,
        "texture_cache": bpy.path.abspath(ask("texture_cache", "")),
        "film_transparent": bool(render.film_transparent),
        "passes": list(passes),
    }
    if not preview and ask("use_sample_subset", False):
        arguments["sample_range"] = _subset(ask, int(samples))
    if arguments.setdefault("sample_range") is not None:
        # A part of the samples cannot know which pixels have enough.
        arguments["noise_threshold"] = 0.0
    if preview and ask("use_preview_direct_light", False):
        arguments.update(max_diffuse_bounces=0, max_glossy_bounces=0)
    # The original world has no keyed values while an animation is rendered; the scene has.
    world = depsgraph.scene_eval.world
    if world is not None and "ambient_occlusion" in passes:
        arguments["occlusion_distance"] = float(world.light_settings.distance)
    mist = world.mist_settings if world is not None else None
    if mist is not None and "mist" in passes:
        arguments["mist"] = (float(mist.start), float(mist.depth), FALLOFFS[mist.falloff])
    return arguments


def _clear_roughness(own):
    """Up to what roughness glass is transparent to the film; None where it is not."""
    if own is None or not followed(own, "film_transparent_glass"):
        return None
    return float(followed(own, "film_transparent_roughness"))


def _subset(ask, samples):
    """The first sample of a subset and the one behind its last, at the nearest ends of blocks of samples; None for all of them."""
    first = int(ask("sample_offset", 0))
    first, end = (_whole_block(sample, samples) for sample in (first, first + int(ask("sample_subset_length", samples))))
    if first >= end:
        # Too little to be divided further.
        first = max(0, min(first, (samples - 1) // BLOCK * BLOCK))
        end = min(first + BLOCK, samples)
    return None if (first, end) == (0, samples) else (first, end)


def _whole_block(sample, samples):
    return samples if sample >= samples else min(round(sample / BLOCK) * BLOCK, samples)


def _noise_threshold(ask, prefix, samples):
    """The threshold, 0 where it is switched off; a threshold of 0 follows the samples, as in Cycles."""
    if not ask(f"use_{prefix}adaptive_sampling", False):
        return 0.0
    return float(ask(f"{prefix}adaptive_threshold", 0.01)) or max(0.001, 1.0 / samples)

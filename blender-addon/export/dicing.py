# SPDX-License-Identifier: GPL-3.0-or-later
"""Adaptive subdivision: how finely the renderer cuts a mesh, beyond the levels that Blender gives it."""

import bpy

# As often as the renderer cuts an edge in two.
MOST_LEVELS = 12
# The finest that Cycles takes.
LEAST_PIXELS = 0.1


def dicing_of(thing, depsgraph):
    """The arguments of `set_dicing` as sorted pairs, for objects whose last modifier subdivides adaptively; None for others."""
    last = thing.modifiers[-1] if thing.type == "MESH" and thing.modifiers else None
    is_final = depsgraph.mode == "RENDER"
    if last is None or last.type != "SUBSURF" or not (last.show_render if is_final else last.show_viewport):
        return None
    cycles = getattr(depsgraph.scene, "cycles", None)
    rate = getattr(cycles, "dicing_rate" if is_final else "preview_dicing_rate", 1.0 if is_final else 8.0)
    found = _of_modifier(last, rate) if bpy.app.version >= (5, 0, 0) else _of_object(thing, cycles, rate)
    if found is None:
        return None
    levels = min(getattr(cycles, "max_subdivisions", MOST_LEVELS), MOST_LEVELS)
    return tuple(sorted({**found, "levels": levels, "smooth": last.subdivision_type != "SIMPLE"}.items()))


def _of_modifier(modifier, rate):
    """Since 5.0 the modifier says it."""
    if not modifier.use_adaptive_subdivision:
        return None
    if modifier.adaptive_space == "OBJECT":
        return {"length": max(modifier.adaptive_object_edge_length * rate, 1e-6)}
    return {"pixels": max(modifier.adaptive_pixel_size * rate, LEAST_PIXELS)}


def _of_object(thing, cycles, rate):
    """Before, Cycles' settings of the object, where its experimental features are on."""
    own = getattr(thing, "cycles", None)
    if own is None or not own.use_adaptive_subdivision or getattr(cycles, "feature_set", "") != "EXPERIMENTAL":
        return None
    return {"pixels": max(own.dicing_rate * rate, LEAST_PIXELS)}

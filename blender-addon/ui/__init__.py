# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels of the properties editor."""

import bpy

from . import (
    add_menu,
    bake,
    curves,
    film,
    light,
    light_group,
    light_paths,
    material,
    measure,
    motion_blur,
    object_visibility,
    passes,
    performance,
    photometry,
    polar_picture,
    presets,
    render_menu,
    report,
    sampling,
    simplify,
    stock,
    subdivision,
    volume,
    world,
)

PANELS = (
    *presets.PANELS,
    *sampling.PANELS,
    *subdivision.PANELS[:1],
    *light_paths.PANELS,
    *curves.PANELS,
    *motion_blur.PANELS[:2],
    *film.PANELS,
    *simplify.PANELS,
    *performance.PANELS,
    *bake.PANELS,
    *report.PANELS,
    *passes.PANELS,
    *light.PANELS[:1],
    *photometry.PANELS,
    *light.PANELS[1:],
    *world.PANELS,
    *light_group.PANELS,
    *material.PANELS,
    *volume.PANELS,
    *object_visibility.PANELS,
    *motion_blur.PANELS[2:],
    *subdivision.PANELS[1:],
    *measure.PANELS,
)


def register() -> None:
    stock.register()
    presets.register()
    polar_picture.register()
    for panel in PANELS:
        bpy.utils.register_class(panel)
    render_menu.register()
    add_menu.register()
    report.register()


def unregister() -> None:
    report.unregister()
    add_menu.unregister()
    render_menu.unregister()
    for panel in reversed(PANELS):
        bpy.utils.unregister_class(panel)
    polar_picture.unregister()
    presets.unregister()
    stock.unregister()

# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings that live in the .blend file: `scene.gonio`, `view_layer.gonio`, `object.gonio`, `light.gonio`, `material.gonio`,
`world.gonio`."""

import bpy

from . import light, material, object, scene, view_layer, world

OWNERS = (
    (bpy.types.Scene, scene.GonioSceneSettings),
    (bpy.types.ViewLayer, view_layer.GonioViewLayerSettings),
    (bpy.types.Object, object.GonioObjectSettings),
    (bpy.types.Light, light.GonioLightSettings),
    (bpy.types.World, world.GonioWorldSettings),
    (bpy.types.Material, material.GonioMaterialSettings),
)


def register() -> None:
    for owner, settings in OWNERS:
        bpy.utils.register_class(settings)
        owner.gonio = bpy.props.PointerProperty(name="Gonio", description="Settings of the Gonio render engine", type=settings)


def unregister() -> None:
    for owner, settings in reversed(OWNERS):
        del owner.gonio
        bpy.utils.unregister_class(settings)

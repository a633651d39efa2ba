# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

gonio = bpy.context.scene.gonio

gonio.max_bounces = 32
gonio.diffuse_bounces = 32
gonio.glossy_bounces = 32
gonio.transmission_bounces = 32
gonio.volume_bounces = 32
gonio.transparent_max_bounces = 32
gonio.caustics_reflective = True
gonio.caustics_refractive = True

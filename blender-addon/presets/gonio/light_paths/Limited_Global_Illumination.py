# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

gonio = bpy.context.scene.gonio

gonio.max_bounces = 8
gonio.diffuse_bounces = 1
gonio.glossy_bounces = 4
gonio.transmission_bounces = 8
gonio.volume_bounces = 0
gonio.transparent_max_bounces = 8
gonio.caustics_reflective = False
gonio.caustics_refractive = False

# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

gonio = bpy.context.scene.gonio
render = bpy.context.scene.render

render.threads_mode = 'AUTO'
render.use_persistent_data = False
gonio.texture_memory = 1024

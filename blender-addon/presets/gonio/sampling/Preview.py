# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

gonio = bpy.context.scene.gonio

gonio.use_adaptive_sampling = True
gonio.adaptive_threshold = 0.1
gonio.samples = 1024
gonio.adaptive_min_samples = 0
gonio.time_limit = 0.0
gonio.use_denoising = True

# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

gonio = bpy.context.scene.gonio

gonio.use_adaptive_sampling = True
gonio.adaptive_threshold = 0.01
gonio.samples = 4096
gonio.adaptive_min_samples = 0
gonio.time_limit = 0.0
gonio.use_denoising = True

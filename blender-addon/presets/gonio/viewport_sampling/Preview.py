# SPDX-License-Identifier: GPL-3.0-or-later
import bpy

gonio = bpy.context.scene.gonio

gonio.use_preview_adaptive_sampling = True
gonio.preview_adaptive_threshold = 0.1
gonio.preview_samples = 1024
gonio.preview_adaptive_min_samples = 0
gonio.use_preview_denoising = False

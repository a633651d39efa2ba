# SPDX-License-Identifier: GPL-3.0-or-later
"""Render settings of a scene, named as Cycles names them."""

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from .tag import tag_data

MOST_SAMPLES = 1 << 24
MOST_BOUNCES = 1024

# The numbers are stored in files: never change or reuse one.
PIXEL_FILTERS = (
    ("BOX", "Box", "Every part of a pixel counts the same", 0),
    ("GAUSSIAN", "Gaussian", "Soft, no ringing", 1),
    ("BLACKMAN_HARRIS", "Blackman-Harris", "Sharper than Gaussian, almost no ringing", 2),
    ("TENT", "Tent", "Linear fall to the edge of the filter", 3),
)


class GonioSceneSettings(bpy.types.PropertyGroup):
    """How a scene is rendered."""

    samples: IntProperty(
        name="Samples", description="Most samples of each pixel in a final render", min=1, max=MOST_SAMPLES, default=1024, update=tag_data
    )
    preview_samples: IntProperty(
        name="Viewport Samples",
        description="Most samples of each pixel in the viewport, without limit if 0",
        min=0,
        max=MOST_SAMPLES,
        default=256,
        update=tag_data,
    )
    use_adaptive_sampling: BoolProperty(
        name="Noise Threshold",
        description="Stop sampling pixels whose estimated noise is below a threshold",
        default=False,
        update=tag_data,
    )
    adaptive_threshold: FloatProperty(
        name="Noise Threshold",
        description="Estimated relative error at which a pixel is done",
        min=0.0,
        soft_min=0.001,
        max=1.0,
        default=0.01,
        precision=4,
        update=tag_data,
    )
    adaptive_min_samples: IntProperty(
        name="Min Samples",
        description="Samples that a pixel has before its noise is estimated, chosen by the threshold if 0",
        min=0,
        max=4096,
        default=0,
        update=tag_data,
    )
    use_preview_adaptive_sampling: BoolProperty(
        name="Viewport Noise Threshold",
        description="Stop sampling pixels of the viewport whose estimated noise is below a threshold",
        default=False,
        update=tag_data,
    )
    preview_adaptive_threshold: FloatProperty(
        name="Viewport Noise Threshold",
        description="Estimated relative error at which a pixel of the viewport is done",
        min=0.0,
        soft_min=0.001,
        max=1.0,
        default=0.1,
        precision=4,
        update=tag_data,
    )
    preview_adaptive_min_samples: IntProperty(
        name="Viewport Min Samples",
        description="Samples that a pixel of the viewport has before its noise is estimated, chosen by the threshold if 0",
        min=0,
        max=4096,
        default=0,
        update=tag_data,
    )
    time_limit: FloatProperty(
        name="Time Limit",
        description="End a render after this time, export excluded; 0 is no limit. The first sample of each pixel is always finished",
        min=0.0,
        step=100,
        default=0.0,
        unit="TIME_ABSOLUTE",
    )
    seed: IntProperty(
        name="Seed", description="Another seed gives another pattern of noise", min=0, max=2**31 - 1, default=0, update=tag_data
    )
    use_animated_seed: BoolProperty(
        name="Use Animated Seed", description="Another pattern of noise for each frame", default=False, update=tag_data
    )

    max_bounces: IntProperty(
        name="Max Bounces", description="Most bounces of a light path", min=0, max=MOST_BOUNCES, default=12, update=tag_data
    )
    diffuse_bounces: IntProperty(
        name="Diffuse Bounces",
        description="Most diffuse bounces of a light path, within the total",
        min=0,
        max=MOST_BOUNCES,
        default=4,
        update=tag_data,
    )
    glossy_bounces: IntProperty(
        name="Glossy Bounces",
        description="Most glossy bounces of a light path, within the total",
        min=0,
        max=MOST_BOUNCES,
        default=4,
        update=tag_data,
    )
    transmission_bounces: IntProperty(
        name="Transmission Bounces",
        description="Most passages through refractive surfaces, within the total",
        min=0,
        max=MOST_BOUNCES,
        default=12,
        update=tag_data,
    )
    transparent_max_bounces: IntProperty(
        name="Transparent Max Bounces",
        description="Most transparent surfaces that a ray passes; not part of the total",
        min=0,
        max=MOST_BOUNCES,
        default=8,
        update=tag_data,
    )
    clamp_direct: FloatProperty(
        name="Clamp Direct",
        description="Largest value of a direct sample, no limit if 0. Less noise, but light is lost",
        min=0.0,
        max=1e8,
        default=0.0,
        update=tag_data,
    )
    clamp_indirect: FloatProperty(
        name="Clamp Indirect",
        description="Largest value of an indirect sample, no limit if 0. Less noise, but light is lost",
        min=0.0,
        max=1e8,
        default=0.0,
        update=tag_data,
    )

    film_exposure: FloatProperty(
        name="Exposure",
        description="Factor on the Combined pass and the light passes. Luminance and illuminance stay absolute",
        min=0.0,
        soft_max=2.0**10,
        max=2.0**32,
        default=1.0,
        update=tag_data,
    )
    pixel_filter_type: EnumProperty(
        name="Filter Type", description="Shape of the pixel filter", items=PIXEL_FILTERS, default="BLACKMAN_HARRIS", update=tag_data
    )
    filter_width: FloatProperty(
        name="Filter Width",
        description="Width of the pixel filter",
        min=0.01,
        max=10.0,
        default=1.5,
        subtype="PIXEL",
        update=tag_data,
    )

# SPDX-License-Identifier: GPL-3.0-or-later
"""Render settings of a scene, named as Cycles names them."""

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

from .appearance import AppearanceSettings
from .followed import shown_share, shown_switch
from .switch import switch
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

CAUSTICS = (
    ("AUTO", "Automatic", "Where a few light paths tell that they pay: a bulb in its globe, the sun through water", 0),
    ("ON", "On", "Wherever mirrors and clear glass throw light onto what the camera sees", 1),
    ("OFF", "Off", "Never: camera paths show what they happen to find", 2),
)

GUIDING = (
    ("OFF", "Off", "Never: paths go where surfaces scatter", 0),
    ("ON", "On", "Learned before each render; given up where it does not promise to pay", 1),
    ("AUTO", "Automatic", "As On, but learned only where that is a small part of the render", 2),
)

# Blender's names, and one of ours.
BAKES = (
    ("COMBINED", "Combined", "All light that leaves the surface", 0),
    ("AO", "Ambient Occlusion", "How open the surroundings are", 1),
    ("POSITION", "Position", "Place in the world", 2),
    ("NORMAL", "Normal", "Normals with their maps", 3),
    ("UV", "UV", "Texture coordinates", 4),
    ("ROUGHNESS", "Roughness", "Roughness of the shaders", 5),
    ("EMIT", "Emission", "What the surface emits", 6),
    ("DIFFUSE", "Diffuse", "Light that is scattered diffusely, its colour, or both", 7),
    ("GLOSSY", "Glossy", "Light that is reflected, its colour, or both", 8),
    ("TRANSMISSION", "Transmission", "Light that is transmitted, its colour, or both", 9),
    ("ILLUMINANCE", "Illuminance", "Light that arrives, in lux", 10),
    ("ENVIRONMENT", "Environment", "The world's light, in the direction of each place from the origin", 11),
)


def _threshold(name, description, default):
    """A relative error at which sampling stops."""
    return FloatProperty(
        name=name, description=description, min=0.0, soft_min=0.001, max=1.0, default=default, precision=4, update=tag_data
    )


def _least_samples(name, description):
    """Samples that come before any estimate of the error."""
    return IntProperty(name=name, description=description, min=0, max=4096, default=0, update=tag_data)


def _bounces(name, description, default):
    """How many bounces of a kind a path may have."""
    return IntProperty(name=name, description=description, min=0, max=MOST_BOUNCES, default=default, update=tag_data)


def _clamp(part, sample):
    """The largest value that samples of direct or of indirect light keep."""
    description = f"Largest mean of the channels of {sample}, no limit if 0. Less noise, but light is lost"
    return FloatProperty(name=f"Clamp {part}", description=description, min=0.0, max=1e8, default=0.0, update=tag_data)


class GonioSceneSettings(AppearanceSettings, bpy.types.PropertyGroup):
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
    use_adaptive_sampling: switch(
        "Noise Threshold", "Stop sampling pixels whose estimated noise is below a threshold", tag_data, default=True
    )
    adaptive_threshold: _threshold(
        "Noise Threshold",
        "Estimated error of 8 by 8 pixels, relative to what is shown, at which they are done; 0 follows the samples",
        0.01,
    )
    adaptive_min_samples: _least_samples(
        "Min Samples", "Samples that a pixel has before its noise is estimated, chosen by the threshold if 0"
    )
    use_preview_adaptive_sampling: switch(
        "Viewport Noise Threshold",
        "Stop sampling pixels of the viewport whose estimated noise is below a threshold",
        tag_data,
        default=True,
    )
    preview_adaptive_threshold: _threshold(
        "Viewport Noise Threshold",
        "Estimated error of 8 by 8 pixels of the viewport, relative to what is shown, at which they are done; 0 follows the samples",
        0.1,
    )
    preview_adaptive_min_samples: _least_samples(
        "Viewport Min Samples", "Samples that a pixel of the viewport has before its noise is estimated, chosen by the threshold if 0"
    )
    time_limit: FloatProperty(
        name="Time Limit",
        description="End a render after this time, export excluded; 0 is no limit. The first sample of each pixel is always finished",
        min=0.0,
        step=100,
        default=0.0,
        unit="TIME_ABSOLUTE",
    )
    texture_memory: IntProperty(
        name="Memory Limit",
        description="Megabytes that the textures of materials may take, without limit if 0. What goes beyond is read in tiles from the "
        "texture cache as it is needed; the picture is the same",
        min=0,
        max=2**20,
        default=0,
        update=tag_data,
    )
    texture_cache: StringProperty(
        name="Cache Folder",
        description="Where tiles of textures are kept between renders; the user's folder for caches if empty",
        subtype="DIR_PATH",
        update=tag_data,
    )
    seed: IntProperty(
        name="Seed", description="Another seed gives another pattern of noise", min=0, max=2**31 - 1, default=0, update=tag_data
    )
    guiding: EnumProperty(
        name="Path Guiding",
        description="Paths of final renders go more often where indirect light comes from, as through a door ajar. Small pictures of the "
        "view tell before the render",
        items=GUIDING,
        default="OFF",
        update=tag_data,
    )
    spectral: switch(
        "Spectral",
        "Light has wavelengths, three a path, in place of red, green and blue: spectra of lamps, metamers and thin films come out as they are",
        tag_data,
    )
    use_sample_subset: switch("Sample Subset", "Take some of the samples alone, for renders that are merged later", tag_data)
    sample_offset: IntProperty(
        name="Sample Offset", description="Samples before the first of the subset", min=0, max=MOST_SAMPLES, default=0, update=tag_data
    )
    sample_subset_length: IntProperty(
        name="Subset Length", description="Samples of the subset", min=1, max=MOST_SAMPLES, default=2048, update=tag_data
    )
    use_animated_seed: switch("Use Animated Seed", "Another pattern of noise for each frame", tag_data)

    max_bounces: _bounces("Max Bounces", "Most bounces of a light path", 12)
    diffuse_bounces: _bounces("Diffuse Bounces", "Most diffuse bounces of a light path, within the total", 4)
    glossy_bounces: _bounces("Glossy Bounces", "Most glossy bounces of a light path, within the total", 4)
    transmission_bounces: _bounces("Transmission Bounces", "Most passages through refractive surfaces, within the total", 12)
    volume_bounces: _bounces("Volume Bounces", "Most scatterings in volumes of a light path before its last, within the total", 0)
    transparent_max_bounces: _bounces("Transparent Max Bounces", "Most transparent surfaces that a ray passes; not part of the total", 8)
    caustics: EnumProperty(
        name="Caustics",
        description="Light paths from the lamps bring the light that mirrors and clear glass throw onto surfaces",
        items=CAUSTICS,
        default="AUTO",
        update=tag_data,
    )
    caustics_reflective: switch(
        "Reflective Caustics", "Surfaces that scatter diffusely are lit by what mirrors and glossy surfaces reflect", tag_data, default=True
    )
    caustics_refractive: switch(
        "Refractive Caustics", "Surfaces that scatter diffusely are lit by what glass refracts", tag_data, default=True
    )
    clamp_direct: _clamp("Direct", "a direct sample")
    clamp_indirect: _clamp("Indirect", "an indirect sample")

    film_exposure: FloatProperty(
        name="Exposure",
        description="Factor on the Combined pass and the light passes. Luminance and illuminance stay absolute",
        min=0.0,
        soft_max=2.0**10,
        max=2.0**32,
        default=1.0,
        update=tag_data,
    )
    film_transparent_glass: switch(
        "Transparent Glass", "Glass before a transparent film lets what is composited behind it be seen", tag_data
    )
    film_transparent_roughness: FloatProperty(
        name="Roughness Threshold",
        description="Glass of at most this roughness is transparent",
        min=0.0,
        max=1.0,
        default=0.1,
        update=tag_data,
    )
    # What the panel shows of the two: Cycles' values until they are set.
    shown_transparent_glass: shown_switch(
        "Transparent Glass",
        "Glass before a transparent film lets what is composited behind it be seen; Cycles' setting until it is set here",
        "film_transparent_glass",
    )
    shown_transparent_roughness: shown_share(
        "Roughness Threshold",
        "Glass of at most this roughness is transparent; Cycles' setting until it is set here",
        "film_transparent_roughness",
    )
    bake_type: EnumProperty(name="Bake Type", description="What is baked", items=BAKES, default="COMBINED")
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

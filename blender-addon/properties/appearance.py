# SPDX-License-Identifier: GPL-3.0-or-later
"""How pictures are shown: tone mapping, false colour, and what the viewport does to be quick and quiet."""

from bpy.props import BoolProperty, EnumProperty, FloatProperty, IntProperty

from .. import denoising
from .switch import switch
from .tag import tag_data

# The numbers are stored in files: never change or reuse one.
DISPLAYS = (
    ("COLOR", "Color", "The picture as it is", 0),
    ("LUMINANCE", "Luminance", "Luminance in cd/m², in false colour", 1),
    ("ILLUMINANCE", "Illuminance", "Illuminance on the first surface in lx, in false colour", 2),
)
TONE_MAPS = (
    ("NONE", "Off", "Scene-linear light; the view transform of Color Management makes the picture", 0),
    (
        "PHOTOGRAPHIC",
        "Photographic",
        "Reinhard's operator: the picture's own mean brightness becomes middle grey, highlights are compressed",
        1,
    ),
    ("LOCAL", "Local", "The same, each pixel compressed by the brightness around it, which keeps detail in bright and in dark parts", 2),
    ("EV100", "Fixed Exposure", "An exposure value at ISO 100, the same for all frames; brighter light is clipped", 3),
)
RESOLUTIONS = (
    ("AUTO", "Automatic", "As fine as leaves more than ten pictures a second", 0),
    ("FULL", "Full", "All pixels, however long that takes", 1),
    ("HALF", "1/2", "One pixel in place of 2 × 2", 2),
    ("QUARTER", "1/4", "One pixel in place of 4 × 4", 4),
    ("EIGHTH", "1/8", "One pixel in place of 8 × 8", 8),
)


class AppearanceSettings:
    """The part of a scene's settings that says how its pictures are shown."""

    tone_map: EnumProperty(
        name="Tone Map in Gonio",
        description="Gonio maps the light of final renders and of the viewport to what a display can show, instead of Blender. The view transform "
        "must be Standard, without look, exposure or gamma: it then adds the display's curve alone. The Combined pass holds the mapped picture; "
        "all other passes stay as they are",
        items=TONE_MAPS,
        default="NONE",
        update=tag_data,
    )
    tone_map_white: FloatProperty(
        name="White",
        description="Brightness that becomes white, where the picture's mean brightness is 0.18",
        min=0.1,
        soft_max=100.0,
        max=1e6,
        default=6.0,
        update=tag_data,
    )
    tone_map_ev100: FloatProperty(
        name="EV100",
        description="Exposure value at ISO 100: a luminance of 1.2 times 2 to this power, in cd/m², becomes white",
        min=-20.0,
        max=30.0,
        default=8.0,
        update=tag_data,
    )
    display: EnumProperty(
        name="Viewport Shows", description="What the rendered viewport shows", items=DISPLAYS, default="COLOR", update=tag_data
    )
    false_color_max: FloatProperty(
        name="Maximum",
        description="Upper end of the false-colour scale, in cd/m² or lx; a round number that nearly all values stay below if 0",
        min=0.0,
        max=1e9,
        default=0.0,
        update=tag_data,
    )
    false_color_steps: IntProperty(name="Steps", description="Steps of the false-colour scale", min=1, max=64, default=10, update=tag_data)
    use_false_color_contours: BoolProperty(
        name="Contours", description="Lines where steps of the false-colour scale meet", default=True, update=tag_data
    )
    use_denoising: BoolProperty(
        name="Denoise",
        description="Take noise out of final renders by Blender's own denoiser: a Denoise node of the compositor, guided by Gonio's normals and "
        "albedos",
        get=lambda settings: denoising.is_on(settings.id_data),
        set=lambda settings, on: denoising.switch(settings.id_data, on),
    )
    use_preview_denoising: switch(
        "Denoise Viewport",
        "Take noise out of the viewport's picture by a quick filter that stops at edges of surfaces, textures and shadows. Final renders and "
        "false colour are left as they are",
        tag_data,
    )
    preview_denoising_start_sample: IntProperty(
        name="Start Sample",
        description="The viewport is denoised when each pixel has so many samples; with 1, pictures while navigating are denoised too",
        min=1,
        max=4096,
        default=1,
        update=tag_data,
    )
    use_preview_direct_light: switch(
        "Direct Light Only",
        "The viewport shows light straight from lamps, the world and what shines, also through glass, and leaves out what other surfaces "
        "reflect: quick, but too dark",
        tag_data,
    )
    preview_navigation_resolution: EnumProperty(
        name="Resolution While Navigating",
        description="Pixels of the viewport's first picture after each change of the view or the scene; finer ones follow when it rests",
        items=RESOLUTIONS,
        default="AUTO",
        update=tag_data,
    )

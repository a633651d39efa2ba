# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of objects that Blender itself has no place for."""

import bpy
from bpy.props import EnumProperty, FloatProperty, IntProperty

from .switch import switch
from .tag import tag_data

# The numbers are stored in files: never change or reuse one.
QUANTITIES = (
    ("illuminance", "Illuminance", "On the surface, in lx", 0),
    ("cylindrical", "Cylindrical Illuminance", "Mean over the side of a small upright cylinder, in lx", 1),
    ("daylight-factor", "Daylight Factor", "Illuminance by the sky alone, in per cent of that on open ground", 2),
    ("ugr", "Glare (UGR)", "Unified Glare Rating of the lamps (CIE 117), for eyes that look along the object's Y axis", 3),
    (
        "melanopic-edi",
        "Melanopic EDI",
        "Melanopic equivalent daylight illuminance (CIE S 026) of eyes that look along the object's Y axis, in lx; lamps want spectra",
        4,
    ),
    ("cct", "Colour Temperature (CCT)", "Correlated colour temperature of the light on the surface, in K", 5),
    ("duv", "Tint (Duv)", "Distance of the light's colour from the blackbodies: above 0 it is greenish, below 0 pinkish", 6),
    ("ra", "Colour Rendering (Ra)", "Colour rendering of the light on the surface (CIE 13.3); lamps want spectra", 7),
    ("rf", "Colour Fidelity (Rf)", "Colour fidelity of the light on the surface (TM-30-20); lamps want spectra", 8),
    ("rg", "Gamut (Rg)", "Gamut of the light on the surface (TM-30-20); lamps want spectra", 9),
)


def _length(name, description, minimum):
    return FloatProperty(name=name, description=description, min=minimum, default=0.0, unit="LENGTH", update=tag_data)


class GonioObjectSettings(bpy.types.PropertyGroup):
    """Settings of one object."""

    is_grid: switch("Calculation Grid", "Light can be measured on a grid of points over the object's surface", tag_data)
    is_grid_only: switch("Only a Grid", "The object is not rendered: it is there to be measured on alone", tag_data)
    grid_quantity: EnumProperty(name="Quantity", description="What the grid measures", items=QUANTITIES, default="illuminance")
    grid_spacing: _length("Spacing", "Distance from point to point; that of EN 12464-1 if 0", 0.0)
    grid_margin: _length("Margin", "Width of the strip along the edges that is left out", 0.0)
    grid_height: _length("Height", "Distance from the surface to the grid, along its normal", -1e6)
    grid_eyes: IntProperty(
        name="Eyes",
        description=(
            "Directions around that eyes at the points look, the first along the object's Y axis; 0 measures the surface. "
            "Eyes of those who sit are 1.2 m high, of those who stand 1.6 m"
        ),
        min=0,
        max=64,
        update=tag_data,
    )

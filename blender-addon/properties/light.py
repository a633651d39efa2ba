# SPDX-License-Identifier: GPL-3.0-or-later
"""Settings of lights that Blender itself has no place for."""

from math import radians

import bpy
import gonio
from bpy.props import EnumProperty, FloatProperty, IntProperty, StringProperty

from .. import luminaire
from .switch import switch
from .tag import tag_data

# The numbers are stored in files: never change or reuse one.
UNITS = (
    ("FILE", "As Measured", "The intensities of the luminaire's file, in cd", 0),
    ("LUMEN", "Flux (lm)", "Luminous flux of all the light that leaves", 1),
    ("LAMP_LUMEN", "Lamp Flux (lm)", "Luminous flux of the lamps in the luminaire of the file, in the place of those measured", 2),
    ("CANDELA", "Intensity (cd)", "The greatest luminous intensity", 3),
    ("LUX", "Illuminance (lx)", "Illuminance of a surface that faces the light where it is strongest, at a distance", 4),
    ("NIT", "Luminance (cd/m²)", "The greatest luminance of the surface that shines", 5),
    ("WATT", "Radiant Flux (W)", "Radiant flux of all the light that leaves: at the lm/W of its spectrum, at 177.83 lm/W without one", 6),
)
OPENINGS = (
    ("FILE", "Luminaire", "The luminous opening that the file states", 0),
    ("POINT", "Point", "No extent: hard shadows", 1),
    ("LIGHT", "This Light", "The shape and the size of this light", 2),
)


def _is_untouched(settings) -> bool:
    """Whether the strength is the usual one, or one that was taken over."""
    return not settings.is_property_set("quantity") or settings.quantity == settings.taken_quantity


def _take(settings, unit: str, quantity: float) -> None:
    """States the strength in a unit, unless another one was chosen."""
    if settings.is_property_set("unit") and settings.unit not in (unit, settings.taken_unit):
        return
    settings.taken_quantity = quantity
    settings.unit = settings.taken_unit = unit
    settings.quantity = settings.taken_quantity


def _take_over(settings, context) -> None:
    """Photometry starts from what a luminaire's file says, or from the power that stands there."""
    if settings.use_photometry and _is_untouched(settings):
        from ..power import as_quantity

        _take(settings, *(_of_file(settings.id_data) or as_quantity(settings.id_data)))
    tag_data(settings, context)


def _of_file(light):
    """The unit and the flux of a light's file; None without one."""
    try:
        found = luminaire.figures(light)
    except (OSError, gonio.Error):
        # The panel says what is wrong with it.
        return None
    return None if found is None else ("FILE", found["flux_lm"])


def _factor(name, description):
    return FloatProperty(
        name=name, description=description, default=1.0, min=0.0, max=10.0, soft_max=1.0, subtype="FACTOR", update=tag_data
    )


class GonioLightSettings(bpy.types.PropertyGroup):
    """Settings of one light."""

    is_portal: switch("Portal", "The area light gives no light; it marks an opening through which the world's light is sampled", tag_data)
    use_photometry: switch(
        "Photometry", "State the light's strength in photometric units or by its maker's file, in the place of its power", _take_over
    )
    unit: EnumProperty(name="Unit", description="What the light's strength is stated as", items=UNITS, default="LUMEN", update=tag_data)
    quantity: FloatProperty(
        name="Strength",
        description="How much of the unit",
        default=800.0,
        min=0.0,
        soft_max=100000.0,
        step=1000,
        precision=2,
        update=tag_data,
    )
    taken_quantity: FloatProperty(
        name="Taken Strength", description="The strength that was taken over from the power or the file", options={"HIDDEN"}
    )
    taken_unit: StringProperty(name="Taken Unit", description="The unit of the strength that was taken over", options={"HIDDEN"})
    distance: FloatProperty(
        name="Distance",
        description="Where the illuminance is measured, by the inverse square law from the light's centre",
        default=1.0,
        min=0.001,
        unit="LENGTH",
        update=tag_data,
    )
    file: StringProperty(
        name="File",
        description="A luminaire's IES or EULUMDAT file. Nadir is the light's -Z, C0 its +X",
        subtype="FILE_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
        update=_take_over,
    )
    spectrum: StringProperty(
        name="Spectrum",
        description="A file of wavelengths and power (CSV, IES TM-27), or a name such as LED-B3, FL11, HP1, D65, 2700K. "
        "Its colour takes the place of the light's",
        subtype="FILE_PATH",
        options={"PATH_SUPPORTS_BLEND_RELATIVE"},
        update=tag_data,
    )
    opening: EnumProperty(name="Opening", description="What of the luminaire shines", items=OPENINGS, default="FILE", update=tag_data)
    rotation: FloatProperty(
        name="C0",
        description="Turns the luminaire about its vertical axis, C0 towards C90",
        default=0.0,
        min=radians(-360.0),
        max=radians(360.0),
        subtype="ANGLE",
        update=tag_data,
    )
    lamp_set: IntProperty(
        name="Lamp Set", description="Which of the file's alternative lamps are in the luminaire", default=1, min=1, update=tag_data
    )
    tilt: FloatProperty(
        name="Tilt",
        description="How far the luminaire hangs aslant, for files that state their lamp's flux by it",
        default=0.0,
        min=radians(-180.0),
        max=radians(180.0),
        subtype="ANGLE",
        update=tag_data,
    )
    cosine_power: FloatProperty(
        name="Cosine Power",
        description="Exponent n of an intensity I = I0 cos^n to the front alone; 0 leaves the light as it is",
        default=0.0,
        min=0.0,
        max=1000.0,
        soft_max=50.0,
        update=tag_data,
    )
    is_tube: switch("Tube", "The area light is a tube along its X axis, as thick as its Y", tag_data)
    dimming: _factor("Dimming", "Share of its full strength that the light is dimmed to")
    maintenance: _factor("Maintenance", "Share of the strength that is left between cleanings and replacements (CIE 97)")

# SPDX-License-Identifier: GPL-3.0-or-later
"""What buttons do."""

import bpy

from .. import measuring
from ..baking import wanted
from . import presets
from .annual_daylight import GONIO_OT_annual_daylight
from .bake_illuminance import GONIO_OT_bake_illuminance
from .dim_lights import GONIO_OT_dim_lights
from .expose_for_daylight import GONIO_OT_expose_for_daylight
from .from_cycles import GONIO_OT_settings_from_cycles
from .hang_luminaire import GONIO_FH_luminaire, GONIO_OT_hang_luminaire
from .illumination_map import GONIO_OT_illumination_map
from .measure_grids import GONIO_OT_measure_grids
from .measure_luminaire import GONIO_OT_measure_luminaire
from .point_meter import GONIO_OT_point_meter
from .render_by_wavelength import GONIO_OT_render_by_wavelength
from .report import GONIO_OT_report_copy, GONIO_OT_report_jump
from .standard_view import GONIO_OT_use_standard_view

CLASSES = (
    *presets.CLASSES,
    GONIO_OT_settings_from_cycles,
    GONIO_OT_use_standard_view,
    GONIO_OT_annual_daylight,
    GONIO_OT_bake_illuminance,
    GONIO_OT_dim_lights,
    GONIO_OT_expose_for_daylight,
    GONIO_OT_hang_luminaire,
    GONIO_FH_luminaire,
    GONIO_OT_illumination_map,
    GONIO_OT_measure_grids,
    GONIO_OT_measure_luminaire,
    GONIO_OT_point_meter,
    GONIO_OT_render_by_wavelength,
    GONIO_OT_report_jump,
    GONIO_OT_report_copy,
)


def register() -> None:
    for kind in CLASSES:
        bpy.utils.register_class(kind)
    measuring.register()
    wanted.register()


def unregister() -> None:
    wanted.unregister()
    measuring.unregister()
    for kind in reversed(CLASSES):
        bpy.utils.unregister_class(kind)

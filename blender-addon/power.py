# SPDX-License-Identifier: GPL-3.0-or-later
"""A lamp's power in watts as the photometric quantity with which it shines as brightly."""

from math import cos, pi, sin

import gonio
import numpy as np

from .export.images import Images
from .export.lights import parts_of
from .export.slots import Slots
from .report import Report
from .units import LUMENS_PER_WATT

# Luminance of linear Rec.709.
LUMINANCE = (0.2126, 0.7152, 0.0722)


def as_quantity(light) -> tuple[str, float]:
    """A unit of `light.gonio`, and how much of it: lux of a sun, lumens of all others."""
    colour = parts_of(light, np.eye(4), Images(gonio.Scene(), Slots()), Report())[0].colour
    strength = float(np.dot(LUMINANCE, colour)) * light.energy * 2.0 ** getattr(light, "exposure", 0.0) * LUMENS_PER_WATT
    is_normalized = getattr(light, "normalize", True)
    if light.type == "SUN":
        spread = pi * sin(min(0.5 * light.angle, 0.5 * pi)) ** 2
        return "LUX", strength if is_normalized or spread == 0.0 else strength * spread
    if light.type == "AREA":
        return "LUMEN", strength if is_normalized else strength * _area(light)
    radius = light.shadow_soft_size
    flux = strength if is_normalized or radius <= 0.0 else strength * 4.0 * pi * radius * radius
    return "LUMEN", flux * (_share(light) if light.type == "SPOT" else 1.0)


def _area(light) -> float:
    height = light.size_y if light.shape in ("RECTANGLE", "ELLIPSE") else light.size
    return light.size * height * (0.25 * pi if light.shape in ("DISK", "ELLIPSE") else 1.0)


def _share(light) -> float:
    """How much of a point's light leaves a spot's cone: its smooth edge, in cosines, lets half through."""
    return 0.5 * (1.0 - cos(0.5 * light.spot_size)) * (1.0 - 0.5 * light.spot_blend)

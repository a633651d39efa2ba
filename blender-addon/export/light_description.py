# SPDX-License-Identifier: GPL-3.0-or-later
"""Descriptions of lights that have no place: domes and suns."""

import numpy as np

from .transforms import columns
from .visibility import RAYS


def at_infinity(name, shape, radiance, axes, *, texture=None, normalized=False, spectra=None):
    """A light with axes in the columns of a 3×3 matrix; radiance in cd/m², or `normalized` in lux; `spectra` are those of its colours."""
    matrix = np.eye(4)
    matrix[:3, :3] = axes
    return {
        "origin": {"name": name, "file": ""},
        "shape": shape,
        "emission": {"radiance": [float(x) for x in radiance], "normalized": normalized, "metres_per_unit": 1.0},
        "shaping": {"cone_angle_deg": None, "cone_softness": 0.0, "focus": 0.0, "focus_tint": [0.0, 0.0, 0.0]},
        "texture": texture,
        "colour_spectra": spectra,
        "transform": columns(matrix),
        "visibility": dict.fromkeys(RAYS, True),
        "casts_shadow": True,
        "spot": None,
        "spread_deg": 180.0,
        "portal": False,
    }

# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's Sky Texture: a picture of the sky, and in worlds the sun's disc as a light of its own."""

from dataclasses import dataclass
from math import asin, atan2, degrees, fmod, pi

import gonio
import numpy as np
from mathutils import Matrix

from .material.inputs import GENERATED, direction
from .material.textures import coordinates, equirectangular
from .material.registry import value_node
from .material.vectors import transform3d
from .sky_on_surface import formula, table

# Cycles' value for a cd/m² of Preetham's model, for Hošek and Wilkie's W/(m² sr), of which one has so many lumens.
PREETHAM_SCALE = 0.06 / 1000.0
HOSEK_WILKIE_SCALE = 2.0 * pi / 683.0
LUMENS = 1.0 / 683.0
# The models of atmospheres, how high one may stand in them, m, and the least diameter of the disc, radians.
MODELS = {"NISHITA": "single-scattering", "SINGLE_SCATTERING": "single-scattering", "MULTIPLE_SCATTERING": "multiple-scattering"}
HIGHEST = 59_999.0
LEAST_DISC = 0.0005
# Mean over the disc of Cycles' darkening towards its limb.
MEAN_LIMB = 0.8
# Cycles takes angles for the older models from directions that hardly leave the horizon.
ROWS = 512


@dataclass(frozen=True, slots=True)
class Picture:
    """A sky that was drawn: (rows, columns, 4), the top row first, the sun in the direction of +Y."""

    name: str
    pixels: np.ndarray
    # Irradiance by the sun's disc of a surface that faces it, W/m²; the disc's diameter and the sun's height, degrees.
    sun: tuple
    diameter: float
    elevation: float

    @property
    def size(self):
        """Columns and rows."""
        return self.pixels.shape[1], self.pixels.shape[0]


@value_node("ShaderNodeTexSky")
def sky_texture(t, node, context, output):
    """The node's value in worlds and on surfaces; on lamps its stand-in."""
    if not t.is_world and t.kind != "Material":
        return None
    towards = coordinates(t, node, context, lambda: direction(t) if t.is_world else t.primvar(GENERATED))
    if not t.is_world:
        return _on_surface(t, node, context, towards)
    picture, azimuth = _drawn(node)
    turned = transform3d(t, towards, Matrix.Rotation(azimuth, 4, "Z"))
    return t.sky(picture, turned, equirectangular(t, turned))


def _on_surface(t, node, context, towards):
    """The sky by its formula or its table."""
    kind = node.sky_type
    if kind in ("PREETHAM", "HOSEK_WILKIE"):
        model, scale, elevation, azimuth = _old(node, kind)
        return formula(t, towards, model, elevation, azimuth, scale, **_haze(node))
    elevation, azimuth = _sun_of(node)
    diameter = max(node.sun_size, LEAST_DISC)
    key = ("sky on surfaces", t.owner.original.session_uid, t.path(node, context))
    disc = (node.sun_intensity if node.sun_disc else 0.0, degrees(diameter))
    model = "nishita" if kind == "NISHITA" else MODELS[kind]
    return table(t, key, towards, model, elevation, azimuth, disc, **_air(node))


def _drawn(node):
    """The picture, and the sun's angle from +Y, clockwise seen from above, in radians."""
    kind = node.sky_type
    if kind in ("PREETHAM", "HOSEK_WILKIE"):
        model, scale, elevation, azimuth = _old(node, kind)
        image, _ = gonio.artist_sky(model, elevation, rows=ROWS, **_haze(node))
        pixels = np.array(image)
        pixels[..., :3] *= scale if kind == "PREETHAM" else LUMENS * scale
        return Picture(f"Sky {kind}", pixels, (0.0, 0.0, 0.0), 0.0, elevation), azimuth
    elevation, azimuth = _sun_of(node)
    diameter = degrees(node.sun_size)
    image, sun = gonio.artist_sky(MODELS[kind], elevation, diameter=diameter, rows=ROWS, **_air(node))
    pixels = np.array(image)
    if MODELS[kind] == "single-scattering":
        _fade_below(pixels)
    strength = node.sun_intensity * MEAN_LIMB if node.sun_disc else 0.0
    return Picture(f"Sky {kind}", pixels, tuple(strength * x for x in sun), diameter, elevation), azimuth


def _sun_of(node):
    """Height and azimuth of a sun whose angles may go round and round, in degrees and radians."""
    elevation, azimuth = fmod(node.sun_elevation, 2.0 * pi), node.sun_rotation
    elevation += 2.0 * pi if elevation < -pi else -2.0 * pi if elevation > pi else 0.0
    if abs(elevation) > 0.5 * pi:
        # Beyond the zenith it comes down on the other side.
        elevation, azimuth = (pi if elevation > 0.0 else -pi) - elevation, azimuth + pi
    return degrees(elevation), azimuth


def _air(node):
    """What the atmosphere is made of, and from how high it is seen."""
    dust = getattr(node, "aerosol_density", None)
    dust = node.dust_density if dust is None else dust
    return {"altitude": min(max(node.altitude, 0.0), HIGHEST), "air": node.air_density, "dust": dust, "ozone": node.ozone_density}


def _haze(node):
    """What the older models take the air for."""
    return {"turbidity": node.turbidity, "ground": node.ground_albedo}


def _old(node, kind):
    """An older model, the scale of its values, and where its sun stands."""
    x, y, z = node.sun_direction.normalized()
    elevation, azimuth = max(degrees(asin(max(-1.0, min(1.0, z)))), 0.0), atan2(x, y)
    model, scale = ("preetham", PREETHAM_SCALE) if kind == "PREETHAM" else ("hosek-wilkie", HOSEK_WILKIE_SCALE)
    return model, scale, elevation, azimuth


def _fade_below(pixels):
    """The sky of single scattering goes on for a while below the horizon."""
    rows = pixels.shape[0]
    up = np.cos(np.pi * (np.arange(rows // 2, rows) + 0.5) / rows)
    fade = np.maximum(1.0 + 2.5 * up, 0.0) ** 3
    pixels[rows // 2 :, :, :3] = pixels[rows // 2 - 1, :, :3][None] * fade[:, None, None]

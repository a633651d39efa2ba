# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's Sky Texture on surfaces: the models' formulas, or the table of an atmosphere, for any vector."""

from math import asin, cos, pi, radians, sin, tau

import gonio
import numpy as np

from .material.textures import look_up

# Below this sine of its height the older models' sky stays as it is.
HORIZON = 1e-3
# Of Cycles' darkening towards the disc's limb.
LIMB = 0.6
EARTH_RADIUS = 6_371_000.0
# Tristimulus values to linear Rec.709 as Cycles has them, before Blender 5.0 and since.
TO_RGB = (
    ((3.2404542, -1.5371385, -0.4985314), (-0.969266, 1.8760108, 0.041556), (0.0556434, -0.2040259, 1.0572252)),
    ((3.2409699, -1.5373832, -0.4986108), (-0.9692436, 1.8759675, 0.0415551), (0.0556301, -0.2039770, 1.0569715)),
)


def formula(t, towards, model, elevation, azimuth, scale, **amounts):
    """The sky of Preetham or of Hošek and Wilkie; the sun stands at an elevation in degrees and an angle from +Y, clockwise, in radians."""
    x, y, z = (towards.component(axis) for axis in range(3))
    up = z.clamp(-1.0, 1.0)
    flat = (1.0 - up * up).maximum(0.0).sqrt()
    sun_up, sun_flat = sin(radians(elevation)), cos(radians(elevation))
    along = (x * sin(azimuth) + y * cos(azimuth)) / (x * x + y * y).maximum(1e-20).sqrt()
    cosine = (flat * along * sun_flat + up * sun_up).clamp(-1.0, 1.0)
    angle, height = cosine.apply("ArcCosine"), up.maximum(HORIZON)
    shape = _perez if model == "preetham" else _hosek_wilkie
    parameters = gonio.sky_formula(model, elevation, **amounts)
    values = [shape(each, height, cosine, angle) * factor for each, factor in parameters]
    if model == "preetham":
        luminance, x, y = values
        values = [x / y * luminance, luminance, (1.0 - x - y) / y * luminance]
    return _rgb(t, [value * scale for value in values])


def _exp(value):
    return value.apply("Exponential")


def _perez(parameters, height, cosine, angle):
    a, b, c, d, e = parameters
    return (_exp(height**-1.0 * b) * a + 1.0) * (_exp(angle * d) * c + cosine * cosine * e + 1.0)


def _hosek_wilkie(parameters, height, cosine, angle):
    a, b, c, d, e, f, g, i, h = parameters
    square = cosine * cosine
    mie = (square + 1.0) / (cosine * (-2.0 * h) + (1.0 + h * h)) ** 1.5
    return (_exp((height + 0.01) ** -1.0 * b) * a + 1.0) * (_exp(angle * e) * d + square * f + mie * g + height.sqrt() * i + c)


def table(t, key, towards, model, elevation, azimuth, disc, **amounts):
    """The sky of an atmosphere; `disc` is the strength of the sun's disc and its diameter in degrees."""
    strength, diameter = disc
    image, limbs = gonio.sky_table(model, elevation, diameter=diameter, **amounts)
    pixels = np.array(image)
    x, y, z = (towards.component(axis) for axis in range(3))
    height = 0.5 * pi - z.clamp(-1.0, 1.0).apply("ArcCosine")
    is_old = model == "nishita"
    across = ((-y.apply("ArcTangent2", x) - (0.5 * pi + azimuth)) * (1.0 / tau)).fraction()
    shown = height.maximum(0.0) if is_old else height
    along = (abs(shown) * (2.0 / pi)).sqrt() * shown.sign() * 0.5 + 0.5
    number = t.images.changing(key, f"Sky {model}", pixels)
    xyz = _between_texels(t, number, pixels.shape[1::-1], across, along)
    values = [xyz.component(i) for i in range(3)]
    if is_old:
        fade = (z.minimum(0.0) * 2.5 + 1.0).maximum(0.0)
        values = [value * (fade * fade * fade) for value in values]
    if strength > 0.0:
        horizon = 0.0 if is_old else -(0.5 * pi - asin(EARTH_RADIUS / (EARTH_RADIUS + amounts["altitude"])))
        seen, limb = _disc(t, towards, height, elevation, azimuth, diameter, horizon)
        foot = 0.0 if is_old and elevation <= 0.5 * diameter else radians(elevation - 0.5 * diameter)
        rise = (height - foot) * (1.0 / (radians(elevation + 0.5 * diameter) - foot))
        scale = strength / (tau * (1.0 - cos(radians(0.5 * diameter))))
        for i, (low, high) in enumerate(zip(*limbs, strict=True)):
            # Blender 4 shows the disc in the place of the sky.
            sky = values[i] * (1.0 - seen) if is_old else values[i]
            values[i] = sky + t.graph.scalar(low).mix(t.graph.scalar(high), rise) * seen * limb * scale
    return _rgb(t, values)


def _between_texels(t, number, size, across, along):
    """Linear between the four texels around a place, without smaller copies of the picture."""
    places = [value * count - 0.5 for value, count in zip((across, along), size, strict=True)]
    whole = [place.floor() for place in places]
    u, v = (place - below for place, below in zip(places, whole, strict=True))

    def texel(right, up):
        middles = [(below + (step + 0.5)) * (1.0 / count) for below, step, count in zip(whole, (right, up), size, strict=True)]
        return look_up(t, number, t.graph.combine(*middles, t.graph.scalar(0.0)), ("Clamp", "Clamp"), "Closest")

    low, high = (texel(0, up).mix(texel(1, up), u) for up in (0, 1))
    return low.mix(high, v)


def _disc(t, towards, height, elevation, azimuth, diameter, horizon):
    """Whether the disc is seen, not beside it and not below the horizon, and what its limb leaves of it."""
    up, flat, half = sin(radians(elevation)), cos(radians(elevation)), radians(0.5 * diameter)
    sun = t.graph.vector((flat * sin(azimuth), flat * cos(azimuth), up))
    angle = (towards - sun).length().apply("ArcTangent2", (towards + sun).length()) * 2.0
    share = angle * (1.0 / half)
    limb = (1.0 - share * share).maximum(0.0).sqrt() * LIMB + (1.0 - LIMB)
    return angle.less(half) * (1.0 - height.less(horizon)), limb


def _rgb(t, xyz):
    rows = TO_RGB[t.version >= (5, 0, 0)]
    sums = [(xyz[0] * a + xyz[1] * b + xyz[2] * c).maximum(0.0) for a, b, c in rows]
    return t.graph.combine(*sums, kind="RGBA")

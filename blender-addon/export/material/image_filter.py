# SPDX-License-Identifier: GPL-3.0-or-later
"""Texels beyond the plain look-up: the cubic filter out of linear ones, and alpha multiplied in before colours are decoded."""

# sRGB's curve: where its two parts meet, encoded and linear.
ENCODED_KNEE, LINEAR_KNEE = 0.04045, 0.0031308

# So much below a whole number a product of bytes counts as that number.
ROUNDING = 1e-3


def cubic(t, size, uv, look_up):
    """The cubic B-spline over a picture of so many texels, from four linear look-ups: each gives two texels a side by their weights' share."""
    parts = [_axis(uv.component(axis), float(size[axis])) for axis in (0, 1)]
    total = None
    for place_v, weight_v in parts[1]:
        for place_u, weight_u in parts[0]:
            texel = look_up(t.graph.combine(place_u, place_v, t.graph.scalar(0.0))) * (weight_u * weight_v)
            total = texel if total is None else total + texel
    return total


def _axis(place, count):
    """Two coordinates and their weights, for the texels before and behind a place."""
    at = place * count - 0.5
    first = at.floor()
    x = at - first
    rest = 1.0 - x
    outer, last = rest * rest * rest * (1.0 / 6.0), x * x * x * (1.0 / 6.0)
    near = x * x * (x * 0.5 - 1.0) + 2.0 / 3.0
    low = outer + near
    high = 1.0 - low
    return [((first - 0.5 + near / low) * (1.0 / count), low), ((first + 1.5 + last / high) * (1.0 / count), high)]


def multiplied_encoded(t, texel, is_one):
    """A colour times alpha as Cycles has it of bytes of sRGB: the encoded values are multiplied, and then decoded; where the colour is that
    of one texel, the product is a whole byte again."""
    alpha = texel.component(3)
    encoded = _encoded(texel) * alpha
    if is_one:
        encoded = (encoded * 255.0 + ROUNDING).floor() * (1.0 / 255.0)
    return t.graph.combine(*(_decoded(encoded).component(axis) for axis in range(3)), "RGBA", alpha)


def _encoded(colour):
    curved = colour.maximum(0.0) ** (1.0 / 2.4) * 1.055 - 0.055
    return curved.mix(colour * 12.92, colour.less(LINEAR_KNEE))


def _decoded(colour):
    curved = ((colour.maximum(0.0) + 0.055) * (1.0 / 1.055)) ** 2.4
    return curved.mix(colour * (1.0 / 12.92), colour.less(ENCODED_KNEE))

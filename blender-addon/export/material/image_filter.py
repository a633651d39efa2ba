# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours of sRGB's bytes times alpha, where what was filtered is no product already."""

# sRGB's curve: where its two parts meet, encoded and linear.
ENCODED_KNEE, LINEAR_KNEE = 0.04045, 0.0031308

# So much below a whole number a product of bytes counts as that number.
ROUNDING = 1e-3


def multiplied_encoded(t, texel, is_one):
    """A colour times alpha as Cycles has it of bytes of sRGB: the encoded values are multiplied, and then decoded; where the colour is that
    of one texel, the product is a whole byte again."""
    alpha = texel.component(3)
    encoded = _encoded(texel) * alpha
    if is_one:
        encoded = (encoded * 255.0 + ROUNDING).floor() * (1.0 / 255.0)
    linear = _decoded(encoded)
    return t.graph.combine(*(linear.component(axis) for axis in range(3)), "RGBA", alpha)


def _encoded(colour):
    curved = colour.maximum(0.0) ** (1.0 / 2.4) * 1.055 - 0.055
    return curved.mix(colour * 12.92, colour.less(LINEAR_KNEE))


def _decoded(colour):
    curved = ((colour.maximum(0.0) + 0.055) * (1.0 / 1.055)) ** 2.4
    return curved.mix(colour * (1.0 / 12.92), colour.less(ENCODED_KNEE))

# SPDX-License-Identifier: GPL-3.0-or-later
"""Colours and alpha: products of sRGB's bytes, what is divided by alpha again, and what clipping leaves of an opaque picture."""

# sRGB's curve: where its two parts meet, encoded and linear.
ENCODED_KNEE, LINEAR_KNEE = 0.04045, 0.0031308

# So much below a whole number a product of bytes counts as that number.
ROUNDING = 1e-3
# Alpha below this is none.
NO_ALPHA = 1e-8


def multiplied_encoded(t, texel, is_one):
    """A colour times alpha as Cycles has it of bytes of sRGB: the encoded values are multiplied, and then decoded; where the colour is that
    of one texel, the product is a whole byte again."""
    alpha = texel.component(3)
    encoded = _encoded(texel) * alpha
    if is_one:
        encoded = (encoded * 255.0 + ROUNDING).floor() * (1.0 / 255.0)
    linear = decoded(encoded)
    return t.graph.combine(*(linear.component(axis) for axis in range(3)), "RGBA", alpha)


def divided(texel, is_encoded=False):
    """A product's colour without its alpha, as Cycles has it: of bytes the encoded values are divided; what has no alpha stays."""
    alpha = texel.component(3)
    by = alpha + alpha.less(NO_ALPHA)
    return decoded(_encoded(texel) / by) if is_encoded else texel / by


def clipped_alpha(t, uv, size, is_closest):
    """The alpha of an opaque picture of a size in texels that is clipped: 0 outside, fading over half a texel where texels are mixed."""
    shares = []
    for axis, texels in enumerate(size):
        inside = uv.component(axis)
        for edge in (inside, 1.0 - inside):
            shares.append(1.0 - edge.less(0.0) if is_closest else (edge * max(texels, 1) + 0.5).clamp())
    return shares[0] * shares[1] * shares[2] * shares[3]


def _encoded(colour):
    curved = colour.maximum(0.0) ** (1.0 / 2.4) * 1.055 - 0.055
    return curved.mix(colour * 12.92, colour.less(LINEAR_KNEE))


def decoded(colour):
    """Light of sRGB's codes, in every component."""
    curved = ((colour.maximum(0.0) + 0.055) * (1.0 / 1.055)) ** 2.4
    return curved.mix(colour * (1.0 / 12.92), colour.less(ENCODED_KNEE))

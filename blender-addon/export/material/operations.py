# SPDX-License-Identifier: GPL-3.0-or-later
"""What each graph operation computes, in numpy: used to fold constants and to bake worlds; every array ends in four components."""

import numpy as np

LUMINANCE = (0.2126, 0.7152, 0.0722)


def rgb_to_hsv(a):
    """Hue, saturation, value of the first three components; the fourth is kept."""
    r, g, b = a[..., 0], a[..., 1], a[..., 2]
    most, least = np.maximum(np.maximum(r, g), b), np.minimum(np.minimum(r, g), b)
    spread = most - least
    safe = np.where(spread == 0.0, 1.0, spread)
    hue = np.where(r == most, (g - b) / safe, np.where(g == most, 2.0 + (b - r) / safe, 4.0 + (r - g) / safe)) / 6.0
    hue = np.where(spread == 0.0, 0.0, hue - np.floor(hue))
    saturation = np.where(most == 0.0, 0.0, spread / np.where(most == 0.0, 1.0, most))
    return np.stack([hue, saturation, most, a[..., 3]], axis=-1)


def hsv_to_rgb(a):
    """The inverse of [rgb_to_hsv]."""
    h, s, v = a[..., :1], a[..., 1:2], a[..., 2:3]
    offset = np.array([0.0, 2.0 / 3.0, 1.0 / 3.0])
    turned = (h + offset) % 1.0
    pure = np.clip(np.abs(turned * 6.0 - 3.0) - 1.0, 0.0, 1.0)
    return np.concatenate([((pure - 1.0) * s + 1.0) * v, a[..., 3:]], axis=-1)


def fresnel(cosine, eta):
    """Reflectance of a smooth dielectric for unpolarised light; eta is the far side's index over the near side's."""
    c = np.abs(cosine)
    g = eta * eta - 1.0 + c * c
    root = np.sqrt(np.maximum(g, 0.0))
    a = (root - c) / np.where(root + c == 0.0, 1.0, root + c)
    b = (c * (root + c) - 1.0) / np.where(c * (root - c) + 1.0 == 0.0, 1.0, c * (root - c) + 1.0)
    return np.where(g > 0.0, 0.5 * a * a * (1.0 + b * b), 1.0)


def _power(a, b):
    positive = np.power(np.maximum(a, 0.0), b, where=a > 0.0, out=np.where(b == 0.0, 1.0, 0.0))
    return np.where(a < 0.0, 0.0, positive)


def _divide(a, b):
    return np.where(b == 0.0, 0.0, a / np.where(b == 0.0, 1.0, b))


def _splat(x):
    return np.repeat(x[..., None], 4, axis=-1)


def _dot(a, b):
    return _splat((a[..., :3] * b[..., :3]).sum(axis=-1))


def _cross(a, b):
    return np.concatenate([np.cross(a[..., :3], b[..., :3]), np.zeros_like(a[..., :1])], axis=-1)


def _normalize(a):
    length = np.sqrt((a[..., :3] ** 2).sum(axis=-1, keepdims=True))
    return np.concatenate([_divide(a[..., :3], np.broadcast_to(length, a[..., :3].shape)), np.zeros_like(length)], axis=-1)


def _combine(*parts):
    return np.stack([part[..., 0] for part in parts], axis=-1)


# Operations without fields, by the names of the scene description.
PLAIN = {
    "Add": lambda a, b: a + b,
    "Subtract": lambda a, b: a - b,
    "Multiply": lambda a, b: a * b,
    "Divide": _divide,
    "Mix": lambda a, b, t: a + (b - a) * t,
    "Power": _power,
    "Invert": lambda a, b: b - a,
    "Clamp": lambda a, low, high: np.minimum(np.maximum(a, low), high),
    "Combine": _combine,
    "Luminance": lambda a: _dot(a, np.array([*LUMINANCE, 0.0])),
    "Minimum": np.minimum,
    "Maximum": np.maximum,
    "Absolute": np.abs,
    "Sign": np.sign,
    "Floor": np.floor,
    "SquareRoot": lambda a: np.sqrt(np.maximum(a, 0.0)),
    "Exponential": lambda a: np.exp(np.minimum(a, 88.0)),
    "Logarithm": lambda a: np.log(np.where(a > 0.0, a, 1.0)),
    "Sine": np.sin,
    "Cosine": np.cos,
    "ArcSine": lambda a: np.arcsin(np.clip(a, -1.0, 1.0)),
    "ArcCosine": lambda a: np.arccos(np.clip(a, -1.0, 1.0)),
    "ArcTangent2": np.arctan2,
    "Less": lambda a, b: (a < b).astype(a.dtype),
    "Dot": _dot,
    "Cross": _cross,
    "Normalize": _normalize,
    "RgbToHsv": rgb_to_hsv,
    "HsvToRgb": hsv_to_rgb,
    "Fresnel": fresnel,
}


def curve(fields, a):
    """Each component looked up in its own column of a table over [range], linear between entries (else the lower one); beyond the
    ends it is held, or goes on along the last two entries."""
    table = np.asarray(fields["table"], dtype=float)
    low, high = fields["range"]
    at = np.clip((a - low) / (high - low), 0.0, 1.0) * (len(table) - 1)
    first = np.clip(np.floor(at + (0.0 if fields["linear"] else 1e-5)).astype(int), 0, len(table) - 1)
    second = np.minimum(first + 1, len(table) - 1)
    share = at - first if fields["linear"] else np.zeros_like(at)
    column = np.arange(4)
    value = table[first, column] * (1.0 - share) + table[second, column] * share
    if not fields["extrapolate"]:
        return value
    step = (high - low) / (len(table) - 1)
    below, above = np.minimum(a - low, 0.0), np.maximum(a - high, 0.0)
    return value + below * (table[1] - table[0]) / step + above * (table[-1] - table[-2]) / step


def transform3d(fields, a):
    """Three rows of four applied to a point."""
    rows = np.asarray(fields["rows"], dtype=float)
    moved = a[..., :3] @ rows[:, :3].T + rows[:, 3]
    return np.concatenate([moved, a[..., 3:]], axis=-1)


FIELDED = {"Curve": curve, "Transform3d": transform3d}


def compute(operation, inputs):
    """The value of an operation for arrays of inputs, or None where it depends on the hit."""
    inputs = np.broadcast_arrays(*inputs) if len(inputs) > 1 else inputs
    if isinstance(operation, str):
        function = PLAIN.get(operation)
        return None if function is None else function(*inputs)
    ((name, fields),) = operation.items()
    function = FIELDED.get(name)
    return None if function is None else function(fields, *inputs)

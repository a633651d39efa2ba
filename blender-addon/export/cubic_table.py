# SPDX-License-Identifier: GPL-3.0-or-later
"""Intensities between the angles of a luminaire's file, by cubic curves, the way Cycles shows them in pictures."""

import numpy as np

from .material.textures import look_up

# Steps in degrees that angles of a file may be whole multiples of, and how far off they may be.
STEPS = (5.0, 2.5, 1.0, 0.5, 0.25, 0.1, 0.05)
NEARLY = 1e-3
# The nadir, to this part of a degree.
CLOSED = 1e-4


def cubic_table(t, key, name, table, at):
    """The value at two angles in degrees of a table of planes, angles and values (planes, angles); zero beyond its ends."""
    planes, angles, values = table
    # Before Blender 5.0 what lies beyond an end counts as dark.
    beyond = 1.0 if t.version >= (5, 0, 0) else 0.0
    texels = _columns(_quads(values, angles, beyond), beyond)
    number = t.images.changing(key, name, np.ascontiguousarray(texels.transpose(1, 0, 2)[::-1]))
    width, height = texels.shape[:2]
    (column, across), (row, along) = (_place(t, knots, angle) for knots, angle in zip((planes, angles), at, strict=True))
    total = None
    for offset, share in enumerate(_weights(across)):
        place = t.graph.combine((column + (offset + 0.5)) * (1.0 / width), (row + 0.5) * (1.0 / height), t.graph.scalar(0.0))
        texel = look_up(t, number, place, ("Clamp", "Clamp"), "Closest")
        parts = [texel.component(i) * weight for i, weight in enumerate(_weights(along))]
        value = (parts[0] + parts[1] + parts[2] + parts[3]) * share
        total = value if total is None else total + value
    return total.maximum(0.0) * _within(t, planes, at[0]) * _within(t, angles, at[1])


def _quads(values, angles, beyond):
    """Of each angle the values at those before, at and two after it, in four channels; light is alike on both sides of the nadir."""
    before = values[:, 1] if angles[0] < CLOSED else beyond * values[:, 0]
    wide = np.concatenate([before[:, None], values, beyond * values[:, -1:]], axis=1)
    return np.stack([wide[:, i : i + values.shape[1] - 1] for i in range(4)], axis=-1)


def _columns(quads, beyond):
    """The same with a plane more at each end; not those of the next turn, for Cycles takes a whole turn to fall short of one by rounding."""
    return np.concatenate([beyond * quads[:1], quads, beyond * quads[-2:-1]]).astype(np.float32)


def _place(t, knots, angle):
    """The number of the knot below an angle, and the way to the next."""
    step = next((each for each in STEPS if np.allclose(knots / each, np.round(knots / each), atol=NEARLY)), STEPS[-1])
    grid = np.linspace(knots[0], knots[-1], round((knots[-1] - knots[0]) / step) + 1)
    table = [[float(x)] * 4 for x in np.interp(grid, knots, np.arange(len(knots)))]
    fields = {"table": table, "range": [float(knots[0]), float(knots[-1])], "linear": True, "extrapolate": False}
    place = t.graph.add({"Curve": fields}, angle, kind="VALUE")
    below = place.floor().minimum(len(knots) - 2.0)
    return below, place - below


def _weights(x):
    """Of four values for a place between the middle two, on a curve through them with the slopes of their neighbours."""
    square, cube = x * x, x * x * x
    return [
        square - (x + cube) * 0.5,
        cube * 1.5 - square * 2.5 + 1.0,
        square * 2.0 + (x - cube * 3.0) * 0.5,
        (cube - square) * 0.5,
    ]


def _within(t, knots, angle):
    """1 from the first knot on, below the last one."""
    return (1.0 - angle.less(float(knots[0]))) * angle.less(float(knots[-1]))

# SPDX-License-Identifier: GPL-3.0-or-later
"""What fills a closed mesh: even absorption, of Volume shaders that scatter and shine nowhere."""

from .sockets import THROUGH, follow

NOTHING = (0.0, 0.0, 0.0)
# More volume shaders than these in one tree are not followed.
MOST = 256


class Uneven(Exception):
    """What is more than even absorption."""


def absorption(t, socket, context):
    """Absorption a metre of what reaches a Volume socket; None where that is more than even absorption."""
    try:
        return _sum(t, socket, context, [0])
    except Uneven:
        return None


def _sum(t, socket, context, seen):
    seen[0] += 1
    if seen[0] > MOST:
        raise Uneven
    found = follow(socket, context)
    if found is None or found.node is None or found.node.bl_idname in THROUGH:
        return NOTHING
    node, _, context, _ = found
    if node.bl_idname not in KINDS:
        raise Uneven
    t.saw(node, context)
    return KINDS[node.bl_idname](t, node, context, seen)


def _even(t, node, context, name):
    """A constant input, as three numbers."""
    value = t.input(node, name, context)
    if not value.is_constant:
        raise Uneven
    return tuple(value.as_kind("RGBA").constant[:3])


def _absorption(t, node, context, seen):
    colour, density = _even(t, node, context, "Color"), max(_even(t, node, context, "Density")[0], 0.0)
    return tuple(max(1.0 - each, 0.0) * density for each in colour)


def _coefficients(t, node, context, seen):
    if any(any(_even(t, node, context, f"{name} Coefficients")) for name in ("Scatter", "Emission")):
        raise Uneven
    return tuple(max(each, 0.0) for each in _even(t, node, context, "Absorption Coefficients"))


def _added(t, node, context, seen):
    first, second = (_sum(t, node.inputs[number], context, seen) for number in (0, 1))
    return tuple(a + b for a, b in zip(first, second, strict=True))


def _mixed(t, node, context, seen):
    share = min(max(_even(t, node, context, "Fac")[0], 0.0), 1.0)
    first, second = (_sum(t, node.inputs[number], context, seen) for number in (1, 2))
    return tuple(a + (b - a) * share for a, b in zip(first, second, strict=True))


KINDS = {
    "ShaderNodeVolumeAbsorption": _absorption,
    "ShaderNodeVolumeCoefficients": _coefficients,
    "ShaderNodeAddShader": _added,
    "ShaderNodeMixShader": _mixed,
}

# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume shaders as coefficients: what fills a closed mesh, the world, or a volume with grids."""

from dataclasses import dataclass, replace
from math import pi

from gonio.graph import Value

from ...units import LUMENS_PER_WATT
from .inputs import FACTOR
from .phases import Phase, described, henyey_greenstein, of_node
from .sockets import THROUGH, follow, input_socket

# More volume shaders than these in one tree are not followed.
MOST = 256
# Stefan and Boltzmann's constant in Cycles' units of radiance: a millionth of its radiant exitance over the half-space.
RADIANCE_PER_T4 = 5.670373e-8 * 1e-6 / pi


class Unknown(Exception):
    """A shader that is no volume's."""


@dataclass(frozen=True)
class Medium:
    """Coefficients a metre, R, G, B, as values of a graph. `turned` is scattering times its mean cosine, all colours together; `phases` are the
    phase functions there are."""

    absorption: Value
    scattering: Value
    emission: Value
    turned: Value
    phases: frozenset = frozenset()

    @property
    def is_even(self):
        """Whether it is the same everywhere."""
        return self.absorption.is_constant and self.scattering.is_constant and self.emission.is_constant

    @property
    def is_plain(self):
        """Whether one phase function tells all."""
        return len(self.phases) <= 1

    @property
    def phase(self):
        """The phase function, where there is one alone."""
        return next(iter(self.phases)) if len(self.phases) == 1 else None

    def described(self):
        """An even one as a material and a scene take it; empty where light goes through as if nothing were there."""
        parts = {name: [float(x) for x in getattr(self, name).constant[:3]] for name in ("absorption", "scattering", "emission")}
        if not any(any(part) for part in parts.values()):
            return {}
        return {**parts, **described(self.phase, anisotropy(parts["scattering"], self.turned.constant[0]))}

    def scaled(self, share):
        """So much of it."""
        part = {name: getattr(self, name) * share for name in ("absorption", "scattering", "emission", "turned")}
        return replace(self, **part)

    def plus(self, other):
        """Both together."""
        sums = {name: getattr(self, name) + getattr(other, name) for name in ("absorption", "scattering", "emission", "turned")}
        return Medium(**sums, phases=self.phases | other.phases)


def anisotropy(scattering, turned):
    """The mean cosine of all that is scattered."""
    whole = sum(scattering)
    return float(turned / whole) if whole > 0.0 else 0.0


def medium(t, socket, context):
    """The medium that reaches a Volume socket; None where it is none that is known."""
    try:
        return _sum(t, socket, context, [0])
    except Unknown:
        return None


def usual(t):
    """What Cycles fills a volume object without a material with: Principled Volume as it is made."""
    density = t.primvar(FACTOR + "density", (1.0,) * 4, kind="VALUE").maximum(0.0)
    grey = t.graph.colour((0.5, 0.5, 0.5)) * density
    return _scattered(t, grey, Phase(), absorption=grey)


def _sum(t, socket, context, seen):
    seen[0] += 1
    if seen[0] > MOST:
        raise Unknown
    found = follow(socket, context)
    if found is None or found.node is None or found.node.bl_idname in THROUGH:
        return _medium(t)
    node, _, context, _ = found
    if node.bl_idname not in KINDS:
        raise Unknown
    t.saw(node, context)
    return KINDS[node.bl_idname](t, node, context, seen)


def _medium(t, absorption=None, scattering=None, emission=None, turned=None, phases=frozenset()):
    black = t.graph.colour((0.0, 0.0, 0.0))
    return Medium(absorption or black, scattering or black, emission or black, turned or t.graph.scalar(0.0), phases)


def _colour(t, node, context, name, default=0.0):
    return t.input(node, name, context, default).as_kind("RGBA")


def _above(value):
    return value.maximum(0.0)


def _density(t, node, context):
    return _above(t.input(node, "Density", context))


def _number(t, node, context, name, default=0.0):
    """An input that has to be the same everywhere; the value of its socket where it is not."""
    value = t.input(node, name, context, default)
    if value.is_constant:
        return value.constant[0]
    t.tell("varying phase", node, context, f"{name} that varies")
    return input_socket(node, name).default_value


def _scattered(t, scattering, phase, absorption=None, emission=None):
    """A medium that scatters by this phase function."""
    if scattering.is_zero():
        return _medium(t, absorption, scattering, emission)
    turned = scattering.dot((1.0, 1.0, 1.0)) * phase.mean_cosine
    return _medium(t, absorption, scattering, emission, turned, frozenset({phase}))


def _by_phase(t, node, context, scattering, absorption=None, emission=None):
    """A medium that scatters as a node says."""
    phase = of_node(getattr(node, "phase", "HENYEY_GREENSTEIN"), lambda name: _number(t, node, context, name))
    return _scattered(t, scattering, phase, absorption, emission)


def _absorption(t, node, context, seen):
    return _medium(t, absorption=_above(1.0 - _colour(t, node, context, "Color")) * _density(t, node, context))


def _scatter(t, node, context, seen):
    return _by_phase(t, node, context, _above(_colour(t, node, context, "Color")) * _density(t, node, context))


def _coefficients(t, node, context, seen):
    absorption, scattering, emission = (
        _above(_colour(t, node, context, f"{name} Coefficients")) for name in ("Absorption", "Scatter", "Emission")
    )
    return _by_phase(t, node, context, scattering, absorption, emission * LUMENS_PER_WATT)


def _principled(t, node, context, seen):
    """Volumes have grids of density, colour and temperature, which count as 1 where there are none of the name, and in meshes."""
    density = _density(t, node, context) * _above(_grid(t, node, context, "Density Attribute"))
    colour = _above(_colour(t, node, context, "Color") * _grid(t, node, context, "Color Attribute", "RGBA"))
    absorbed = _above(_colour(t, node, context, "Absorption Color")).sqrt()
    absorption = _above(1.0 - colour) * _above(1.0 - absorbed) * density
    emission = _colour(t, node, context, "Emission Color") * t.input(node, "Emission Strength", context)
    intensity = t.input(node, "Blackbody Intensity", context)
    if not (intensity.is_constant and intensity.constant[0] <= 0.0):
        emission = emission + _fire(t, node, context, intensity)
    phase = henyey_greenstein(_number(t, node, context, "Anisotropy"))
    return _scattered(t, colour * density, phase, absorption, emission * LUMENS_PER_WATT)


def _fire(t, node, context, intensity):
    """What a blackbody sends, in Cycles' units of radiance."""
    temperature = _above(t.input(node, "Temperature", context)) * _above(_grid(t, node, context, "Temperature Attribute"))
    square = temperature * temperature
    glow = (1.0 + (square * square - 1.0) * intensity) * RADIANCE_PER_T4
    hue = t.graph.add("Blackbody", temperature, kind="RGBA")
    return hue * glow * _colour(t, node, context, "Blackbody Tint", 1.0)


def _grid(t, node, context, socket, kind="VALUE"):
    """The grid that a node names, 1 where there is none."""
    found = follow(input_socket(node, socket), context) if t.has_grids else None
    name = found.output.default_value if found is not None and found.node is None else ""
    if not name:
        return t.graph.scalar(1.0)
    return t.primvar(FACTOR + name if kind == "VALUE" else name, (1.0,) * 4, kind=kind)


def _emission(t, node, context, seen):
    strength = t.input(node, "Strength", context)
    return _medium(t, emission=_above(_colour(t, node, context, "Color") * strength) * LUMENS_PER_WATT)


def _added(t, node, context, seen):
    first, second = (_sum(t, node.inputs[number], context, seen) for number in (0, 1))
    return first.plus(second)


def _mixed(t, node, context, seen):
    share = t.input(node, "Fac", context).clamp(0.0, 1.0)
    first, second = (_sum(t, node.inputs[number], context, seen) for number in (1, 2))
    return first.scaled(1.0 - share).plus(second.scaled(share))


KINDS = {
    "ShaderNodeVolumeAbsorption": _absorption,
    "ShaderNodeVolumeScatter": _scatter,
    "ShaderNodeVolumeCoefficients": _coefficients,
    "ShaderNodeVolumePrincipled": _principled,
    "ShaderNodeEmission": _emission,
    "ShaderNodeAddShader": _added,
    "ShaderNodeMixShader": _mixed,
}

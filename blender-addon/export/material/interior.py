# SPDX-License-Identifier: GPL-3.0-or-later
"""Volume shaders as an even medium: what fills a closed mesh, or the world."""

from dataclasses import dataclass
from math import pi

from ...units import LUMENS_PER_WATT
from .phases import mean_cosine
from .sockets import THROUGH, follow

# More volume shaders than these in one tree are not followed.
MOST = 256
# Stefan and Boltzmann's constant in Cycles' units of radiance: a millionth of its radiant exitance over the half-space.
RADIANCE_PER_T4 = 5.670373e-8 * 1e-6 / pi


class Uneven(Exception):
    """What is more than an even medium."""


@dataclass(frozen=True)
class Medium:
    """Coefficients a metre, R, G, B. `turned` is scattering times its mean cosine; `exact` says whether that tells all of the phase function."""

    absorption: tuple = (0.0,) * 3
    scattering: tuple = (0.0,) * 3
    emission: tuple = (0.0,) * 3
    turned: float = 0.0
    exact: bool = True

    def described(self):
        """As a material and a scene take it; empty where light goes through as if nothing were there."""
        parts = {name: list(getattr(self, name)) for name in ("absorption", "scattering", "emission")}
        if not any(any(part) for part in parts.values()):
            return {}
        return {**parts, "anisotropy": self.anisotropy}

    @property
    def anisotropy(self):
        """The mean cosine of all that it scatters."""
        whole = sum(self.scattering)
        return self.turned / whole if whole > 0.0 else 0.0

    def scaled(self, share):
        """So much of it."""
        part = {name: tuple(each * share for each in getattr(self, name)) for name in ("absorption", "scattering", "emission")}
        return Medium(**part, turned=self.turned * share, exact=self.exact)

    def plus(self, other):
        """Both together; exact where both scatter alike, or one of them not at all."""
        sums = {
            name: tuple(a + b for a, b in zip(getattr(self, name), getattr(other, name), strict=True))
            for name in ("absorption", "scattering", "emission")
        }
        alike = not any(self.scattering) or not any(other.scattering) or abs(self.anisotropy - other.anisotropy) < 1e-6
        return Medium(**sums, turned=self.turned + other.turned, exact=self.exact and other.exact and alike)


def medium(t, socket, context):
    """The medium that reaches a Volume socket; None where it varies from place to place."""
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
        return Medium()
    node, _, context, _ = found
    if node.bl_idname not in KINDS:
        raise Uneven
    t.saw(node, context)
    return KINDS[node.bl_idname](t, node, context, seen)


def _even(t, node, context, name, default=0.0):
    """A constant input, as three numbers."""
    value = t.input(node, name, context, default)
    if not value.is_constant:
        raise Uneven
    return tuple(value.as_kind("RGBA").constant[:3])


def _number(t, node, context, name, default=0.0):
    return _even(t, node, context, name, default)[0]


def _scattered(t, node, context, scattering, absorption=(0.0,) * 3, emission=(0.0,) * 3):
    """A medium that scatters as a node says."""
    cosine, exact = mean_cosine(getattr(node, "phase", "HENYEY_GREENSTEIN"), lambda name: _number(t, node, context, name))
    return Medium(absorption, scattering, emission, sum(scattering) * cosine, exact or not any(scattering))


def _absorption(t, node, context, seen):
    colour, density = _even(t, node, context, "Color"), max(_number(t, node, context, "Density"), 0.0)
    return Medium(absorption=tuple(max(1.0 - each, 0.0) * density for each in colour))


def _scatter(t, node, context, seen):
    colour, density = _even(t, node, context, "Color"), max(_number(t, node, context, "Density"), 0.0)
    return _scattered(t, node, context, tuple(max(each, 0.0) * density for each in colour))


def _coefficients(t, node, context, seen):
    absorption, scattering, emission = (
        tuple(max(each, 0.0) for each in _even(t, node, context, f"{name} Coefficients")) for name in ("Absorption", "Scatter", "Emission")
    )
    return _scattered(t, node, context, scattering, absorption, tuple(each * LUMENS_PER_WATT for each in emission))


def _principled(t, node, context, seen):
    """Meshes have no grids of density, colour and temperature: these count as 1, but for attributes that a mesh may have."""
    density = max(_number(t, node, context, "Density"), 0.0)
    colour, absorbed = _even(t, node, context, "Color"), _even(t, node, context, "Absorption Color")
    scattering = tuple(max(each, 0.0) * density for each in colour)
    pairs = zip(colour, absorbed, strict=True)
    absorption = tuple(max(1.0 - each, 0.0) * max(1.0 - max(other, 0.0) ** 0.5, 0.0) * density for each, other in pairs)
    strength = _number(t, node, context, "Emission Strength")
    shining = [each * strength for each in _even(t, node, context, "Emission Color")]
    intensity = _number(t, node, context, "Blackbody Intensity")
    if intensity > 0.0:
        temperature = max(_number(t, node, context, "Temperature"), 0.0)
        glow = RADIANCE_PER_T4 * (1.0 + (temperature**4 - 1.0) * intensity)
        hue = t.graph.add("Blackbody", t.graph.scalar(temperature), kind="RGBA")
        if not hue.is_constant:
            raise Uneven
        tint = _even(t, node, context, "Blackbody Tint", 1.0)
        shining = [each + glow * a * b for each, a, b in zip(shining, tint, hue.constant[:3], strict=True)]
    emission = tuple(each * LUMENS_PER_WATT for each in shining)
    cosine = min(max(_number(t, node, context, "Anisotropy"), -1.0), 1.0)
    return Medium(absorption, scattering, emission, sum(scattering) * cosine)


def _emission(t, node, context, seen):
    strength = _number(t, node, context, "Strength")
    return Medium(emission=tuple(max(each * strength, 0.0) * LUMENS_PER_WATT for each in _even(t, node, context, "Color")))


def _added(t, node, context, seen):
    first, second = (_sum(t, node.inputs[number], context, seen) for number in (0, 1))
    return first.plus(second)


def _mixed(t, node, context, seen):
    share = min(max(_number(t, node, context, "Fac"), 0.0), 1.0)
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

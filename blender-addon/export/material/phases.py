# SPDX-License-Identifier: GPL-3.0-or-later
"""Phase functions of volume shaders, as media take them, and the mean cosines of the angles by which they scatter, for sums of several."""

from dataclasses import dataclass
from functools import lru_cache
from math import cos, exp, log, pi, sin, tan

# Steps of the integral over angles.
STEPS = 4096


@dataclass(frozen=True)
class Phase:
    """A phase function: its kind in a scene, Henyey and Greenstein's or Draine's g, and what other numbers it has."""

    kind: str = "HenyeyGreenstein"
    g: float = 0.0
    numbers: tuple = ()

    @property
    def mean_cosine(self):
        """That of the angle by which it scatters."""
        return MEANS[self.kind](self.g, **dict(self.numbers))


def of_node(phase, ask):
    """The phase function that a node names; `ask` gives the node's numbers."""
    if phase == "RAYLEIGH":
        return Phase("Rayleigh")
    if phase == "DRAINE":
        return Phase("Draine", _held(ask("Anisotropy")), (("alpha", _rounded(ask("Alpha"))),))
    if phase == "FOURNIER_FORAND":
        numbers = ("ior", max(_rounded(ask("IOR")), 1.001)), ("backscatter", min(abs(_rounded(ask("Backscatter"))), 0.499))
        return Phase("FournierForand", numbers=numbers)
    if phase == "MIE":
        return Phase("Mie", numbers=(("diameter", max(_rounded(ask("Diameter")), 0.0)),))
    return henyey_greenstein(ask("Anisotropy"))


def henyey_greenstein(g):
    """Henyey and Greenstein's function of a mean cosine."""
    return Phase(g=_held(g))


def described(phase, mean_cosine):
    """What a medium's description says of a phase function; of `None`, several together, Henyey and Greenstein's of their mean cosine."""
    if phase is None or phase.kind == "HenyeyGreenstein":
        return {"anisotropy": mean_cosine}
    return {"anisotropy": phase.g, "phase": {phase.kind: dict(phase.numbers)} if phase.numbers else phase.kind}


def _rounded(value):
    """Numbers of sockets that are told apart."""
    return round(value, 6)


def _held(g):
    return min(max(_rounded(g), -0.999), 0.999)


def _draine(g, alpha):
    """Draine, Scattering by Interstellar Dust Grains (2003), equation 7."""
    return g * (1.0 + alpha * (3.0 + 2.0 * g * g) / 5.0) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0)


def _mie(diameter):
    """Jendersie and d'Eon, An Approximate Mie Scattering Function for Fog and Cloud Rendering (2023), for droplets of so many micrometres."""
    g_hg, g_draine, alpha, weight = _fits(min(diameter, 50.0))
    return (1.0 - weight) * g_hg + weight * _draine(g_draine, alpha)


def _fits(d):
    if d <= 0.1:
        return 13.8 * d * d, 1.1456 * d * sin(9.29044 * d), 250.0, 0.252977 - 312.983 * d**4.3
    x = log(d)
    if d < 1.5:
        inner = cos((x - 0.238604) * (x + 1.00667) / (0.507522 - 0.15677 * x))
        g_draine = 0.379685 * cos(1.19692 * inner + 1.37932 * x + 0.0625835) + 0.344213
        return 0.862 - 0.143 * x * x, g_draine, 250.0, 0.146209 * cos(3.38707 * x + 2.11193) + 0.316072 + 0.0778917 * x
    if d < 5.0:
        g_draine = 0.500411 - 0.081287 / (-2.0 * x + tan(x) + 1.27551)
        weight = 0.026914 * (x - cos(5.68947 * (log(x) - 0.0292149))) + 0.376475
        return 0.0604931 * log(x) + 0.940256, g_draine, 7.30354 * x + 6.31675, weight
    return (
        exp(-0.0990567 / (d - 1.67154)),
        exp(-2.20679 / (d + 3.91029) - 0.428934),
        exp(3.62489 - 8.29288 / (d + 5.52825)),
        exp(-0.599085 / (d - 0.641583) - 0.665888),
    )


@lru_cache
def _fournier_forand(n, backscatter):
    """Fournier and Forand's function by the part that it scatters back, integrated over angles."""

    def delta(cosine):
        return 4.0 * (1.0 - cosine) / 2.0 / (3.0 * (n - 1.0) ** 2)

    at_90 = delta(0.0)
    v = -log(2.0 * backscatter * (at_90 - 1.0) + 1.0) / log(at_90)
    delta_180 = delta(-1.0)

    def value(cosine):
        d = delta(cosine)
        if abs(1.0 - d) < 1e-6:
            d += 1e-6
        power = d**v
        inner = v * (1.0 - d) - (1.0 - power) + (d * (1.0 - power) - v * (1.0 - d)) * 2.0 / (1.0 - cosine)
        back = (1.0 - delta_180**v) / (16.0 * pi * (delta_180 - 1.0) * delta_180**v) * (3.0 * cosine * cosine - 1.0)
        return inner / (4.0 * pi * (1.0 - d) ** 2 * power) + back

    # Finer steps near the forward peak.
    whole = turned = 0.0
    for step in range(STEPS):
        u = (step + 0.5) / STEPS
        cosine, width = 1.0 - 2.0 * u**4, 8.0 * u**3 / STEPS
        part = value(cosine) * width
        whole, turned = whole + part, turned + part * cosine
    return turned / whole


MEANS = {
    "HenyeyGreenstein": lambda g: g,
    "Rayleigh": lambda g: 0.0,
    "Draine": _draine,
    # The renderer holds what goes back at this part, and tells it.
    "FournierForand": lambda g, ior, backscatter: _fournier_forand(ior, max(backscatter, 0.005)),
    "Mie": lambda g, diameter: _mie(diameter),
}

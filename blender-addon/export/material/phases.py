# SPDX-License-Identifier: GPL-3.0-or-later
"""Phase functions of volume shaders, as the mean cosine of the angle by which they scatter: Henyey and Greenstein's function has the same."""

from math import exp, log, pi

# Steps of the integral over angles.
STEPS = 4096


def mean_cosine(phase, ask):
    """The mean cosine of a node's phase function, and whether Henyey and Greenstein's is that function; `ask` gives the node's numbers."""
    if phase == "RAYLEIGH":
        return 0.0, False
    if phase == "DRAINE":
        return _draine(_held(ask("Anisotropy")), ask("Alpha")), False
    if phase == "FOURNIER_FORAND":
        return _fournier_forand(max(ask("IOR"), 1.001), min(max(ask("Backscatter"), 0.0), 0.499)), False
    if phase == "MIE":
        return _mie(ask("Diameter")), False
    return _held(ask("Anisotropy")), True


def _held(g):
    return min(max(g, -0.999), 0.999)


def _draine(g, alpha):
    """Draine, Scattering by Interstellar Dust Grains (2003), equation 7."""
    return g * (1.0 + alpha * (3.0 + 2.0 * g * g) / 5.0) / (1.0 + alpha * (1.0 + 2.0 * g * g) / 3.0)


def _mie(diameter):
    """Jendersie and d'Eon, An Approximate Mie Scattering Function for Fog and Cloud Rendering (2023), for droplets of so many micrometres."""
    d = min(max(diameter, 5.0), 50.0)
    g_hg = exp(-0.0990567 / (d - 1.67154))
    g_draine = exp(-2.20679 / (d + 3.91029) - 0.428934)
    alpha = exp(3.62489 - 8.29288 / (d + 5.52825))
    weight = exp(-0.599085 / (d - 0.641583) - 0.665888)
    return (1.0 - weight) * g_hg + weight * _draine(g_draine, alpha)


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

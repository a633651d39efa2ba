"""Media: what fills meshes, or all of space."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

from .description import numbers

# A colour of one number is grey.
Coefficient = float | Sequence[float]


def _rgb(name: str, value: Coefficient) -> list[float]:
    return [float(value)] * 3 if isinstance(value, (int, float)) else numbers(name, value, 3)


# Phase functions by their names: how scenes name them, and their numbers.
_PHASES: dict[str, tuple[str, dict[str, float]]] = {
    "henyey_greenstein": ("HenyeyGreenstein", {}),
    "rayleigh": ("Rayleigh", {}),
    "draine": ("Draine", {"alpha": 1.0}),
    "fournier_forand": ("FournierForand", {"ior": 1.1, "backscatter": 0.018}),
    "mie": ("Mie", {"diameter": 20.0}),
}


def _phase(name: str, given: Mapping[str, float]) -> dict[str, Any]:
    """The phase function of a medium's description; nothing for the usual one."""
    if name not in _PHASES:
        raise ValueError(f"phase is {name!r}, expected one of {', '.join(_PHASES)}")
    kind, usual = _PHASES[name]
    for unknown in given.keys() - usual.keys():
        raise TypeError(f"{unknown} is no number of the phase function {name}, which has {', '.join(usual) or 'none'}")
    if not usual:
        return {} if kind == "HenyeyGreenstein" else {"phase": kind}
    return {"phase": {kind: {number: float(value) for number, value in {**usual, **given}.items()}}}


def medium(
    *,
    absorption: Coefficient = 0.0,
    scattering: Coefficient = 0.0,
    emission: Coefficient = 0.0,
    anisotropy: float = 0.0,
    phase: str = "henyey_greenstein",
    **numbers_of_phase: float,
) -> dict[str, Any]:
    """An even medium: `medium` of a material's description, or what `Scene.put_atmosphere` takes. absorption, scattering: a metre, a number or
    R, G, B; emission: cd/m² that a metre sends; anisotropy: mean cosine of the angle by which it scatters, from -0.999 back to 0.999 forwards.
    phase: the function of that angle, with its numbers: "henyey_greenstein" and "draine" (alpha) by the anisotropy, "rayleigh", "fournier_forand"
    (ior, backscatter: the part that goes back), "mie" (diameter: of droplets of water, micrometres).
    """
    parts = {"absorption": absorption, "scattering": scattering, "emission": emission}
    coefficients = {name: _rgb(name, value) for name, value in parts.items()}
    return {**coefficients, "anisotropy": float(anisotropy), **_phase(phase, numbers_of_phase)}


def haze(
    visibility: float,
    *,
    contrast: float = 0.05,
    albedo: Coefficient = 1.0,
    anisotropy: float = 0.8,
    phase: str = "henyey_greenstein",
    **numbers_of_phase: float,
) -> dict[str, Any]:
    """Haze or fog by how far one sees. visibility: metres at which a black thing before the sky keeps `contrast`; 0.05 is the meteorological optical
    range of CIE and WMO, 0.02 Koschmieder's visual range. albedo: part of the light it takes that is scattered; anisotropy, phase and its numbers: as
    of `medium`.
    """
    if not (math.isfinite(visibility) and visibility > 0.0):
        raise ValueError(f"visibility is {visibility}, expected metres above 0")
    if not 0.0 < contrast < 1.0:
        raise ValueError(f"contrast is {contrast}, expected a number between 0 and 1")
    extinction = -math.log(contrast) / visibility
    scattered = _rgb("albedo", albedo)
    if not all(0.0 <= each <= 1.0 for each in scattered):
        raise ValueError(f"albedo is {albedo}, expected numbers from 0 to 1")
    return medium(
        absorption=[extinction * (1.0 - each) for each in scattered],
        scattering=[extinction * each for each in scattered],
        anisotropy=anisotropy,
        phase=phase,
        **numbers_of_phase,
    )


def volume_material(name: str, inside: dict[str, Any]) -> dict[str, Any]:
    """The description of a material with nothing at its surface and a medium behind it."""
    white = {"Constant": [1.0, 1.0, 1.0, 1.0]}
    closure = {"weight": white, "model": "Transparent", "parameters": [["base_color", white]]}
    return {"origin": name, "closures": [closure], "medium": inside}


def of_voxels(to_world: dict[str, Any], edges: Sequence[float]) -> dict[str, Any]:
    """A map from an array's voxels, whose centres are whole numbers and which fill a box from 0 on, each of these edges."""
    *axes, origin = to_world["columns"]
    scaled = [[edge * part for part in axis] for axis, edge in zip(axes, edges, strict=True)]
    corner = [place + sum(axis[part] * 0.5 for axis in scaled) for part, place in enumerate(origin)]
    return {"columns": [*scaled, corner]}


def flow_of(density: Any, velocity: Any, shutter_s: float, edges: Sequence[float] | None) -> Any:
    """What `Scene.put_flow` takes of velocities, m/s: those of an array whose voxels have these edges, or the names of the grids of the density's file."""
    if edges is not None:
        return velocity, [shutter_s / edge for edge in edges]
    return density[0], [velocity] if isinstance(velocity, str) else [str(name) for name in velocity], float(shutter_s)

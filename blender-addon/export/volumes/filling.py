# SPDX-License-Identifier: GPL-3.0-or-later
"""A volume shader over grids, as what the renderer takes: coefficients times one grid, and emission by another through a table."""

from dataclasses import dataclass, field
from hashlib import blake2b

import numpy as np

from ..material.interior import anisotropy
from ..material.phases import Phase, described
from .asked import Asked
from .baked import MOST, bake

# Densities at which a shader is asked whether it is a multiple of them: from none to more than there ever is.
DENSITIES = np.concatenate([[0.0, 1.0], np.logspace(-4.0, 4.0, 62)])
# Factors of emission by heat.
FACTORS = 256


@dataclass
class Place:
    """Where a volume is placed: the matrix to the world, and what its object gives shaders."""

    matrix: np.ndarray
    values: dict

    def values_key(self):
        """What the object gives, to be compared."""
        return tuple((name, value.tobytes()) for name, value in sorted(self.values.items()))

    def density(self, data):
        """Densities of volume objects thin out as these grow, as a rule."""
        if getattr(getattr(data, "render", None), "space", "WORLD") == "WORLD":
            return 1.0
        return 1.0 / float(np.linalg.norm(self.matrix[:3, :3] @ np.full(3, 3.0**-0.5)))


@dataclass
class Filling:
    """What fills a volume: sources of the field, and coefficients a metre. `is_placed` says whether it is another elsewhere."""

    density: object
    to_object: np.ndarray
    absorption: np.ndarray
    scattering: np.ndarray
    anisotropy: float
    heat: object = None
    emission: np.ndarray = field(default_factory=lambda: np.zeros(3))
    glow: list = field(default_factory=list)
    hottest: float = 0.0
    # Where colours vary: factors on extinction and scattering, and on emission, by point.
    taken: np.ndarray | None = None
    sent: np.ndarray | None = None
    told: list = field(default_factory=list)
    is_placed: bool = False
    stamp: object = None
    # None where several are together, which scatter by their mean cosine.
    phase: Phase | None = None

    def __post_init__(self):
        digest = blake2b(repr((self.stamp, self.glow, self.hottest)).encode(), digest_size=16)
        for source in (self.density, self.heat, self.taken, self.sent):
            digest.update(source if isinstance(source, np.ndarray) else repr(source).encode())
        digest.update(self.to_object.tobytes())
        self.digest = digest.digest()

    def colours(self):
        """The arrays of colours that there are."""
        return {name: array for name in ("taken", "sent") if (array := getattr(self, name)) is not None}

    def medium(self, density):
        """The medium of a material, so many times as dense."""
        parts = {name: [float(x) * density for x in getattr(self, name)] for name in ("absorption", "scattering", "emission")}
        return {**parts, **described(self.phase, self.anisotropy)}


@dataclass
class Glow:
    """How emission follows heat: a colour, and factors on it from no heat to the greatest; none where it is a multiple of the heat."""

    emission: np.ndarray
    factors: list
    hottest: float


def fill(t, inside, grids, place):
    """What fills a volume of these grids at a place; None where it has no extent: as in Cycles, volume objects have that of the grids asked for."""
    dense = Asked(t, grids, place, (inside.absorption, inside.scattering, inside.turned))
    shining = Asked(t, grids, place, (inside.emission,))
    if not (dense.grids or shining.grids or grids.unasked):
        return None
    told = [("volume asks", ", ".join(sorted(dense.unknown | shining.unknown)))] if dense.unknown or shining.unknown else []
    try:
        filling = _simple(dense, shining, grids, told) or _baked(dense, shining, grids, told)
    finally:
        grids.forget_numbers()
    filling.phase = inside.phase
    return filling


def _simple(dense, shining, grids, told):
    """Where both are by one grid each, of the same voxels, and the first by its multiples; None where they are not."""
    if dense.places or shining.places or len(dense.grids) > 1 or len(shining.grids) > 1 or not (dense.grids or shining.grids):
        return None
    if not all(grids.is_scalar(name) for name in dense.grids | shining.grids):
        return None
    (unit,) = dense.at(np.ones(1))
    is_clear = not dense.grids and not unit[:6].any()
    if not is_clear and not (dense.grids and is_multiple(dense)):
        return None
    names = sorted(dense.grids) or sorted(shining.grids)
    if not all(grids.are_alike(names[0], name) for name in shining.grids):
        return None
    glow = glow_of(shining, max((grids.highest(name) for name in shining.grids), default=0.0))
    heat = grids.source(*shining.grids) if shining.grids and glow.emission.any() else None
    coefficients = {"absorption": unit[:3], "scattering": unit[3:6], "anisotropy": anisotropy(unit[3:6], unit[6])}
    shown = {"emission": glow.emission, "glow": glow.factors if heat is not None else [], "hottest": glow.hottest if heat is not None else 0.0}
    stamp = grids.stamp
    return Filling(grids.source(names[0]), grids.to_object(names[0]), **coefficients, heat=heat, **shown, told=told, stamp=stamp)


def is_multiple(dense):
    """Whether coefficients are multiples of the one grid that they ask for."""
    found = dense.at(DENSITIES)
    return bool(np.allclose(found, DENSITIES[:, None] * found[1], rtol=1e-4, atol=1e-7))


def glow_of(shining, highest):
    """The colour and the factors of what is sent by one grid, or evenly."""
    heats = np.linspace(0.0, max(highest, 0.0), FACTORS)
    sent = np.maximum(shining.at(heats if highest > 0.0 else np.zeros(1)), 0.0)
    if not shining.grids or highest <= 0.0:
        return Glow(sent[0], [], 0.0)
    multiple = np.maximum(shining.at(np.ones(1)), 0.0)[0]
    if np.allclose(sent, heats[:, None] * multiple, rtol=1e-4, atol=1e-9):
        return Glow(multiple, [], highest)
    most = sent.max()
    return Glow(np.full(3, most), (sent / most).tolist() if most > 0.0 else [], highest)


def _baked(dense, shining, grids, told):
    """Everything else, point by point where these are not too many; else by the plain grid."""
    lattice = lattice_of(dense.grids | shining.grids or grids.unasked, grids)
    if lattice is None:
        return _plain(dense, shining, grids, told)
    made = bake(dense, shining, lattice, grids)
    glow, heat = None, made.heat
    if len(shining.grids) == 1 and not shining.places and grids.is_scalar(*shining.grids):
        heat = np.ascontiguousarray(grids.dense(*shining.grids).on(lattice).values)
        glow = glow_of(shining, float(heat.max()))
    elif not shining.grids and not shining.places:
        heat, glow = None, glow_of(shining, 0.0)
    sent = made.sent if glow is None else None
    lost = (made.density_has_colours and made.taken is None) or (glow is None and made.heat_has_colours and sent is None)
    told = told + [("volume colours", "")] * lost
    glow = glow or Glow(made.emission, [], float(heat.max()))
    if sent is not None:
        heat, glow, sent = None, Glow(np.full(3, float(sent.max())), [], 0.0), sent / max(float(sent.max()), 1e-30)
    if not glow.emission.any():
        heat, glow = None, Glow(np.zeros(3), [], 0.0)
    coefficients = {"absorption": made.absorption, "scattering": made.scattering, "anisotropy": anisotropy(made.scattering, made.turned)}
    density, taken = made.density, None
    if made.taken is not None:
        density, taken, whole = _coloured(made.taken)
        coefficients.update(whole)
    shown = {"emission": glow.emission, "glow": glow.factors, "hottest": glow.hottest, "taken": taken, "sent": sent, "told": told}
    is_placed = bool((dense.places | shining.places) & {"Position"})
    return Filling(density, lattice.to_object, **coefficients, heat=heat, **shown, is_placed=is_placed)


def _coloured(taken):
    """A density, factors on extinction and scattering of each colour, and the coefficients that these multiply, of absorption and scattering by point."""
    scattering = taken[..., 3:]
    extinction = taken[..., :3] + scattering
    most = max(float(extinction.max()), 1e-30)
    whole, none = np.full(3, most), np.zeros(3)
    scatters = bool(scattering.any())
    coefficients = {"absorption": none if scatters else whole, "scattering": whole if scatters else none}
    factors = np.concatenate([extinction, scattering], axis=-1) / most
    return np.ascontiguousarray(factors[..., :3].max(axis=-1)), np.ascontiguousarray(factors), coefficients


def lattice_of(names, grids):
    """The points on which a shader is asked: those of the finest grid that it wants; None where they are too many."""
    counts = {name: grids.count(name) for name in names}
    return None if max(counts.values()) > MOST else grids.dense(max(counts, key=lambda name: (counts[name], name)))


def _plain(dense, shining, grids, told):
    """The density's own grid in the place of what is made of it."""
    names = sorted(dense.grids, key=lambda name: (not grids.is_scalar(name), name)) or sorted(shining.grids)
    (unit,) = dense.at(np.ones(1))
    coefficients = {"absorption": unit[:3], "scattering": unit[3:6], "anisotropy": anisotropy(unit[3:6], unit[6])}
    told = [*told, ("volume size", "")]
    return Filling(grids.source(names[0]), grids.to_object(names[0]), **coefficients, told=told, stamp=grids.stamp)



# SPDX-License-Identifier: GPL-3.0-or-later
"""A volume's shader asked at every point of a lattice."""

from dataclasses import dataclass

import numpy as np

from .lattice import AT_ONCE

# More points than these are not asked.
MOST = 1 << 25
# More points than these keep no colours: they are their mean.
COLOURED = 1 << 22
# How far colours may be from their mean before it is told, as one minus a squared correlation.
APART = 1e-3


@dataclass
class Baked:
    """Arrays of density and heat, which coefficients a metre multiply; whether these stand for others elsewhere."""

    density: np.ndarray
    heat: np.ndarray
    absorption: np.ndarray
    scattering: np.ndarray
    turned: float
    emission: np.ndarray
    density_has_colours: bool
    heat_has_colours: bool
    # Where colours vary: what is taken and scattered at each point, red, green and blue each, and what is sent; else None.
    taken: np.ndarray | None
    sent: np.ndarray | None


class _Sum:
    """One number a point for several, and the mean of what each is of it."""

    def __init__(self, count, width):
        self.whole, self._parts = np.zeros(count, dtype=np.float32), np.zeros(width)
        self._squares, self._with, self._whole = np.zeros(width), np.zeros(width), 0.0

    def add(self, rows, parts):
        whole = parts.sum(axis=1)
        self.whole[rows] = whole
        self._parts += parts.sum(axis=0)
        self._squares += (parts * parts).sum(axis=0)
        self._with += (parts * whole[:, None]).sum(axis=0)
        self._whole += float((whole * whole).sum())

    def of_one(self, total):
        """A total in relation to the whole."""
        whole = float(self._parts.sum())
        return total / whole if whole > 0.0 else total * 0.0

    def shares(self):
        """What each is of the whole, in the mean."""
        return self.of_one(self._parts)

    def are_apart(self):
        """Whether the shares are others elsewhere."""
        both = self._squares * self._whole
        return bool((1.0 - self._with[both > 0.0] ** 2 / both[both > 0.0] > APART).any())


def bake(dense, shining, lattice, grids):
    """Both over a lattice."""
    arrays = {name: grids.dense(name).on(lattice) for name in dense.grids | shining.grids}
    taken, sent, turned = _Sum(lattice.count, 6), _Sum(lattice.count, 3), 0.0
    # Kept as long as colours may turn out to vary; large lattices have no room for them.
    rows_taken, rows_sent = ([], []) if lattice.count <= COLOURED else (None, None)
    for start in range(0, lattice.count, AT_ONCE):
        rows = np.arange(start, min(start + AT_ONCE, lattice.count))
        found = dense.on(lattice, rows, arrays).astype(float)
        coefficients = np.maximum(found[:, :6], 0.0)
        taken.add(rows, coefficients)
        turned += float(found[:, 6].sum())
        shone = np.maximum(shining.on(lattice, rows, arrays).astype(float), 0.0)
        sent.add(rows, shone)
        if rows_taken is not None:
            rows_taken.append(coefficients.astype(np.float32))
            rows_sent.append(shone.astype(np.float32))
    shares, shape = taken.shares(), lattice.shape
    taken_apart, sent_apart = taken.are_apart(), sent.are_apart()
    return Baked(
        taken.whole.reshape(shape),
        sent.whole.reshape(shape),
        shares[:3],
        shares[3:],
        taken.of_one(turned),
        sent.shares(),
        taken_apart,
        sent_apart,
        _whole(rows_taken, shape) if taken_apart else None,
        _whole(rows_sent, shape) if sent_apart else None,
    )


def _whole(rows, shape):
    """All points' numbers as an array of the lattice's shape, a colour a point."""
    return None if rows is None else np.concatenate(rows).reshape((*shape, -1))

# SPDX-License-Identifier: GPL-3.0-or-later
"""The part of space in which a world's volume is asked, and the points there: about the scene, as far as the volume goes on changing."""

from dataclasses import dataclass

import numpy as np

from .bounds import Bounds, Within
from .lattice import AT_ONCE, filling

# How far beyond the scene a volume is asked that changes along so many axes, in longest edges of the scene's box; below, never further than the last.
REACH, BELOW = {1: 8.0, 2: 2.0, 3: 0.5}, 0.1
# All points at most, and along one axis.
POINTS, LEAST, MOST = 1 << 21, 32, 2048
# Points along an axis of the first look, by how many axes the volume changes along.
COARSE = {1: 4096, 2: 512, 3: 64}
# Pairs of places that tell whether a volume changes along an axis.
PAIRS = 8192
# What is less than this share of the most, or changes by less, counts as nothing.
SLIGHT = 1e-4
# For how much of what was asked the outermost values go on, on each side.
ONWARDS = 1.5
# How many metres from the origin what does not change along an axis goes on: as far as Cycles has volumes of worlds.
FAR = 1e4


class Spots:
    """Places in the world, which is the texture space of its volume."""

    def __init__(self, points):
        self._points = points

    def points(self, rows):
        """Some of them."""
        return self._points[rows]

    def shares(self, points):
        """Generated coordinates."""
        return points


@dataclass(frozen=True)
class Part:
    """Points along an axis, from one place to another, and for how many points the outermost values go on before and behind these."""

    low: float
    high: float
    count: int
    beyond: tuple


class Space(Bounds):
    """As a volume's grids: none that a shader could ask for, on points about the scene."""

    def __init__(self, parts):
        low, high = (np.array([getattr(part, end) for part in parts]) for end in ("low", "high"))
        shape = tuple(part.count for part in parts)
        self.beyond = np.array([part.beyond for part in parts]).T.tolist()
        self._lattice = Within(np.broadcast_to(np.float32(1.0), shape), filling(low, high, shape), np.zeros(3), np.ones(3))
        self.stamp = np.concatenate([low, high, shape]).tobytes()


def space_of(asked, low, high):
    """Where values are asked about a scene's box; None where there is nothing. `asked` are what takes light and what sends it."""
    found = _Found(asked, low, high)
    if not found.most.any():
        return None
    moving = [axis for axis in range(3) if found.moves(axis)]
    parts = [Part(min(-FAR, first), max(FAR, last), 1, (0.0, 0.0)) for first, last in zip(low, high, strict=True)]
    if not moving:
        return Space(parts)
    ends = found.ends(moving)
    if ends is None:
        return None
    left, edges = float(POINTS), {axis: high - low for axis, (low, high, _) in ends.items()}
    for axis in sorted(moving, key=edges.get):
        # Thin parts have some points as well; the others share what is left.
        even = edges[axis] * (left / np.prod(list(edges.values()))) ** (1.0 / len(edges))
        count = int(np.clip(even, LEAST, MOST))
        low, high, goes_on = ends[axis]
        parts[axis] = Part(low, high, count, tuple(ONWARDS * count * on for on in goes_on))
        left /= count
        del edges[axis]
    return Space(parts)


class _Found:
    """What a volume is at places about a scene's box, in parts of the most there, of what takes light and of what sends it."""

    def __init__(self, asked, low, high):
        self._asked, self._low, self._high = asked, low, high
        self._longest = float((high - low).max())
        self.middle = 0.5 * (low + high)
        random = np.random.default_rng(0)
        near, wide = (random.uniform(low - more, high + more, (PAIRS // 2, 3)) for more in (0.0, self._longest))
        self._spots = np.concatenate([near, wide])
        self._others = np.concatenate([near[random.permutation(len(near))], wide[random.permutation(len(wide))]])
        self.most = np.ones(2)
        values = self._at(self._spots)
        inner = values[: PAIRS // 2] if values[: PAIRS // 2].any() else values
        self.most = np.array([inner[:, :6].max(), inner[:, 6:].max()])
        self._values = values / self._scale()

    def _scale(self):
        return np.repeat(np.where(self.most > 0.0, self.most, 1.0), (6, 3))

    def _at(self, points):
        """Nine numbers for each place."""
        found = np.empty((len(points), 9))
        for start in range(0, len(points), AT_ONCE):
            rows = np.arange(start, min(start + AT_ONCE, len(points)))
            taken, sent = (each.on(Spots(points), rows, {}) for each in self._asked)
            found[rows] = np.maximum(np.concatenate([taken[:, :6], sent], axis=1), 0.0)
        return found / self._scale()

    def moves(self, axis):
        """Whether it changes along an axis."""
        moved = self._spots.copy()
        moved[:, axis] = self._others[:, axis]
        other = self._at(moved)
        return bool((np.abs(other - self._values) > SLIGHT * (np.maximum(other, self._values) + SLIGHT)).any())

    def ends(self, moving):
        """By axis along which it changes: from where to where it is asked, and on which sides it goes on; None where nothing is there."""
        reach, cells = REACH[len(moving)] * self._longest, COARSE[len(moving)]
        low, high = self._low - reach, self._high + reach
        low[2] = self._low[2] - min(reach, BELOW * self._longest)
        shares = (np.arange(cells) + 0.5) / cells
        axes = [low[axis] + shares * (high - low)[axis] if axis in moving else self.middle[axis : axis + 1] for axis in range(3)]
        points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
        values = self._at(points.reshape(-1, 3)).reshape(*points.shape[:3], 9)
        found = {}
        for axis in moving:
            along = np.moveaxis(values, axis, 0).reshape(cells, -1)
            if along.max() <= SLIGHT:
                return None
            edge = (high[axis] - low[axis]) / cells
            before, first = _blank(along, (self._low[axis] - low[axis]) / edge)
            behind, last = _blank(along[::-1], (high[axis] - self._high[axis]) / edge)
            found[axis] = low[axis] + first * edge, high[axis] - last * edge, (not before, not behind)
        return found


def _blank(along, outside):
    """Whether nothing is at the first cells, and how many of these need not be asked: one before something is. Of those that are alike these are
    before the scene's box, where there are so many cells."""
    filled = int(np.argmax((along > SLIGHT).any(axis=1)))
    if filled > 0:
        return True, filled - 1
    alike = int(np.argmax((np.abs(along - along[0]) > SLIGHT * (along[0] + SLIGHT)).any(axis=1)))
    return False, max(min(alike, int(outside)) - 1, 0)

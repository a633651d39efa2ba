# SPDX-License-Identifier: GPL-3.0-or-later
"""How coarse the first picture after an edit is, so that it comes in time."""

# What the first picture may take, in seconds, from the start of its render until it can be drawn.
FIRST_PICTURE = 0.06
COARSEST = 16
# Pixels a second, until measured.
FIRST_GUESS = 5e5
# How far a measurement moves what is known, from 0 to 1.
TRUST = 0.5
# Part of the time that a finer picture may take, so that the resolution does not go to and fro.
MARGIN = 0.8
# By the choice in the scene's settings: pixels each way that become one.
FACTORS = {"FULL": 1, "HALF": 2, "QUARTER": 4, "EIGHTH": 8}


class Pace:
    """Chooses the resolution of first pictures from what earlier ones took."""

    def __init__(self) -> None:
        self._rate = FIRST_GUESS
        self._latest = 1

    def factor(self, size: tuple[int, int], finest: int, choice: str) -> int:
        """Pixels each way that become one, at least `finest`; a choice of AUTO goes by the time."""
        self._latest = max(finest, FACTORS[choice]) if choice in FACTORS else self._in_time(size, finest)
        return self._latest

    def _in_time(self, size: tuple[int, int], finest: int) -> int:
        width, height = size
        factor = finest
        while factor < COARSEST and width * height / factor**2 > self._affordable(factor):
            factor += 1
        return factor

    def _affordable(self, factor: int) -> float:
        """Pixels that come in time."""
        return self._rate * FIRST_PICTURE * (MARGIN if factor < self._latest else 1.0)

    def learn(self, size: tuple[int, int], seconds: float) -> None:
        """Takes over what a first picture of a size took, preparing and painting it included."""
        width, height = size
        self._rate *= (width * height / max(seconds, 1e-3) / self._rate) ** TRUST

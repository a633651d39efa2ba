"""How coarse the picture is while the view moves, from how fast earlier pictures came."""

from __future__ import annotations

import math

# Seconds that a picture may take while the view moves.
IN_TIME = 0.07
COARSEST = 16
# Pixels a second, before anything is known.
GUESS = 3e5


class Pace:
    """Picks the number of pixels each way that become one."""

    def __init__(self) -> None:
        self._speed = GUESS
        # Set by the user, 0 for what comes in time.
        self.chosen = 0

    def factor(self, size: tuple[int, int]) -> int:
        """For a picture of so many pixels."""
        if self.chosen:
            return self.chosen
        wanted = math.sqrt(size[0] * size[1] / (self._speed * IN_TIME))
        # Half a step of slack, so that the resolution does not go to and fro.
        return max(1, min(COARSEST, round(wanted + 0.2)))

    def learn(self, pixels: int, seconds: float) -> None:
        """A picture of so many pixels took so long."""
        speed = pixels / max(seconds, 1e-3)
        self._speed = math.sqrt(self._speed * speed)


def reduced(size: tuple[int, int], factor: int) -> tuple[int, int]:
    """Pixels of a picture that is so much coarser."""
    return max(1, -(-size[0] // factor)), max(1, -(-size[1] // factor))

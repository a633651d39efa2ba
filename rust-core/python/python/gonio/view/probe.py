"""What lies under the cursor: luminance, colour, illuminance, distance, and the prim."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

from .._gonio import Film
from .stage import Placement

# Pixels to each side over which illuminance is averaged, on the same prim: that of one pixel is noisy.
AROUND = 2


@dataclass(frozen=True)
class Reading:
    """A pixel's values; None where a film does not have them or nothing is there."""

    x: int
    y: int
    # cd/m².
    luminance: float | None
    # Radiance times the camera's exposure.
    rgb: tuple[float, float, float]
    # lx: of this pixel, and of those around it on the same prim.
    illuminance: float | None
    illuminance_around: float | None
    # Metres along the camera's axis.
    depth: float | None
    # The prim's path, with the number of the placement where there are several.
    prim: str | None


class Probe:
    """Reads the pixels of a film."""

    def __init__(self, film: Film, placements: Sequence[Placement]) -> None:
        self._placements = placements
        names = [name for name in ("color", "luminance", "illuminance", "depth", "primId", "instanceId") if name in film.passes]
        self._passes = {name: memoryview(film[name]) for name in names}
        self.size = film.size

    def read(self, x: int, y: int) -> Reading | None:
        """A pixel, counted from the upper left corner; None outside."""
        width, height = self.size
        if not (0 <= x < width and 0 <= y < height):
            return None
        red, green, blue = (float(self._passes["color"][y, x, channel]) for channel in range(3))
        prim = self._number("primId", x, y)
        is_there = prim is not None and 0 <= prim < len(self._placements)
        return Reading(
            x,
            y,
            self._value("luminance", x, y),
            (red, green, blue),
            self._value("illuminance", x, y) if is_there else None,
            self._mean("illuminance", x, y, prim) if is_there else None,
            self._value("depth", x, y) if is_there else None,
            self._name(prim, x, y) if is_there else None,
        )

    def _value(self, name: str, x: int, y: int) -> float | None:
        if name not in self._passes:
            return None
        value = float(self._passes[name][y, x, 0])
        return value if math.isfinite(value) else None

    def _number(self, name: str, x: int, y: int) -> int | None:
        value = self._value(name, x, y)
        return None if value is None else round(value)

    def _mean(self, name: str, x: int, y: int, prim: int | None) -> float | None:
        if name not in self._passes:
            return None
        width, height = self.size
        columns = range(max(0, x - AROUND), min(width, x + AROUND + 1))
        rows = range(max(0, y - AROUND), min(height, y + AROUND + 1))
        same = [self._value(name, column, row) for row in rows for column in columns if self._number("primId", column, row) == prim]
        values = [value for value in same if value is not None]
        return sum(values) / len(values) if values else None

    def _name(self, prim: int | None, x: int, y: int) -> str | None:
        if prim is None:
            return None
        name, count = self._placements[prim]
        return name if count == 1 else f"{name} [{self._number('instanceId', x, y)}]"


def words(reading: Reading) -> str:
    """A line for people."""
    red, green, blue = reading.rgb
    parts = [f"{reading.x}, {reading.y}"]
    if reading.luminance is not None:
        parts.append(f"{number(reading.luminance)} cd/m²")
    parts.append(f"RGB {number(red)} {number(green)} {number(blue)}")
    if reading.illuminance is not None and reading.illuminance_around is not None:
        parts.append(f"{number(reading.illuminance)} lx (around {number(reading.illuminance_around)} lx)")
    if reading.depth is not None:
        parts.append(f"{reading.depth:.3f} m")
    parts.append(reading.prim or "nothing")
    return "   ".join(parts)


def number(value: float) -> str:
    """Four digits, as many as such values deserve."""
    if value == 0.0 or not math.isfinite(value):
        return f"{value:g}"
    digits = max(0, 3 - math.floor(math.log10(abs(value))))
    return f"{value:.{min(digits, 6)}f}"

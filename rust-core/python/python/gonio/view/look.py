"""From a film to what the window shows: tone mapped, or luminance and illuminance in false colour."""

from __future__ import annotations

import math
import os
from dataclasses import dataclass, replace

from .._gonio import Film, Picture, false_colour

UNITS = {"luminance": "cd/m²", "illuminance": "lx"}
OPERATORS = ("photographic", "local", "ev100", "none")
# The part of white that an eye of the eye's own exposure sees as the middle, as the photographic operators have it.
KEY = 0.18
# What `ev100` shows as white: so many cd/m² at 0.
WHITE_AT_0 = 1.2
# Values are averaged over so many pixels to each side before lines are drawn.
SMOOTHING = 3


@dataclass(frozen=True)
class Look:
    """How films are shown."""

    # picture, luminance or illuminance.
    show: str = "picture"
    operator: str = "photographic"
    # Powers of two by which the picture is brightened.
    stops: float = 0.0
    # Whether the exposure follows the picture; else it stays with `adapted`, a log-average luminance.
    is_automatic: bool = True
    adapted: float | None = None
    # Exposure value of `ev100`, where it is not automatic.
    ev: float = 12.0
    # The upper end of false colours, None for a round number that nearly all values stay below.
    scale_max: float | None = None
    steps: int = 10
    # Decades of a logarithmic scale.
    decades: float | None = None
    contours: bool = False

    def passes(self, is_measuring: bool) -> tuple[str, ...]:
        """What a picture must have; `is_measuring` for illuminance under the cursor too."""
        lux = ("illuminance",) if is_measuring or self.show == "illuminance" else ()
        return ("color", "luminance", "depth", "primId", "instanceId", *lux)

    def paint(self, film: Film, *, legend: bool = False) -> Picture:
        """A film with those passes as pixels, opaque."""
        if self.show == "picture":
            operator, adapted = self._tone_map(film)
            return film.picture(operator, self.stops, adapted=adapted, over_black=True)
        return false_colour(
            film[self.show],
            max=self.scale_max,
            steps=self.steps,
            log=self.decades,
            unit=UNITS[self.show],
            contours=self.contours,
            smoothing=SMOOTHING,
            legend=legend,
        )

    def write(self, film: Film, path: str | os.PathLike[str]) -> None:
        """Writes what is shown as PNG or JPEG, false colours with their legend as PNG; all passes as EXR."""
        if os.fspath(path).lower().endswith(".exr"):
            film.write_exr(path)
        elif self.show == "picture":
            operator, adapted = self._tone_map(film)
            film.write_picture(path, operator, self.stops, adapted=adapted)
        else:
            self.paint(film, legend=True).write(path)

    def held(self, film: Film | None) -> Look:
        """With the exposure that the film has now, which later ones keep."""
        if film is None:
            return replace(self, is_automatic=False)
        average = film.log_average()
        return replace(self, is_automatic=False, adapted=average, ev=_ev_of(average))

    def _tone_map(self, film: Film) -> tuple[str, float | None]:
        """The operator's name with its number, and the luminance that it is adapted to."""
        if self.operator == "ev100":
            return f"ev100={_ev_of(film.log_average()) if self.is_automatic else self.ev}", None
        return self.operator, None if self.is_automatic else self.adapted


def _ev_of(average: float) -> float:
    """The exposure value that shows a log-average luminance as the middle."""
    return round(math.log2(max(average, 1e-9) / KEY / WHITE_AT_0), 4)


def operator_of(text: str | None, is_camera_lit: bool) -> tuple[str, float | None]:
    """An operator as the command line has it: its name, and a fixed exposure value."""
    if text is None:
        return ("none" if is_camera_lit else "photographic"), None
    name, _, value = text.partition("=")
    return name, float(value) if value else None

# SPDX-License-Identifier: GPL-3.0-or-later
"""Gonio's own way from light to a picture, in the place of Blender's view transform."""

import math
from dataclasses import dataclass

import gonio

from ..export.settings import LEAST_EXPOSURE


@dataclass(frozen=True)
class ToneMap:
    """An operator as `gonio.Film.tone_mapped` takes it."""

    operator: str
    # Powers of two by which the picture is brightened.
    stops: float
    white: float

    @classmethod
    def of(cls, settings) -> "ToneMap | None":
        """What a scene's settings ask for; None for scene-linear light."""
        if settings.tone_map == "NONE":
            return None
        operator = f"ev100={settings.tone_map_ev100}" if settings.tone_map == "EV100" else settings.tone_map.lower()
        return cls(operator, math.log2(max(settings.film_exposure, LEAST_EXPOSURE)), settings.tone_map_white)

    def apply(self, film: gonio.Film) -> gonio.Film:
        """The colour that a view transform of the kind of Standard shows as the mapped picture."""
        return film.tone_mapped(self.operator, self.stops, white=self.white)

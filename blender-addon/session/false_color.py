# SPDX-License-Identifier: GPL-3.0-or-later
"""A film's luminance or illuminance in false colour, as a viewport draws it."""

from dataclasses import dataclass

import gonio
import numpy

# By the display chosen in the scene's settings: the pass, and its unit.
SOURCES = {"LUMINANCE": ("luminance", "cd/m²"), "ILLUMINANCE": ("illuminance", "lx")}
# Pixels over which values are averaged before contours are drawn.
SMOOTHING = 4
# Height of the legend over the viewport's.
LEGEND = 0.6


@dataclass(frozen=True)
class Shown:
    """Display values: flat RGBA float32, rows from the bottom."""

    width: int
    height: int
    pixels: object


@dataclass(frozen=True)
class Style:
    """What is shown, and how."""

    source: str
    unit: str
    max: float | None
    steps: int
    contours: bool

    @classmethod
    def of(cls, settings) -> "Style | None":
        """What a scene's settings ask for; None for the picture as it is."""
        if settings.display not in SOURCES:
            return None
        source, unit = SOURCES[settings.display]
        return cls(source, unit, settings.false_color_max or None, settings.false_color_steps, settings.use_false_color_contours)


def paint(film, style: Style, height: int) -> tuple[Shown, Shown]:
    """The film in false colour, and a legend for a viewport of a height in pixels."""
    picture = gonio.false_colour(
        numpy.asarray(film[style.source]),
        max=style.max,
        steps=style.steps,
        unit=style.unit,
        contours=style.contours,
        smoothing=SMOOTHING,
        legend=False,
    )
    return _shown(picture), _shown(picture.legend(int(height * LEGEND)))


def _shown(picture) -> Shown:
    width, height = picture.size
    pixels = numpy.frombuffer(picture.tobytes(), numpy.uint8).reshape(height, width, 4)[::-1]
    return Shown(width, height, numpy.ascontiguousarray(pixels, numpy.float32).ravel() / 255.0)

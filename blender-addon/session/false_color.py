# SPDX-License-Identifier: GPL-3.0-or-later
"""A film's luminance or illuminance in false colour, as a viewport draws it and as a pass."""

from dataclasses import dataclass

import gonio
import numpy

# By the display chosen in the scene's settings: the pass.
SOURCES = {"LUMINANCE": "luminance", "ILLUMINANCE": "illuminance"}
UNITS = {"luminance": "cd/m²", "illuminance": "lx"}
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
        return cls.of_source(SOURCES[settings.display], settings) if settings.display in SOURCES else None

    @classmethod
    def of_source(cls, source: str, settings) -> "Style":
        """How a pass is shown by a scene's settings."""
        unit, most = UNITS[source], settings.false_color_max or None
        return cls(source, unit, most, settings.false_color_steps, settings.use_false_color_contours)


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


def linear(film, style: Style) -> numpy.ndarray:
    """The film in false colour with the legend in its lower left corner: scene-linear RGBA that a view transform of the kind of Standard shows as
    the colours of the legend; flat float32, rows from the bottom."""
    width, height = film.size
    shown, legend = (part.pixels.reshape(part.height, part.width, 4) for part in paint(film, style, height))
    columns, rows = min(legend.shape[1], width), min(legend.shape[0], height)
    # The legend's head says the unit.
    shown[:rows, :columns] = legend[-rows:, :columns]
    colours = shown[..., :3]
    shown[..., :3] = numpy.where(colours <= 0.04045, colours / 12.92, ((colours + 0.055) / 1.055) ** 2.4)
    return shown.ravel()


def _shown(picture) -> Shown:
    width, height = picture.size
    pixels = numpy.frombuffer(picture.tobytes(), numpy.uint8).reshape(height, width, 4)[::-1]
    return Shown(width, height, numpy.ascontiguousarray(pixels, numpy.float32).ravel() / 255.0)

# SPDX-License-Identifier: GPL-3.0-or-later
"""From a film to what a viewport draws: the colour, denoised and tone-mapped as asked for, or false colour."""

from dataclasses import dataclass

from . import false_color
from .frame import Frame
from .passes import COMBINED, read_combined
from .tone_map import ToneMap

# What guides the quick denoiser.
GUIDES = ("denoising_albedo", "denoising_normal")


@dataclass(frozen=True)
class Picture:
    """Pixels to draw: `width` × `height` flat RGBA float32, rows from the bottom, of the rendered part of `frame`."""

    number: int
    width: int
    height: int
    pixels: object
    frame: Frame
    # In false colour the pixels are what the screen shows, and this stands beside them.
    legend: false_color.Shown | None = None


@dataclass(frozen=True)
class Appearance:
    """How a film is shown."""

    # None for the picture as it is.
    style: false_color.Style | None
    exposure: float
    # None for scene-linear light.
    tone_map: ToneMap | None
    # Samples from which on pictures are denoised, 0 for never.
    denoise_from: int

    @classmethod
    def of(cls, settings) -> "Appearance":
        """What a scene's settings ask of its viewports."""
        denoise_from = settings.preview_denoising_start_sample if settings.use_preview_denoising else 0
        return cls(false_color.Style.of(settings), settings.film_exposure, ToneMap.of(settings), denoise_from)

    def passes(self, samples: int) -> list[str]:
        """What a render of so many samples must have."""
        if self.style is not None:
            return [self.style.source]
        return [COMBINED.source, *(GUIDES if self._denoises(samples) else ())]

    def paint(self, film, number: int, view: Frame) -> Picture:
        """A film of those passes as a picture of a viewport."""
        width, height = film.size
        if self.style is not None:
            shown, legend = false_color.paint(film, self.style, view.height)
            return Picture(number, width, height, shown.pixels, view, legend)
        quiet = film.edge_aware() if self._denoises(film.samples) else film
        return Picture(number, width, height, read_combined(quiet, self.exposure, self.tone_map), view)

    def _denoises(self, samples: int) -> bool:
        return 0 < self.denoise_from <= samples

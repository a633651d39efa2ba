# SPDX-License-Identifier: GPL-3.0-or-later
"""The polar diagram of a luminaire as a picture in a panel: C0-C180 red and whole, C90-C270 blue and dashed, nadir down."""

from functools import lru_cache

import bpy.utils.previews
import numpy as np

from .. import luminaire

SIDE = 256
MARGIN = 10.0
RINGS = 4
GREY, RED, BLUE = (0.55, 0.55, 0.55, 0.5), (0.86, 0.22, 0.2, 1.0), (0.3, 0.55, 0.9, 1.0)

_previews = None


def register() -> None:
    global _previews
    _previews = bpy.utils.previews.new()


def unregister() -> None:
    global _previews
    bpy.utils.previews.remove(_previews)
    _previews = None
    drawn.cache_clear()


def icon_of(light) -> int:
    """The icon of a light's file; raises OSError and gonio.Error."""
    key = "\n".join(map(str, luminaire.file_of(light)))
    if key not in _previews:
        preview = _previews.new(key)
        preview.image_size = (SIDE, SIDE)
        cuts = luminaire.figures(light)["cuts"]
        preview.image_pixels_float = drawn(tuple(tuple(map(tuple, cut)) for cut in cuts)).ravel()
    return _previews[key].icon_id


@lru_cache(maxsize=4)
def drawn(cuts) -> np.ndarray:
    """Pixels (height, width, RGBA) from the bottom row; cuts are γ in degrees and cd."""
    picture = np.zeros((SIDE, SIDE, 4), dtype=np.float32)
    radius = 0.5 * SIDE - MARGIN
    for ring in range(1, RINGS + 1):
        turn = np.radians(np.arange(0, 361, 3))
        _draw(picture, np.stack([np.sin(turn), np.cos(turn)], axis=1) * radius * ring / RINGS, GREY, 0.6)
    for angle in range(0, 180, 30):
        end = np.array([np.sin(np.radians(angle)), np.cos(np.radians(angle))]) * radius
        _draw(picture, np.stack([-end, end]), GREY, 0.6)
    peak = max((value for cut in cuts for _, value in cut), default=0.0)
    for cut, colour, dash in ((cuts[1], BLUE, 9.0), (cuts[0], RED, 0.0)):
        if peak > 0.0 and len(cut) > 1:
            angle, value = np.radians([point[0] for point in cut]), np.array([point[1] for point in cut]) / peak * radius
            _draw(picture, np.stack([np.sin(angle) * value, -np.cos(angle) * value], axis=1), colour, 1.5, dash)
    return picture


def _draw(picture, points, colour, half_width, dash=0.0) -> None:
    """Lays a line through points about the picture's middle, y up, over it; with dashes of a length in pixels if that is not 0."""
    cover = np.zeros((SIDE, SIDE), dtype=np.float32)
    along = 0.0
    for start, end in zip(points[:-1] + 0.5 * SIDE, points[1:] + 0.5 * SIDE, strict=True):
        length = float(np.hypot(*(end - start)))
        low = np.clip(np.floor(np.minimum(start, end) - half_width - 1).astype(int), 0, SIDE - 1)
        high = np.clip(np.ceil(np.maximum(start, end) + half_width + 1).astype(int), 0, SIDE - 1)
        x, y = np.meshgrid(np.arange(low[0], high[0] + 1) + 0.5, np.arange(low[1], high[1] + 1) + 0.5)
        t = np.zeros_like(x)
        if length > 0.0:
            t = np.clip(((x - start[0]) * (end[0] - start[0]) + (y - start[1]) * (end[1] - start[1])) / length**2, 0.0, 1.0)
        away = np.hypot(x - start[0] - t * (end[0] - start[0]), y - start[1] - t * (end[1] - start[1]))
        line = np.clip(half_width + 0.5 - away, 0.0, 1.0)
        if dash > 0.0:
            line *= ((along + t * length) // dash) % 2 == 0
        part = cover[low[1] : high[1] + 1, low[0] : high[0] + 1]
        np.maximum(part, line, out=part)
        along += length
    share = (cover * colour[3])[..., None]
    picture[..., :3] = picture[..., :3] * (1.0 - share) + np.array(colour[:3]) * share
    picture[..., 3:] = picture[..., 3:] + (1.0 - picture[..., 3:]) * share

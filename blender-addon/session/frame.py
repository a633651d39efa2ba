# SPDX-License-Identifier: GPL-3.0-or-later
"""Sizes of pictures: resolution, border and crop."""

from dataclasses import dataclass

import numpy

Crop = tuple[int, int, int, int]


@dataclass(frozen=True)
class Frame:
    """A picture of `width` × `height` pixels, of which `crop` is rendered: (x0, y0, x1, y1), rows from the top."""

    width: int
    height: int
    crop: Crop | None = None

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of the rendered part."""
        if self.crop is None:
            return self.width, self.height
        x0, y0, x1, y1 = self.crop
        return x1 - x0, y1 - y0

    @property
    def corner(self) -> tuple[int, int]:
        """The rendered part's lower left corner, rows from the bottom."""
        return (0, 0) if self.crop is None else (self.crop[0], self.height - self.crop[3])

    def reduced(self, factor: int) -> "Frame":
        """The same picture with `factor` × `factor` pixels in one."""
        if factor <= 1:
            return self
        width, height = max(1, self.width // factor), max(1, self.height // factor)
        if self.crop is None:
            return Frame(width, height)
        x, y = width / self.width, height / self.height
        x0, y0 = min(int(self.crop[0] * x), width - 1), min(int(self.crop[1] * y), height - 1)
        return Frame(width, height, (x0, y0, max(x0 + 1, round(self.crop[2] * x)), max(y0 + 1, round(self.crop[3] * y))))


def crop_of_border(width: int, height: int, left: float, bottom: float, right: float, top: float) -> Crop | None:
    """Pixels of a border in fractions of the picture, rounded towards zero as Blender does in single precision."""
    x0, x1 = (int(min(max(numpy.float32(edge), 0.0), 1.0) * numpy.float32(width)) for edge in (left, right))
    y0, y1 = (int(min(max(numpy.float32(edge), 0.0), 1.0) * numpy.float32(height)) for edge in (bottom, top))
    if x1 <= x0 or y1 <= y0 or (x0, y0, x1, y1) == (0, 0, width, height):
        return None
    return x0, height - y1, x1, height - y0


def begun_with(engine):
    """The render settings that a render was begun with. Blender lays its results out by these for a whole animation, whatever a handler
    makes of the scene's meanwhile. (The engine's callback hides the property's name.)"""
    return engine.path_resolve("render")


def final_frame(render) -> Frame:
    """What Blender expects of a final render with these render settings."""
    whole = _whole(render)
    return _bordered(whole, render) if render.use_border else whole


def expected_frame(engine) -> Frame:
    """What Blender expects of the render under way. Its result has the border's place as of the animation's start, but only where the scene
    had its border on before this frame's handlers ran: the result's size tells which."""
    render, result = begun_with(engine), engine.get_result()
    whole = _whole(render)
    return whole if (result.resolution_x, result.resolution_y) == whole.size else _bordered(whole, render)


def _whole(render) -> Frame:
    return Frame(*(max(1, edge * render.resolution_percentage // 100) for edge in (render.resolution_x, render.resolution_y)))


def _bordered(whole: Frame, render) -> Frame:
    border = (render.border_min_x, render.border_min_y, render.border_max_x, render.border_max_y)
    return Frame(whole.width, whole.height, crop_of_border(whole.width, whole.height, *border))

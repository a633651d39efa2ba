# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a session's picture into a 3D viewport."""

import gpu
from gpu_extras.presets import draw_texture_2d


class ViewportDrawing:
    """The textures of one 3D viewport."""

    def __init__(self) -> None:
        self._number = -1
        self._texture = None
        self._legend = None

    def draw(self, engine, scene, picture, width: int, height: int, covered: int) -> None:
        """Draws a picture over a viewport of `width` × `height` pixels, of which the sidebar covers some columns: scene-linear through Blender's
        display transform, false colour as it is with its legend."""
        if picture.number != self._number:
            self._texture = _texture(picture)
            self._legend = _texture(picture.legend) if picture.legend is not None else None
            self._number = picture.number
        # A picture of the size before is stretched until the next one comes.
        x, y = width / picture.frame.width, height / picture.frame.height
        (left, bottom), (across, up) = picture.frame.corner, picture.frame.size
        place = (left * x, bottom * y), across * x, up * y
        gpu.state.blend_set("ALPHA_PREMULT")
        try:
            if self._legend is not None:
                draw_texture_2d(self._texture, *place)
                left = width - covered - picture.legend.width
                draw_texture_2d(self._legend, (left, 0), picture.legend.width, picture.legend.height)
                return
            engine.bind_display_space_shader(scene)
            try:
                draw_texture_2d(self._texture, *place)
            finally:
                engine.unbind_display_space_shader()
        finally:
            gpu.state.blend_set("NONE")


def _texture(picture):
    """The pixels of a picture on the graphics card."""
    buffer = gpu.types.Buffer("FLOAT", picture.width * picture.height * 4, picture.pixels)
    return gpu.types.GPUTexture((picture.width, picture.height), format="RGBA16F", data=buffer)

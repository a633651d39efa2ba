# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a session's picture into a 3D viewport."""

import gpu
from gpu_extras.presets import draw_texture_2d


class ViewportDrawing:
    """The texture of one 3D viewport."""

    def __init__(self) -> None:
        self._number = -1
        self._texture = None

    def draw(self, engine, scene, picture, width: int, height: int) -> None:
        """Draws a picture over a viewport of `width` × `height` pixels, scene-linear through Blender's display transform."""
        if picture.number != self._number:
            buffer = gpu.types.Buffer("FLOAT", picture.width * picture.height * 4, picture.pixels)
            self._texture = gpu.types.GPUTexture((picture.width, picture.height), format="RGBA16F", data=buffer)
            self._number = picture.number
        # A picture of the size before is stretched until the next one comes.
        x, y = width / picture.frame.width, height / picture.frame.height
        (left, bottom), (across, up) = picture.frame.corner, picture.frame.size
        gpu.state.blend_set("ALPHA_PREMULT")
        engine.bind_display_space_shader(scene)
        try:
            draw_texture_2d(self._texture, (left * x, bottom * y), across * x, up * y)
        finally:
            engine.unbind_display_space_shader()
            gpu.state.blend_set("NONE")

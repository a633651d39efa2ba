# SPDX-License-Identifier: GPL-3.0-or-later
"""Draws a session's picture into a 3D viewport."""

import bpy
import gpu
from gpu_extras.presets import draw_texture_2d


class ViewportDrawing:
    """The textures of one 3D viewport."""

    def __init__(self) -> None:
        self._number = -1
        self._texture = None
        self._overlay = None

    def draw(self, engine, context, scene, picture) -> None:
        """Draws a picture over the viewport: scene-linear through Blender's display transform; false colour, which that would change, later."""
        region = context.region
        if picture.number != self._number:
            self._texture = _texture(picture)
            if picture.legend is None:
                self.close()
            else:
                # One for all pictures: what other operators draw lies over it.
                self._overlay = self._overlay or Overlay(context)
                self._overlay.show(self._texture, _texture(picture.legend), picture)
            self._number = picture.number
        if self._overlay is not None:
            return
        gpu.state.blend_set("ALPHA_PREMULT")
        engine.bind_display_space_shader(scene)
        try:
            draw_texture_2d(self._texture, *_place(picture, region))
        finally:
            engine.unbind_display_space_shader()
            gpu.state.blend_set("NONE")

    def close(self) -> None:
        """Takes the overlay away."""
        overlay, self._overlay = self._overlay, None
        if overlay is not None:
            overlay.close()


class Overlay:
    """A picture in display values and its legend, over a rendered 3D viewport."""

    def __init__(self, context) -> None:
        self._region = context.region.as_pointer()
        self._handler = bpy.types.SpaceView3D.draw_handler_add(self._draw, (), "WINDOW", "POST_PIXEL")

    def show(self, texture, legend, picture) -> None:
        """Takes over what is drawn from now on."""
        self._texture, self._legend, self._picture = texture, legend, picture

    def _draw(self) -> None:
        context = bpy.context
        if context.region.as_pointer() != self._region or context.space_data.shading.type != "RENDERED":
            return
        region, sidebar = context.region, next((each for each in context.area.regions if each.type == "UI"), None)
        # Without overlap the sidebar lies beside the view.
        overlaps = context.preferences.system.use_region_overlap
        covered = sidebar.width if overlaps and sidebar is not None and sidebar.width > 1 else 0
        legend = self._picture.legend
        gpu.state.blend_set("ALPHA_PREMULT")
        draw_texture_2d(self._texture, *_place(self._picture, region))
        draw_texture_2d(self._legend, (region.width - covered - legend.width, 0), legend.width, legend.height)
        gpu.state.blend_set("NONE")

    def close(self) -> None:
        """Draws no more."""
        bpy.types.SpaceView3D.draw_handler_remove(self._handler, "WINDOW")


def _place(picture, region):
    """Corner, width and height of a picture in a region; one of the size before is stretched until the next one comes."""
    x, y = region.width / picture.frame.width, region.height / picture.frame.height
    (left, bottom), (across, up) = picture.frame.corner, picture.frame.size
    return (left * x, bottom * y), across * x, up * y


def _texture(picture):
    """The pixels of a picture on the graphics card."""
    buffer = gpu.types.Buffer("FLOAT", picture.width * picture.height * 4, picture.pixels)
    return gpu.types.GPUTexture((picture.width, picture.height), format="RGBA16F", data=buffer)

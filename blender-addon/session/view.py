# SPDX-License-Identifier: GPL-3.0-or-later
"""What part of a 3D viewport is rendered, and which settings matter there."""

from ..properties.appearance import AppearanceSettings
from .frame import Crop, Frame, crop_of_border

# Properties of the scene's settings that are none, or say how a film is shown alone.
NO_RENDER = frozenset(("rna_type", "name", *AppearanceSettings.__annotations__)) - {"use_preview_direct_light"}


def frame_of(scene, space, region_3d, width: int, height: int) -> Frame:
    """The picture of a 3D viewport of `width` × `height` pixels, with its border."""
    return Frame(width, height, _border(scene, space, region_3d, width, height))


def _border(scene, space, region_3d, width: int, height: int) -> Crop | None:
    if region_3d.view_perspective == "CAMERA":
        camera = space.camera if space.use_local_camera else scene.camera
        render = scene.render
        if camera is None or camera.type != "CAMERA" or not render.use_border:
            return None
        left, bottom, right, top = camera_frame(scene, camera, region_3d)
        x, y = right - left, top - bottom
        return crop_of_border(
            width,
            height,
            left + x * render.border_min_x,
            bottom + y * render.border_min_y,
            left + x * render.border_max_x,
            bottom + y * render.border_max_y,
        )
    if not space.use_render_border:
        return None
    edges = (space.render_border_min_x, space.render_border_min_y, space.render_border_max_x, space.render_border_max_y)
    return crop_of_border(width, height, *edges)


def camera_frame(scene, camera, region_3d) -> tuple[float, float, float, float]:
    """Left, bottom, right and top edge of the camera's frame in fractions of the viewport."""
    place = camera.matrix_world.normalized()
    corners = [region_3d.perspective_matrix @ (place @ corner).to_4d() for corner in camera.data.view_frame(scene=scene)]
    across = [0.5 + 0.5 * corner.x / corner.w for corner in corners]
    up = [0.5 + 0.5 * corner.y / corner.w for corner in corners]
    return min(across), min(up), max(across), max(up)


def settings_of(scene) -> tuple:
    """All settings whose change needs another render but no export."""
    own = tuple(getattr(scene.gonio, name) for name in scene.gonio.bl_rna.properties.keys() if name not in NO_RENDER)
    render = scene.render
    return (
        own,
        (render.film_transparent, render.pixel_aspect_x, render.pixel_aspect_y, render.threads_mode, render.threads),
    )

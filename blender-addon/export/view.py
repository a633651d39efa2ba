# SPDX-License-Identifier: GPL-3.0-or-later
"""The viewport's own view as a camera."""

import numpy as np

from .camera import PINHOLE, depth_of_field
from .camera import describe as describe_camera
from .transforms import columns, without_scale


def describe(depsgraph, space, region, width, height, report):
    """The description of what a 3D view shows, from its projection matrix: perspective, orthographic, or through the camera."""
    source = _seen_through(depsgraph, space, region)
    if source is not None and source.type == "CAMERA" and source.data.type == "PANO":
        return _panorama(source, width, height, depsgraph, report)
    projection = np.array(region.window_matrix, dtype=float)
    pose = np.linalg.inv(np.array(region.view_matrix, dtype=float))
    is_perspective = abs(projection[3, 3]) < 0.5
    aperture = [2.0 / projection[0, 0], 2.0 / projection[1, 1]]
    # The middle of the picture on the image plane, at distance 1 for a lens.
    column = 2 if is_perspective else 3
    offset = [projection[axis, column] / projection[axis, axis] * (1.0 if is_perspective else -1.0) for axis in (0, 1)]
    clipping = _clipping(space, source)
    if not is_perspective and source is None:
        # Blender's orthographic view reaches as far behind its centre as before it.
        reach = 0.5 * space.clip_end
        pose[:3, 3] += pose[:3, 2] * reach
        clipping = [0.0, 2.0 * reach]
    has_lens = source is not None and source.type == "CAMERA"
    return {
        "origin": {"name": "view" if source is None else source.name, "file": ""},
        "projection": {"Perspective": {"focal_length": 1.0}} if is_perspective else "Orthographic",
        "aperture": [float(x) for x in aperture],
        "aperture_offset": [float(x) for x in offset],
        "clipping": clipping,
        "transform": columns(without_scale(pose)),
        "exposure": 1.0,
        **(depth_of_field(source, depsgraph) if has_lens else PINHOLE),
    }


def _seen_through(depsgraph, space, region):
    if region.view_perspective != "CAMERA":
        return None
    source = space.camera if space.use_local_camera else depsgraph.scene.camera
    return None if source is None else source.evaluated_get(depsgraph)


def _clipping(space, source):
    thing = source.data if source is not None and source.type == "CAMERA" else space
    return [float(thing.clip_start), float(thing.clip_end)]


def _panorama(source, width, height, depsgraph, report):
    """A panoramic camera fills the view; zoom and offset of the view have no meaning for it."""
    return describe_camera(source, width, height, (1.0, 1.0), report, depsgraph)

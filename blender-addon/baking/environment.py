# SPDX-License-Identifier: GPL-3.0-or-later
"""The world's light by direction, for what Cycles bakes as Environment: seen from the world's origin towards each texel's place."""

import gonio
import numpy as np

from ..export import Exporter
from ..report import Report

# Rows of the picture of the world.
ROWS = 1024
SAMPLES = 4
# Looks along Blender's +Y, upright along +Z.
COLUMNS = [[1.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [0.0, 0.0, 0.0]]
ALL_AROUND = {"Equirectangular": {"longitude": [-np.pi, np.pi], "latitude": [-0.5 * np.pi, 0.5 * np.pi]}}


def seen_of_world(depsgraph, places: np.ndarray, cancelled) -> np.ndarray:
    """Radiance (height, width, 3) as the renderer has it, in the directions of places (height, width, 3)."""
    exporter = Exporter(Report())
    scene = exporter.sync_world(depsgraph)
    camera = {
        "origin": {"name": "world", "file": ""},
        "projection": ALL_AROUND,
        "aperture": [1.0, 1.0],
        "aperture_offset": [0.0, 0.0],
        "clipping": [0.0, 1e6],
        "transform": {"columns": COLUMNS},
        "exposure": 1.0,
        "lens_radius": 0.0,
        "focus_distance": 1.0,
        "blades": 0,
        "blade_rotation_deg": 0.0,
        "lens_ratio": 1.0,
    }
    scene.put_camera(camera)
    scene.set(camera=0, width=2 * ROWS, height=ROWS, samples=SAMPLES, filter="box", filter_width=1.0, passes=["color"], max_bounces=0)
    with gonio.Render(scene, cancelled=cancelled) as render:
        render.wait()
        picture = np.asarray(render.film()["color"])[..., :3]
    return _looked_up(picture, places)


def _looked_up(picture: np.ndarray, places: np.ndarray) -> np.ndarray:
    """The picture's values between pixels, by their distances."""
    rows, columns, _ = picture.shape
    x, y, z = np.moveaxis(places.astype(float), -1, 0)
    across = np.arctan2(x, y) / (2.0 * np.pi) * columns + 0.5 * columns - 0.5
    down = (0.5 - np.arctan2(z, np.hypot(x, y)) / np.pi) * rows - 0.5
    left, top = np.floor(across).astype(int), np.floor(down).astype(int)
    along, below = (across - left)[..., None], (down - top)[..., None]
    value = [[picture[np.clip(top + row, 0, rows - 1), (left + column) % columns] for column in (0, 1)] for row in (0, 1)]
    first, second = (row[0] * (1.0 - along) + row[1] * along for row in value)
    return first * (1.0 - below) + second * below

"""Sheets with names, one over the other, for tests of mattes."""

import gonio
import numpy as np
from small_scenes import QUAD, above

MATTES = ["cryptomatte_object", "cryptomatte_material", "cryptomatte_asset"]
# Name, asset, material, opacity, height, corners in the plane: slanted sheets one over the other, from the lowest to the highest.
SHEETS = [
    ("floor", "room", "stone", 1.0, 0.0, [(-3, -3), (3, -3), (3, 3), (-3, 3)]),
    ("Größe ☃", "things", "paint", 1.0, 0.5, [(-1.4, -0.3), (0.4, -1.2), (1.1, 0.4), (-0.6, 1.1)]),
    ('a "quoted" \\ name', "things", "gauze", 0.4, 1.0, [(-0.2, -0.9), (1.5, -0.4), (1.2, 1.3), (-0.5, 0.8)]),
    ("/World/wire", "things", "paint", 1.0, 1.5, [(-1.6, 0.1), (1.6, 0.32), (1.6, 0.38), (-1.6, 0.16)]),
]


def sheets(lit=None, sheet=SHEETS, **settings):
    """The sheets from above; those of which `lit` is true shine, and nothing else does."""
    scene = gonio.Scene()
    scene.set(**{"width": 64, "height": 48, "samples": 32, "film_transparent": True, "passes": ["color", *MATTES], **settings})
    for name, asset, material, opacity, height, corners in sheet:
        shines = lit is not None and lit(name, material, asset)
        surface = scene.add_material(
            material, base_color=(0.0, 0.0, 0.0), specular_weight=0.0, geometry_opacity=opacity, emission_color=[float(shines)] * 3
        )
        points = np.array([(x, height, z) for x, z in corners], "f4")
        scene.put_instances(scene.add_mesh(points, QUAD), [surface], np.eye(4)[None].copy(), name=name, asset=asset)
    scene.add_camera(above(8), fov=40)
    return scene

"""Cut stones of glasses and crystals under a small lamp: `python glasses.py glasses.png`."""

import math
import sys

import gonio
import numpy as np
from shapes import finished, quad

GLASSES = ("water", "N-BK7", "sapphire", "N-SF66", "diamond", "moissanite")
RADIUS, APART, SIDES = 0.05, 0.135, 8
# How steep the facets below and above the girdle are, and the table's share of the width.
PAVILION, CROWN, TABLE = math.radians(41.0), math.radians(34.0), 0.55


def cut(scene: gonio.Scene) -> int:
    """A stone of eight facets above and below, its point at the origin; gives the mesh's number."""
    low, high = RADIUS * math.tan(PAVILION), RADIUS * (math.tan(PAVILION) + (1 - TABLE) * math.tan(CROWN))
    turn = 2 * math.pi * (np.arange(SIDES) + 0.5) / SIDES
    ring = np.stack([np.cos(turn), np.zeros(SIDES), np.sin(turn)], axis=-1) * RADIUS
    points = np.concatenate([[[0, 0, 0]], ring + (0, low, 0), ring * TABLE + (0, high, 0), [[0, high, 0]]])
    faces = []
    for side in range(SIDES):
        a, b = 1 + side, 1 + (side + 1) % SIDES
        faces += [(0, a, b), (a, a + SIDES, b + SIDES), (a, b + SIDES, b), (a + SIDES, 2 * SIDES + 1, b + SIDES)]
    return scene.add_mesh(points.astype("f4"), np.array(faces, "i4"))


def build() -> gonio.Scene:
    """Stones that lie on a white table, a small lamp behind them and a dim sky around."""
    scene = gonio.Scene()
    table = scene.add_material("table", base_color=0.7, specular_weight=0.0)
    quad(scene, [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)], table)
    stone = cut(scene)
    # A facet's middle line lies at the pavilion's slope over half a side's angle.
    lean = math.atan(math.tan(PAVILION) / math.cos(math.pi / SIDES))
    cos, sin = math.cos(lean), math.sin(lean)
    for number, glass in enumerate(GLASSES):
        material = scene.add_material(glass, glass=glass, specular_roughness=0.0)
        x = (number - 0.5 * (len(GLASSES) - 1)) * APART
        scene.add_instance(stone, [material], transform=[[1, 0, 0, x], [0, cos, -sin, 0.001], [0, sin, cos, 0], [0, 0, 0, 1]])
    scene.add_light("sphere", (900_000.0,) * 3, radius=0.008, transform=[[1, 0, 0, 0.0], [0, 1, 0, 1.1], [0, 0, 1, -0.7], [0, 0, 0, 1]])
    scene.add_light("dome", (6.0,) * 3)
    scene.set(width=960, height=280)
    scene.add_camera(gonio.look_at((0.0, 1.1, 1.5), (0.0, 0.02, 0.02)), fov=8.6)
    return scene


def main() -> None:
    scene = build()
    scene.set(samples=96, spectral=True, caustics="on")
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "glasses.png", exposure=1.3)


if __name__ == "__main__":
    main()

"""Balls of eight metals under daylight or a lamp's spectrum: `python metals.py metals.png`, `python metals.py metals.png LED-B3`."""

import math
import sys

import gonio
import numpy as np
from shapes import finished, lathe, quad

METALS = ("silver", "aluminium", "chromium", "iron", "titanium", "brass", "copper", "gold")
RADIUS, APART = 0.05, 0.12


def build(spectrum: str) -> gonio.Scene:
    """A row of balls on a grey table, a window before them and a dim sky around."""
    scene = gonio.Scene()
    table = scene.add_material("table", base_color=0.18, specular_weight=0.0)
    quad(scene, [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)], table)
    profile = [(RADIUS * math.sin(angle), RADIUS - RADIUS * math.cos(angle)) for angle in np.linspace(0.0, math.pi, 97)]
    ball = lathe(scene, profile)
    for number, metal in enumerate(METALS):
        material = scene.add_material(metal, metal=metal, specular_roughness=0.15)
        x = (number - 0.5 * (len(METALS) - 1)) * APART
        scene.add_instance(ball, [material], transform=[[1, 0, 0, x], [0, 1, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    window = gonio.look_at((-0.6, 1.0, 0.8), (0.0, 0.0, 0.0))
    scene.add_light("rectangle", (3000.0,) * 3, width=0.9, height=0.6, transform=window, spectrum=spectrum)
    scene.add_light("dome", (250.0,) * 3, spectrum=spectrum)
    scene.set(width=960, height=280)
    scene.add_camera(gonio.look_at((0.0, 0.45, 1.35), (0.0, 0.04, 0.0)), fov=12.0)
    return scene


def main() -> None:
    scene = build(sys.argv[2] if len(sys.argv) > 2 else "D65")
    scene.set(samples=64, spectral=True)
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "metals.png", exposure=0.3)


if __name__ == "__main__":
    main()

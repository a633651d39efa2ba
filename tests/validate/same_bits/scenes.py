"""Twelve small scenes that together reach what the engine can do: `scenes.py FOLDER` saves each as a bundle of its name."""

import sys
from pathlib import Path

import gonio
import light_scenes as light
import surface_scenes as surface

LIGHT = [light.room, light.groups, light.catcher, light.lamps, light.daylight, light.crowd]
SURFACE = [surface.skin, surface.mixes, surface.glass, surface.measured, surface.whitted, surface.adaptive]


def main(folder):
    for build in LIGHT + SURFACE:
        scene = gonio.Scene()
        build(scene)
        scene.save(Path(folder) / build.__name__)


if __name__ == "__main__":
    main(sys.argv[1])

"""A slit of sunlight through a prism of glass onto a screen: `python prism.py prism.png`."""

import sys
from math import cos, radians, sin
from typing import Any

import gonio
import numpy as np

# Index at 587.56 nm and Abbe number: more dispersion than dense flint, so that the colours lie far apart.
INDEX, ABBE = 1.6, 15.0
# Half the least deviation of light through an angle of 60° by that index, and half the slit in metres.
HALF_DEVIATION, HALF_SLIT = radians(23.13), 0.015
QUAD = np.array([[0, 1, 2], [0, 2, 3]], np.int32)
Array = np.ndarray[Any, np.dtype[np.float64]]


def quad(centre: Array, u: Array, v: Array) -> Array:
    """Corners of a parallelogram by its middle and half its sides."""
    return np.array([centre - u - v, centre + u - v, centre + u + v, centre - u + v])


def add_prism(scene: gonio.Scene) -> None:
    """Three sides of 1 m, 2 m long, about the origin; its edges lie along y."""
    section = ((-0.5, -0.2887), (0.5, -0.2887), (0.0, 0.5774))
    points = np.array([[x, y, z] for y in (-1.0, 1.0) for x, z in section])
    # Fronts look outwards.
    faces = np.array([[0, 1, 2], [3, 5, 4], [0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [2, 5, 3], [2, 3, 0]], np.int32)
    glass = scene.add_material("glass", transmission_weight=1.0, specular_roughness=0.0, specular_ior=INDEX, transmission_dispersion=1.0 / ABBE)
    scene.add_instance(scene.add_mesh(points, faces), [glass])


def build() -> gonio.Scene:
    """The sun, a slit, the prism and a screen that the camera looks at."""
    scene = gonio.Scene()
    add_prism(scene)
    upwards, downwards = (np.array([cos(HALF_DEVIATION), 0.0, sign * sin(HALF_DEVIATION)]) for sign in (1.0, -1.0))
    along = np.array([0.0, 1.0, 0.0])
    black = scene.add_material("black", base_color=0.0, specular_weight=0.0)
    white = scene.add_material("white", base_color=0.8, specular_weight=0.0)
    before = np.array([-0.25, 0.0, 0.1443]) - 0.6 * upwards
    across = np.cross(upwards, along)
    for side in (1.0, -1.0):
        # Plates so wide that no sun passes them but by the slit.
        plate = quad(before + side * (HALF_SLIT + 20.0) * across, 20.0 * side * across, 24.0 * along)
        scene.add_instance(scene.add_mesh(plate, QUAD), [black])
    screen, upright = np.array([0.25, 0.0, 0.1443]) + 3.0 * downwards, np.cross(along, -downwards)
    scene.add_instance(scene.add_mesh(quad(screen, 0.6 * upright, 0.9 * along), QUAD), [white])
    sun = np.eye(4)
    sun[:3, 0], sun[:3, 1], sun[:3, 2] = along, np.cross(-upwards, along), -upwards
    scene.add_light("distant", (20_000.0,) * 3, angle=0.05, transform=sun.tolist())
    seen_from = screen - 2.2 * downwards + 0.3 * upright
    scene.add_camera(gonio.look_at(seen_from.tolist(), screen.tolist(), up=upright.tolist()), fov=26.0)
    return scene


def main() -> None:
    scene = build()
    scene.set(width=480, height=360, samples=512, spectral=True, caustics="on")
    with gonio.Render(scene) as rendering:
        rendering.wait()
        rendering.film().write_picture(sys.argv[1] if len(sys.argv) > 1 else "prism.png", adapted=1500.0)


if __name__ == "__main__":
    main()

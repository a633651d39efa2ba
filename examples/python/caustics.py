"""What two glasses and a brass ring do with the light of one small lamp: `python caustics.py caustics.png`."""

import sys

import gonio
import numpy
from shapes import at, finished, lathe, noise, quad, round_profile


def table(scene: gonio.Scene) -> None:
    """A pale tablecloth that goes up behind."""
    linen = scene.add_texture((0.72 + 0.06 * noise(256, 256, 32, 2, 2)).astype("f4"), colour_space="raw", tiles=(10, 10))
    cloth = scene.add_material(base_color=linen, specular_weight=0.0)
    quad(scene, [(-1.2, 0, 0.8), (1.2, 0, 0.8), (1.2, 0, -1.0), (-1.2, 0, -1.0)], cloth)
    wall = scene.add_material(base_color=(0.1, 0.12, 0.14), specular_weight=0.0)
    quad(scene, [(-2, -1, -1.0), (2, -1, -1.0), (2, 2, -1.0), (-2, 2, -1.0)], wall)


def tumbler(scene: gonio.Scene) -> int:
    """A thick glass, outside and inside in one closed profile."""
    return lathe(scene, [(0.0, 0.0), *[(0.034, 0.0), (0.036, 0.002), (0.041, 0.095), (0.0408, 0.0965), (0.0385, 0.095), (0.0335, 0.016), (0.03, 0.0125)], (0.0, 0.012)], 160)


def goblet(scene: gonio.Scene) -> int:
    """A wine glass on a stem: its outside up, its inside down."""
    outside = round_profile([(0.0, 0.0), (0.034, 0.001), (0.02, 0.004), (0.005, 0.012), (0.004, 0.06), (0.007, 0.078), (0.03, 0.1), (0.04, 0.13), (0.037, 0.165), (0.033, 0.185)])
    inside = round_profile([(0.032, 0.185), (0.036, 0.165), (0.039, 0.13), (0.029, 0.102), (0.012, 0.088), (0.0, 0.085)])
    return lathe(scene, [*outside, *inside], 160)


def wine(scene: gonio.Scene) -> int:
    """What is in it: a body of its own, a hair's breadth within the glass."""
    profile = round_profile([(0.0, 0.0855), (0.0115, 0.0885), (0.0285, 0.1025), (0.0383, 0.13)])
    return lathe(scene, [*profile, (0.0, 0.13)], 160)


def main() -> None:
    """Writes the picture."""
    scene = gonio.Scene()
    table(scene)
    clear = scene.add_material(transmission_weight=1.0, specular_roughness=0.0, specular_ior=1.52)
    green = scene.add_material(transmission_weight=1.0, specular_roughness=0.0, specular_ior=1.52, transmission_color=(0.25, 0.78, 0.55), transmission_depth=0.02)
    red = scene.add_material(transmission_weight=1.0, specular_roughness=0.0, specular_ior=1.34, transmission_color=(0.75, 0.09, 0.08), transmission_depth=0.035)
    brass = scene.add_material(metalness=1.0, base_color=(0.93, 0.69, 0.32), specular_roughness=0.0)
    scene.add_instance(tumbler(scene), [green], transform=at(0.03, 0.0005, 0.14))
    scene.add_instance(goblet(scene), [clear], transform=at(0.1, 0.0005, -0.05))
    scene.add_instance(wine(scene), [red], transform=at(0.1, 0.0005, -0.05))
    ring = lathe(scene, [(0.065, 0.0), (0.065, 0.027), (0.0635, 0.028), (0.062, 0.027), (0.062, 0.0)], 200)
    scene.add_instance(ring, [brass], transform=at(-0.13, 0.0005, -0.02))
    # One lamp, low and to the left, and a breath of dusk.
    scene.add_light("sphere", lumens=700.0, temperature=4200.0, radius=0.006, transform=at(-0.8, 0.38, -0.2), visible=False)
    scene.add_light("dome", (0.7, 0.95, 1.5), visible=False)
    scene.set(width=960, height=600, samples=48, caustics="on", max_bounces=14)
    scene.add_camera(gonio.look_at((0.1, 0.54, 0.62), (0.06, 0.055, 0.03)), fov=28)
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "caustics.png", exposure=0.45)


if __name__ == "__main__":
    main()

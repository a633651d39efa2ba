"""A table at night with glass balls, focused by a fast lens; behind, lamps are discs: `python depth_of_field.py depth_of_field.png`."""

import sys

import gonio
import numpy
from shapes import at, finished, lathe, noise, put_box, quad, round_profile


def table(scene: gonio.Scene) -> None:
    """Dark boards with a varnish that is a little worn."""
    grain = noise(64, 1024, 6, 41)
    wood = numpy.stack([0.11 + 0.09 * grain, 0.055 + 0.045 * grain, 0.03 + 0.02 * grain], axis=-1).astype("f4")
    board = scene.add_material(
        base_color=scene.add_texture(wood, colour_space="lin_rec709", tiles=(1, 5)),
        specular_roughness=scene.add_texture((0.16 + 0.2 * noise(256, 256, 10, 43)).astype("f4"), colour_space="raw", tiles=(3, 3)),
    )
    quad(scene, [(-0.8, 0, 0.5), (0.8, 0, 0.5), (0.8, 0, -0.75), (-0.8, 0, -0.75)], board)


def candle(scene: gonio.Scene, x: float, z: float, height: float) -> None:
    """Wax that glows below its flame, in a brass dish."""
    wax = scene.add_material(base_color=(0.8, 0.74, 0.62), subsurface_weight=1.0, subsurface_color=(0.85, 0.7, 0.5), subsurface_radius=(0.012, 0.006, 0.003), specular_roughness=0.4)
    brass = scene.add_material(metalness=1.0, base_color=(0.85, 0.62, 0.3), specular_roughness=0.25)
    body = lathe(scene, [(0.0, 0.004), (0.021, 0.004), (0.021, 0.01), (0.021, height - 0.004), (0.019, height), (0.006, height - 0.003), (0.0, height - 0.004)], 64)
    scene.add_instance(body, [wax], transform=at(x, 0, z))
    dish = lathe(scene, round_profile([(0.0, 0.001), (0.034, 0.001), (0.042, 0.008), (0.04, 0.009), (0.032, 0.004), (0.0, 0.004)], 6), 96)
    scene.add_instance(dish, [brass], transform=at(x, 0, z))
    # A flame of about 12 lm.
    flame = scene.add_material(base_color=(0, 0, 0), emission_color=(24000.0, 13500.0, 5200.0))
    shape = lathe(scene, round_profile([(0.0, 0.0), (0.0042, 0.006), (0.0036, 0.014), (0.0, 0.028)], 8), 32)
    scene.add_instance(shape, [flame], transform=at(x, height + 0.004, z))


def main() -> None:
    """Writes the picture."""
    scene = gonio.Scene()
    table(scene)
    glasses = [
        scene.add_material(transmission_weight=1.0, specular_roughness=0.0, transmission_color=colour, transmission_depth=0.05)
        for colour in ((1.0, 1.0, 1.0), (0.95, 0.55, 0.2), (0.3, 0.65, 0.9), (0.45, 0.85, 0.5))
    ]
    ball = scene.add_points(numpy.zeros((1, 3), "f4"), 1.0)
    for x, z, size, glass in ((-0.015, 0.0, 0.07, 0), (0.075, -0.055, 0.056, 1), (-0.1, -0.07, 0.06, 2), (0.15, 0.06, 0.048, 3), (-0.135, 0.085, 0.042, 1), (0.2, -0.2, 0.064, 0)):
        transform = numpy.diag([size, size, size, 1.0])
        transform[:3, 3] = x, size / 2 + 0.0004, z
        scene.add_instance(points=ball, materials=[glasses[glass]], transform=transform)
    candle(scene, -0.26, -0.26, 0.11)
    candle(scene, 0.05, -0.36, 0.075)
    # A string of small lamps far behind, and windows beyond.
    random = numpy.random.default_rng(12)
    colours = ((1.0, 0.62, 0.28), (1.0, 0.78, 0.5), (0.55, 0.75, 1.0), (1.0, 0.45, 0.3))
    lamp = scene.add_points(numpy.zeros((1, 3), "f4"), 0.022)
    for number in range(56):
        strength = 1300.0 * random.uniform(0.4, 1.3)
        bulb = scene.add_material(base_color=(0, 0, 0), emission_color=[strength * part for part in colours[number % 4]])
        place = (random.uniform(-1.5, 1.5), random.uniform(-0.1, 0.6), random.uniform(-3.4, -2.2))
        scene.add_instance(points=lamp, materials=[bulb], transform=at(*place))
    dusk = scene.add_material(base_color=(0.02, 0.025, 0.04), specular_weight=0.0)
    quad(scene, [(-6, -2, -5), (6, -2, -5), (6, 4, -5), (-6, 4, -5)], dusk)
    pane = scene.add_material(base_color=(0, 0, 0), emission_color=(1.5, 0.8, 0.3))
    for x in (-1.9, 0.75):
        put_box(scene, (x, 0.25, -4.9), (x + 0.8, 1.6, -4.85), pane)
    scene.add_light("rectangle", lumens=28.0, temperature=4200.0, width=0.3, height=0.3, transform=gonio.look_at((-0.5, 0.5, 0.35), (0, 0, 0)), visible=False)
    scene.set(width=960, height=600, samples=40, max_bounces=14, clamp_indirect=60.0)
    camera = gonio.look_at((0.03, 0.125, 0.47), (0.012, 0.05, -0.05))
    scene.add_camera(camera, fov=25)
    described = scene.to_dict()["cameras"][0]
    # A lens of 35 mm at f/1.4 on the ball in the middle.
    scene.put_camera({**described, "lens_radius": 0.0115, "focus_distance": 0.455}, 0, fixed_aperture=False)
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "depth_of_field.png", exposure=0.2, apart=False)


if __name__ == "__main__":
    main()

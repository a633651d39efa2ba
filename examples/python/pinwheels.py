"""Pinwheels in the evening sun, which the shutter blurs: `python pinwheels.py pinwheels.png`."""

import sys

import gonio
import numpy
from shapes import finished, quad

COLOURS = ((0.72, 0.06, 0.05), (0.85, 0.42, 0.03), (0.06, 0.3, 0.55), (0.75, 0.7, 0.62), (0.08, 0.4, 0.26), (0.5, 0.06, 0.3))
KEYS = 5


def wheel(scene: gonio.Scene) -> int:
    """Eight curled sails about z, each of a flat and a bent half."""
    points, triangles = [], []
    for sail in range(8):
        angle = numpy.radians(45.0 * sail)
        for k in range(9):
            part = k / 8
            bend = angle + numpy.radians(52.0) * part
            outer = 0.3 * (1.0 - 0.35 * part**2)
            lift = 0.075 * numpy.sin(numpy.pi * min(part * 1.15, 1.0)) * 1.2
            points += [(0.012 * numpy.cos(angle), 0.012 * numpy.sin(angle), 0.02 * part), (outer * numpy.cos(bend), outer * numpy.sin(bend), lift)]
        first = 18 * sail
        triangles += [face for k in range(0, 16, 2) for face in ((first + k, first + k + 1, first + k + 3), (first + k, first + k + 3, first + k + 2))]
    return scene.add_mesh(numpy.array(points, "f4"), numpy.array(triangles, "i4"))


def pose(place: tuple[float, float, float], facing: float, turn: float) -> list[list[float]]:
    """A turn about the wheel's axle, which faces so many degrees off +z."""
    c, s = numpy.cos(numpy.radians(turn)), numpy.sin(numpy.radians(turn))
    spin = numpy.array([[c, -s, 0, 0], [s, c, 0, 0], [0, 0, 1, 0], [0, 0, 0, 1]])
    c, s = numpy.cos(numpy.radians(facing)), numpy.sin(numpy.radians(facing))
    matrix = numpy.array([[c, 0, s, place[0]], [0, 1, 0, place[1]], [-s, 0, c, place[2]], [0, 0, 0, 1]]) @ spin
    rows: list[list[float]] = matrix.tolist()
    return rows


def meadow(scene: gonio.Scene) -> None:
    """Ground, and blades of grass that stand in the sun."""
    random = numpy.random.default_rng(8)
    earth = scene.add_material(base_color=(0.11, 0.15, 0.04), specular_weight=0.0)
    quad(scene, [(-900, 0, 6), (900, 0, 6), (900, 0, -900), (-900, 0, -900)], earth)
    # Where no blades stand any more, the ground is as bright as they are from afar.
    afar = scene.add_material(base_color=(0.22, 0.29, 0.08), specular_weight=0.0)
    quad(scene, [(-900, 0.01, -20), (900, 0.01, -20), (900, 0.01, -900), (-900, 0.01, -900)], afar)
    count = 60_000
    z = 2.6 - 26.0 * random.random(count) ** 1.6
    root = numpy.stack([random.uniform(-1, 1, count) * (2.5 + 0.62 * (3.0 - z)), 0 * z, z], axis=-1)
    height = random.uniform(0.07, 0.2, count)[:, None]
    lean = numpy.stack([random.normal(0.35, 0.3, count), 0 * z + 1.0, random.normal(0, 0.3, count)], axis=-1)
    middle = root + 0.55 * height * numpy.array([0.15, 1.0, 0.0]) * (0.6 + 0.4 * lean)
    points = numpy.stack([root, middle, root + height * lean], axis=1).astype("f4")
    widths = numpy.tile(numpy.array([0.0042, 0.0032, 0.0006], "f4"), count)
    grass = scene.add_material(base_color=(0.16, 0.24, 0.04), subsurface_weight=0.0, specular_roughness=0.45)
    curves = scene.add_curves(points.reshape(-1, 3), numpy.full(count, 3, "i4"), widths, type="linear", shape="ribbon")
    scene.add_instance(curves=curves, materials=[grass])


def main() -> None:
    """Writes the picture."""
    scene = gonio.Scene()
    meadow(scene)
    day = gonio.daylight(48.21, 16.37, "2025-08-12T18:05+02:00", ground=0.15)
    # South is +z: the sun stands in the west-north-west, behind the wheels on the right.
    scene.add_daylight(day, up="Y", north=-65.0)
    random = numpy.random.default_rng(5)
    mesh = wheel(scene)
    wood = scene.add_material(base_color=(0.5, 0.36, 0.2), specular_roughness=0.5)
    hub = scene.add_points(numpy.zeros((1, 3), "f4"), 0.045)
    row = [(x, 0.95 + random.uniform(-0.14, 0.16), 0.5 - 0.75 * k - random.uniform(0, 0.4)) for k, x in enumerate((-1.05, -0.3, 0.62, -1.5, 1.6, 0.15, -2.7, 2.9, 1.0))]
    for number, place in enumerate(row):
        sails = scene.add_material(base_color=COLOURS[number % len(COLOURS)], specular_roughness=0.3)
        facing, start, speed = random.uniform(-25, 30), random.uniform(0, 45), random.uniform(14, 46) if number != 1 else 0.0
        turns = [pose(place, facing, start - speed * key / (KEYS - 1)) for key in range(KEYS)]
        scene.add_instance(mesh, [sails], motion=turns)
        scene.add_instance(points=hub, materials=[wood], transform=turns[0])
        stick = numpy.array([(place[0], 0, place[2] - 0.02), (place[0], place[1], place[2] - 0.02)], "f4")
        scene.add_instance(curves=scene.add_curves(stick, numpy.array([2], "i4"), 0.018), materials=[wood])
    scene.set(width=960, height=600, samples=48, motion_blur=True)
    scene.add_camera(gonio.look_at((0.04, 0.62, 4.1), (-0.02, 0.86, 0.0)), fov=25)
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "pinwheels.png", exposure=1.1)


if __name__ == "__main__":
    main()

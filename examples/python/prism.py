"""A slit of sunlight through a prism of glass, on a white table: `python prism.py prism.png`."""

import sys
from math import cos, radians, sin, tan

import gonio
import numpy
from shapes import finished, put_box, quad

# Index at 587.56 nm and Abbe number: more dispersion than dense flint, so that the colours lie far apart.
INDEX, ABBE = 1.6, 15.0
# The prism's sides and height, the slit's width and height, the plates' height and how high the sun stands; metres.
SIDE, TALL, SLIT, OPEN, PLATE, ELEVATION = 0.3, 0.18, 0.012, 0.15, 0.45, radians(6.0)
# Half the least deviation of light through an angle of 60° by that index.
HALF_DEVIATION = radians(23.13)


def add_prism(scene: gonio.Scene) -> None:
    """Upright about the y axis, one edge towards -z."""
    section = [(SIDE / 3**0.5 * sin(radians(turn)), -SIDE / 3**0.5 * cos(radians(turn))) for turn in (0.0, 120.0, 240.0)]
    points = numpy.array([[x, y, z] for y in (0.001, TALL) for x, z in section], "f4")
    # Fronts look outwards.
    faces = numpy.array([[0, 1, 2], [3, 5, 4], [0, 3, 4], [0, 4, 1], [1, 4, 5], [1, 5, 2], [2, 5, 3], [2, 3, 0]], "i4")
    glass = scene.add_material("glass", transmission_weight=1.0, specular_roughness=0.0, specular_ior=INDEX, transmission_dispersion=1.0 / ABBE)
    scene.add_instance(scene.add_mesh(points, faces), [glass])


def add_slit(scene: gonio.Scene) -> None:
    """Two plates with a gap, across the way of light that then meets the prism's middle."""
    way = numpy.array([cos(HALF_DEVIATION), 0.0, -sin(HALF_DEVIATION)])
    turn = [[way[0], 0, -way[2], 0], [0, 1, 0, 0], [way[2], 0, way[0], 0], [0, 0, 0, 1]]
    middle = numpy.array([-SIDE / 4, 0.0, -SIDE / 3**0.5 / 4]) - 0.62 * way
    turn[0][3], turn[2][3] = middle[0], middle[2]
    black = scene.add_material("black", base_color=0.02, specular_roughness=0.5)
    for side in (-1.0, 1.0):
        low, high = sorted((side * SLIT / 2, side * 3.0))
        put_box(scene, (-0.008, 0.0, low), (0.008, PLATE, high), black, turn)
    put_box(scene, (-0.008, OPEN, -SLIT / 2), (0.008, PLATE, SLIT / 2), black, turn)
    towards = way - numpy.array([0.0, tan(ELEVATION), 0.0])
    scene.add_light("distant", lux=(60_000.0, 1.0), angle=0.3, transform=gonio.look_at((0, 0, 0), towards.tolist()))


def main() -> None:
    """Writes the picture."""
    scene = gonio.Scene()
    white = scene.add_material("white", base_color=0.8, specular_weight=0.0)
    quad(scene, [(-3, 0, 3), (3, 0, 3), (3, 0, -3), (-3, 0, -3)], white)
    add_prism(scene)
    add_slit(scene)
    scene.add_light("dome", (9.0, 10.0, 12.0))
    # What shows the glass: a pale screen behind that its sides mirror.
    scene.add_light("rectangle", (110.0, 115.0, 130.0), width=1.2, height=0.35, transform=gonio.look_at((-0.1, 0.35, -1.0), (0, 0.1, 0)), visible=False)
    scene.set(width=960, height=600, samples=128, spectral=True, caustics="on")
    scene.add_camera(gonio.look_at((0.42, 0.5, 0.86), (0.25, 0.03, 0.03)), fov=37.0)
    # An eye that is used to a dim room.
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "prism.png", adapted=80.0, apart=False)


if __name__ == "__main__":
    main()

"""The Cornell box from numpy arrays: `python cornell_box.py cornell_box.png`."""

import sys

import gonio
import numpy
from shapes import finished

SIZE = 0.55
WHITE, RED, GREEN = (0.73, 0.73, 0.73), (0.61, 0.06, 0.06), (0.12, 0.45, 0.15)


def place(x: float, y: float, z: float, degrees: float = 0.0) -> list[list[float]]:
    """A translation after a turn about y, for column vectors."""
    cosine, sine = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
    return [[cosine, 0, sine, x], [0, 1, 0, y], [-sine, 0, cosine, z], [0, 0, 0, 1]]


def add_quad(scene: gonio.Scene, corners: list[tuple[float, float, float]], material: int) -> None:
    """A flat quadrilateral."""
    mesh = scene.add_mesh(numpy.array(corners, "f4"), numpy.array([[0, 1, 2], [0, 2, 3]], "i4"))
    scene.add_instance(mesh, [material])


def add_block(scene: gonio.Scene, size: tuple[float, float, float], transform: list[list[float]], material: int) -> None:
    """A box that stands on y = 0."""
    corners = numpy.array([(x, y, z) for x in (-0.5, 0.5) for y in (0, 1) for z in (-0.5, 0.5)], "f4") * numpy.array(size, "f4")
    sides = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [triangle for a, b, c, d in sides for triangle in ((a, b, c), (a, c, d))]
    scene.add_instance(scene.add_mesh(corners, numpy.array(triangles, "i4")), [material], transform=transform)


def cornell_box() -> gonio.Scene:
    """The box, its two blocks, its lamp of 1500 cd/m² and its camera."""
    scene = gonio.Scene()
    scene.set(width=600, height=600, samples=128)
    white, red, green = (scene.add_material(base_color=colour, specular_weight=0.0) for colour in (WHITE, RED, GREEN))
    h, s = SIZE / 2, SIZE
    add_quad(scene, [(-h, 0, h), (h, 0, h), (h, 0, -h), (-h, 0, -h)], white)
    add_quad(scene, [(-h, s, -h), (h, s, -h), (h, s, h), (-h, s, h)], white)
    add_quad(scene, [(-h, 0, -h), (h, 0, -h), (h, s, -h), (-h, s, -h)], white)
    add_quad(scene, [(-h, 0, h), (-h, 0, -h), (-h, s, -h), (-h, s, h)], red)
    add_quad(scene, [(h, 0, -h), (h, 0, h), (h, s, h), (h, s, -h)], green)
    add_block(scene, (0.165, 0.165, 0.165), place(0.09, 0, 0.08, -17), white)
    add_block(scene, (0.165, 0.33, 0.165), place(-0.09, 0, -0.09, 20), white)
    # Flat lights shine along their -z, here turned downwards.
    down = gonio.look_at((0, SIZE - 0.001, 0), (0, 0, 0), (0, 0, -1))
    scene.add_light("rectangle", (1500.0, 1230.0, 840.0), width=0.13, height=0.105, transform=down)
    scene.add_camera(place(0, SIZE / 2, 1.045), fov=39.0)
    return scene


def main() -> None:
    """Renders the box into the file that the command line names."""
    finished(cornell_box(), sys.argv[1] if len(sys.argv) > 1 else "cornell_box.png", exposure=0.5)


if __name__ == "__main__":
    main()

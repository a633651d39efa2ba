"""A wall whose relief is displacement, grazed by wall washers from above: `python relief_wall.py relief_wall.png`."""

import sys

import gonio
import numpy
from numpy.typing import NDArray
from shapes import at, finished, lathe, noise, put_box, quad, round_profile

WIDTH, HEIGHT, DEPTH = 5.0, 2.9, 3.4
# Metres from the lowest to the highest place of the relief.
RELIEF = 0.09


def waves() -> NDArray[numpy.float32]:
    """Heights from 0 to 1: dunes with ridges that wander, and the grain of the sand."""
    rows, columns = 768, 1024
    y, x = numpy.mgrid[0:rows, 0:columns] / rows
    drift = 1.1 * noise(rows, columns, 3, 21) + 0.35 * noise(rows, columns, 7, 22)
    phase = 9.0 * (y + 0.42 * x) + 3.2 * drift
    ridge = phase - numpy.floor(phase)
    dune = numpy.where(ridge < 0.68, ridge / 0.68, (1 - ridge) / 0.32)
    heights: NDArray[numpy.float32] = (dune**1.3 * 0.95 + 0.05 * noise(rows, columns, 90, 23, 2)).astype("f4")
    return heights


def relief(scene: gonio.Scene) -> None:
    """The wall: a flat mesh that is cut to half a pixel and moved along its normals by a texture."""
    texture = scene.add_texture(waves(), colour_space="raw")
    lookup = texture.nodes(0)
    plaster = [("base_color", {"Constant": [0.66, 0.62, 0.57, 1.0]}), ("specular_weight", {"Constant": [0.0] * 4})]
    moved = {"value": {"Node": [len(lookup) - 1, "R"]}, "kind": "Height", "midlevel": 0.0, "scale": RELIEF}
    material = scene.put_material({"origin": "relief", "closures": [{"parameters": plaster}], "graph": {"nodes": lookup}, "displacement": moved})
    w = WIDTH / 2
    points = numpy.array([(-w, 0, 0), (w, 0, 0), (w, HEIGHT, 0), (-w, HEIGHT, 0)], "f4")
    uvs = numpy.array([[0, 0], [1, 0], [1, 1], [0, 1]], "f4")
    wall = scene.add_mesh(points, numpy.array([[0, 1, 2], [0, 2, 3]], "i4"), uvs=uvs)
    scene.set_dicing(wall, pixels=1.0)
    scene.add_instance(wall, [material])


def room(scene: gonio.Scene) -> None:
    """Floor, ceiling with a slot for the lamps, side walls, and a bench."""
    w = WIDTH / 2
    oak = numpy.stack([0.2 + 0.06 * noise(256, 256, 4, 31), 0.12 + 0.03 * noise(256, 256, 4, 32), 0.075 + 0.02 * noise(256, 256, 4, 33)], axis=-1)
    floor = scene.add_material(base_color=scene.add_texture(oak.astype("f4"), colour_space="lin_rec709", tiles=(6, 1)), specular_roughness=0.28)
    dark = scene.add_material(base_color=(0.16, 0.15, 0.145), specular_weight=0.0)
    white = scene.add_material(base_color=(0.62, 0.6, 0.57), specular_weight=0.0)
    quad(scene, [(-w, 0, DEPTH), (w, 0, DEPTH), (w, 0, 0), (-w, 0, 0)], floor)
    quad(scene, [(-w, HEIGHT - 0.15, 0.42), (w, HEIGHT - 0.15, 0.42), (w, HEIGHT - 0.15, DEPTH), (-w, HEIGHT - 0.15, DEPTH)], white)
    quad(scene, [(-w, HEIGHT - 0.15, 0.42), (-w, HEIGHT, 0.42), (w, HEIGHT, 0.42), (w, HEIGHT - 0.15, 0.42)], white)
    quad(scene, [(-w, 0, 0), (-w, HEIGHT, 0), (-w, HEIGHT, DEPTH), (-w, 0, DEPTH)], dark)
    quad(scene, [(w, 0, 0), (w, 0, DEPTH), (w, HEIGHT, DEPTH), (w, HEIGHT, 0)], dark)
    leather = scene.add_material(base_color=(0.09, 0.045, 0.025), specular_roughness=0.4)
    put_box(scene, (-0.9, 0.36, 0.95), (0.9, 0.46, 1.4), leather)
    iron = scene.add_material(base_color=(0.02, 0.02, 0.02), specular_roughness=0.5)
    for x in (-0.75, 0.75):
        put_box(scene, (x - 0.03, 0, 1.0), (x + 0.03, 0.36, 1.35), iron)
    profile = round_profile([(0.0, 0.0), (0.12, 0.0), (0.17, 0.16), (0.13, 0.36), (0.055, 0.48), (0.075, 0.56)])
    glaze = scene.add_material(base_color=(0.05, 0.12, 0.14), specular_roughness=0.12)
    scene.add_instance(lathe(scene, profile), [glaze], transform=at(1.55, 0, 0.85))


def main() -> None:
    """Writes the picture."""
    scene = gonio.Scene()
    relief(scene)
    room(scene)
    for x in (-1.8, -0.6, 0.6, 1.8):
        aim = gonio.look_at((x, HEIGHT - 0.06, 0.26), (x, 0.9, 0.02), (0, 0, 1))
        scene.add_light("disk", lumens=620.0, temperature=4000.0, radius=0.025, spot=(46.0, 0.9), transform=aim, visible=False)
    # The room's other light, turned low.
    scene.add_light("rectangle", lumens=240.0, temperature=3500.0, width=2.0, height=0.4, transform=gonio.look_at((0, 2.6, 3.2), (0, 0, 2.4)), visible=False)
    scene.set(width=960, height=600, samples=40)
    scene.add_camera(gonio.look_at((-0.65, 1.42, 4.55), (0.05, 1.28, 0)), fov=38)
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "relief_wall.png", exposure=0.3)


if __name__ == "__main__":
    main()

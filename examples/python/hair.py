"""A braid of nine thousand hairs, lit from behind: `python hair.py hair.png`."""

import sys

import gonio
import numpy
from numpy.typing import NDArray
from shapes import finished, quad

HAIRS, JOINTS, WIDTH = 3_000, 40, 0.0003
# What a strand's pigment is times: hair is never of one colour.
TINTS = (0.5, 0.8, 1.1, 1.9)
LENGTH, LOCK = 0.34, 0.021


def middle(t: NDArray[numpy.float64], lock: int) -> NDArray[numpy.float64]:
    """Where a lock's middle runs, (..., 3) by metres along the braid: from side to side, and over and under the others."""
    turn = 2 * numpy.pi * (t / 0.105 + lock / 3)
    # Above the braid's beginning the locks come together; below its end they part.
    wide = 0.026 * (1 - 0.3 * t / LENGTH)
    return numpy.stack([wide * numpy.sin(turn), -t, 0.5 * wide * numpy.sin(2 * turn)], axis=-1)


def strands(lock: int) -> NDArray[numpy.float64]:
    """Points (hairs, joints, 3) of a lock: around its middle, twisted, a few of them loose."""
    random = numpy.random.default_rng(40 + lock)
    t = numpy.linspace(-0.06, LENGTH, JOINTS)
    centre = middle(t, lock)
    along = numpy.gradient(centre, axis=0)
    along /= numpy.linalg.norm(along, axis=-1, keepdims=True)
    right = numpy.cross(along, [0.0, 0.0, 1.0])
    right /= numpy.linalg.norm(right, axis=-1, keepdims=True)
    front = numpy.cross(right, along)
    radius = LOCK * numpy.sqrt(random.random(HAIRS)) * (1 + 0.04 * random.standard_normal(HAIRS))
    angle = random.uniform(0, 2 * numpy.pi, HAIRS)
    loose = random.random(HAIRS) < 0.025
    radius = numpy.where(loose, radius * random.uniform(1.05, 1.5, HAIRS), radius)
    # A lock is flat where it is pressed, and thins towards its end.
    size = (1 - 0.35 * numpy.clip(t, 0, None) / LENGTH)[None, :]
    turned = angle[:, None] + 1.4 * t[None, :] / 0.1 + 0.35 * numpy.sin(26 * t[None, :] + 9 * angle[:, None]) * loose[:, None]
    wander = 1 + 0.06 * numpy.sin(90 * t[None, :] + 40 * angle[:, None])
    across, down = (radius[:, None] * size * wander * function(turned) for function in (numpy.cos, numpy.sin))
    return centre + across[..., None] * right + 0.62 * down[..., None] * front


def hair(scene: gonio.Scene, absorption: list[float]) -> int:
    """Hair after Chiang et al. 2016; absorption by one over the radius."""
    constants = {
        "hair_absorption": [*absorption, 1.0],
        "hair_variance": [0.006, 0.0015, 0.024, 1.0],
        "hair_scale": [0.26, 0.26, 0.26, 1.0],
        "hair_tilt": [0.045] * 4,
        "specular_ior": [1.55] * 4,
    }
    parameters = [(name, {"Constant": value}) for name, value in constants.items()]
    return scene.put_material({"origin": "hair", "closures": [{"model": "Hair", "parameters": parameters}]})


def main() -> None:
    """Writes the picture."""
    scene = gonio.Scene()
    thick = WIDTH * numpy.linspace(1.0, 0.7, JOINTS)
    for lock, absorption in enumerate(([0.4, 0.85, 1.7], [0.46, 0.98, 1.95], [0.35, 0.75, 1.5])):
        points = strands(lock).astype("f4")
        for number, tint in enumerate(TINTS):
            # Strands stand in no order, so that each tint has some everywhere.
            some = points[number :: len(TINTS)]
            counts, widths = numpy.full(len(some), JOINTS, "i4"), numpy.tile(thick, len(some)).astype("f4")
            curves = scene.add_curves(some.reshape(-1, 3), counts, widths, type="cubic", basis="catmullRom")
            scene.add_instance(curves=curves, materials=[hair(scene, [tint * part for part in absorption])])
    grey = scene.add_material(base_color=(0.035, 0.045, 0.06), specular_weight=0.0)
    quad(scene, [(-3, -3, -0.7), (3, -3, -0.7), (3, 3, -0.7), (-3, 3, -0.7)], grey)
    aim = (0.0, -0.13, 0.0)
    # A warm rim from the right, a cool one from the left, a small key from above.
    scene.add_light("rectangle", (3400.0, 3050.0, 2600.0), width=0.25, height=0.5, transform=gonio.look_at((0.5, 0.12, -0.42), aim), visible=False)
    scene.add_light("rectangle", (1900.0, 2300.0, 2900.0), width=0.2, height=0.5, transform=gonio.look_at((-0.55, -0.1, -0.3), aim), visible=False)
    scene.add_light("rectangle", (2900.0, 2750.0, 2500.0), width=0.22, height=0.22, transform=gonio.look_at((-0.25, 0.35, 0.5), aim), visible=False)
    scene.add_light("disk", lumens=22.0, temperature=4500.0, radius=0.03, spot=(120.0, 1.0), transform=gonio.look_at((0.12, -0.1, -0.35), (0.1, -0.1, -0.7)), visible=False)
    scene.set(width=480, height=600, samples=18, max_bounces=6)
    scene.add_camera(gonio.look_at((0.06, -0.1, 0.62), (0.0, -0.135, 0.0)), fov=20)
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "hair.png", exposure=0.3)


if __name__ == "__main__":
    main()

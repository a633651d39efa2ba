"""Three car paints, each a table of measurements under a clear coat, in a tunnel of light: `python car_paint.py car_paint.png`.

The tables are made up here from closed forms, in the half angles that gonioreflectometers of paints are read in; files of measurements (MERL, RGL and
others, `gonio.MeasuredBsdf.from_file`) take their place.
"""

import sys

import gonio
import numpy
from numpy.typing import NDArray
from shapes import finished, quad

Array = NDArray[numpy.float64]


def paint(ground: tuple[float, float, float], flakes: tuple[float, float, float], alpha: float) -> gonio.MeasuredBsdf:
    """A pigmented ground with metal flakes that turn towards grazing light: values in 1/sr over theta_h, theta_d and phi_d."""
    angles = 90.0 * numpy.linspace(0, 1, 60) ** 2, numpy.linspace(0, 89, 31), numpy.linspace(0, 180, 19)
    half, difference, turn = numpy.meshgrid(*(numpy.radians(axis) for axis in angles), indexing="ij")
    level, tilt = numpy.cos(half) * numpy.cos(difference), numpy.sin(half) * numpy.sin(difference) * numpy.cos(turn)
    view, light = numpy.maximum(level + tilt, 0.02), numpy.maximum(level - tilt, 0.02)
    slope = (1 - numpy.cos(half) ** 2) / alpha**2 + numpy.cos(half) ** 2
    shadowed = [numpy.sqrt(alpha**2 * (1 - c**2) + c**2) for c in (view, light)]
    lobe = 0.5 / (numpy.pi * alpha**2 * slope**2 * (shadowed[0] * light + shadowed[1] * view))
    # Flakes lose their colour towards grazing angles.
    grazing = (1 - numpy.cos(difference)) ** 3
    values = [g / numpy.pi + (f * (1 - grazing) + 0.15 * grazing) * lobe for g, f in zip(ground, flakes, strict=True)]
    axes = dict(zip(("theta_h", "theta_d", "phi_d"), angles, strict=True))
    return gonio.MeasuredBsdf.from_table(axes, numpy.stack(values, axis=-1).astype("f4"), nearest=[], reciprocal=True, bilateral=True)


def speedform(scene: gonio.Scene) -> int:
    """The body on which makers show paints: long, smooth, with one line along its flank; 0.52 m long, nose to +x."""
    u, v = numpy.meshgrid(numpy.linspace(-1, 1, 260), numpy.linspace(0, numpy.pi, 200), indexing="ij")
    end = numpy.clip(1 - numpy.abs(u) ** 2.5, 0, 1)
    wide = 0.105 * end**0.52 * (1 - 0.16 * u)
    high = 0.105 * end**0.62 * (1 - 0.32 * u) * (1 + 0.12 * numpy.cos(numpy.pi * u))
    # The line: a soft ridge at two fifths of the height, sharper to the rear.
    rise = numpy.minimum(v, numpy.pi - v)
    ridge = 0.009 * end * numpy.exp(-numpy.abs(rise - 0.62 + 0.1 * u) / (0.17 + 0.06 * u))
    across = numpy.cos(v)
    points = numpy.stack([0.26 * u, high * numpy.sin(v) ** 0.85, (wide + ridge) * numpy.sign(across) * numpy.abs(across) ** 0.8], axis=-1)
    along, around = numpy.gradient(points, axis=0), numpy.gradient(points, axis=1)
    normals = numpy.cross(around, along)
    length = numpy.linalg.norm(normals, axis=-1, keepdims=True)
    normals = normals / numpy.maximum(length, 1e-12)
    rows, columns = u.shape
    i, j = numpy.meshgrid(numpy.arange(rows - 1), numpy.arange(columns - 1), indexing="ij")
    a = i * columns + j
    triangles = numpy.stack([a, a + 1, a + columns + 1, a, a + columns + 1, a + columns], axis=-1).reshape(-1, 3).astype("i4")
    return scene.add_mesh(points.reshape(-1, 3).astype("f4"), triangles, normals=normals.reshape(-1, 3).astype("f4"))


def main() -> None:
    """Writes the picture."""
    scene = gonio.Scene()
    body = speedform(scene)
    paints = [
        paint((0.03, 0.002, 0.002), (0.2, 0.014, 0.012), 0.3),
        paint((0.004, 0.018, 0.05), (0.02, 0.09, 0.17), 0.26),
        paint((0.03, 0.03, 0.032), (0.2, 0.19, 0.18), 0.24),
    ]
    places = ((-0.06, 0.2, 24.0), (0.04, -0.06, 20.0), (0.16, -0.34, 16.0))
    for made, (x, z, degrees) in zip(paints, places, strict=True):
        coat = [("coat_weight", {"Constant": [1.0] * 4}), ("coat_roughness", {"Constant": [0.0] * 4}), ("coat_ior", {"Constant": [1.5] * 4})]
        material = scene.put_material({"origin": "paint", "closures": [{"measured": scene.put_measured(made), "parameters": coat}]})
        c, s = numpy.cos(numpy.radians(degrees)), numpy.sin(numpy.radians(degrees))
        scene.add_instance(body, [material], transform=[[-c, 0, s, x], [0, 1, 0, 0.004], [s, 0, c, z], [0, 0, 0, 1]])
    floor = scene.add_material(base_color=(0.05, 0.05, 0.055), specular_roughness=0.22)
    quad(scene, [(-8, 0, 2.5), (8, 0, 2.5), (8, 0, -8), (-8, 0, -8)], floor)
    wall = scene.add_material(base_color=(0.06, 0.065, 0.075), specular_weight=0.0)
    # Across the camera's way, so that its foot lies level in the picture.
    quad(scene, [(-6.8, 0, -6.5), (9.2, 0, 1.65), (9.2, 5, 1.65), (-6.8, 5, -6.5)], wall)
    # Tubes overhead, whose reflections draw the form, and a large soft light in front.
    for z in (-0.9, -0.35, 0.2, 0.75):
        scene.add_light("rectangle", (5200.0, 5200.0, 5200.0), width=2.2, height=0.07, transform=gonio.look_at((0, 1.15, z), (0, 0, z)), visible=False)
    scene.add_light("rectangle", (420.0, 430.0, 450.0), width=1.8, height=0.9, transform=gonio.look_at((-0.6, 0.7, 1.9), (0, 0.05, 0)), visible=False)
    scene.add_light("rectangle", (260.0, 300.0, 380.0), width=3.0, height=0.25, transform=gonio.look_at((0, 0.4, -1.4), (0, 0.4, -2.2)), visible=False)
    scene.set(width=960, height=600, samples=64)
    scene.add_camera(gonio.look_at((-0.46, 0.33, 0.95), (0.045, 0.04, -0.04)), fov=25)
    finished(scene, sys.argv[1] if len(sys.argv) > 1 else "car_paint.png", exposure=-0.5)


if __name__ == "__main__":
    main()

"""A body like a car's with lacquer, windows and wheels under a sky image and three lights: 141 thousand triangles."""

import numpy
from cornell import Diffuse, Glass, Mirror, Principled
from description import Camera, Mesh, Rectangle, Scene, Surface
from shapes import Vector, ball, box, facing, moved, quad, sheet, sky

PAINT = Principled((0.55, 0.04, 0.03), 0.45, coat_weight=1.0, coat_roughness=0.1)
RUBBER = Diffuse((0.04, 0.04, 0.04))


def scene() -> Scene:
    """The image's sun is wide enough for its pixels to hold."""
    lights = [
        Rectangle(facing((-3.0, 3.0, 2.5), (0.0, 0.5, 0.0)), 1.6, 1.0, (7000.0, 6600.0, 6000.0)),
        Rectangle(facing((3.4, 2.4, 2.0), (0.0, 0.5, 0.0)), 1.0, 1.0, (6000.0, 7000.0, 9000.0)),
        Rectangle(facing((0.0, 3.4, -3.0), (0.0, 0.6, 0.0)), 3.0, 0.5, (9000.0, 8000.0, 6500.0)),
    ]
    environment = sky((-0.5, 0.6, 0.45), glow=150000.0, width=0.004)
    return Scene([*body(), *wheels(), *inside()], lights, Camera(facing((-3.6, 1.7, 4.8), (-0.1, 0.55, 0.0)), 38.0), environment)


def body() -> list[Mesh]:
    """A rounded hull and a cabin of solid glass with a roof."""
    return [
        quad("ground", [(-9, 0, 9), (9, 0, 9), (9, 0, -9), (-9, 0, -9)], Diffuse((0.3, 0.3, 0.3))),
        hull("hull", (0.0, 0.55, 0.0), (2.1, 0.36, 0.85), 0.35, PAINT, 240, 167),
        hull("cabin", (-0.15, 1.02, 0.0), (1.05, 0.3, 0.66), 0.6, Glass(1.5), 120, 80),
        hull("roof", (-0.2, 1.345, 0.0), (0.7, 0.03, 0.5), 0.5, PAINT, 60, 40),
    ]


def hull(name: str, centre: Vector, radii: Vector, power: float, surface: Surface, columns: int, rows: int) -> Mesh:
    """A superellipsoid; a power of 1 makes an ellipsoid, less makes a box with round edges."""
    latitude = numpy.pi * (numpy.arange(rows + 1) / rows - 0.5)[:, None]
    longitude = -2.0 * numpy.pi * (numpy.arange(columns) / columns)[None, :]

    def bent(value: numpy.ndarray) -> numpy.ndarray:
        signed: numpy.ndarray = numpy.sign(value) * numpy.abs(value) ** power
        return signed

    across = bent(numpy.cos(latitude).round(12))
    x, y, z = across * bent(numpy.cos(longitude)), bent(numpy.sin(latitude)) + 0.0 * longitude, across * bent(numpy.sin(longitude))
    return sheet(name, numpy.stack([x, y, z], axis=2) * radii + numpy.asarray(centre), surface, closed=True)


def wheels() -> list[Mesh]:
    """Tyres, rims, and headlights."""
    places = numpy.stack([moved(x, 0.34, z) for x in (-1.3, 1.3) for z in (-0.8, 0.8)])
    around = 2.0 * numpy.pi * numpy.arange(96)[None, :] / 96
    section = 2.0 * numpy.pi * numpy.arange(33)[:, None] / 32
    radius = 0.24 + 0.1 * numpy.cos(section)
    points = numpy.stack([radius * numpy.cos(around), radius * numpy.sin(around), 0.12 * numpy.sin(section) + 0.0 * around], axis=2)
    tyre = sheet("tyre", points, RUBBER, closed=True)
    rim = ball("rim", (0.0, 0.0, 0.0), (0.2, 0.2, 0.1), Mirror(0.8, 0.4), 4)
    lamps = [ball(f"lamp {z}", (-2.0, 0.6, z), 0.14, Mirror(0.9, 0.1), 4) for z in (-0.5, 0.5)]
    return [Mesh(part.name, part.points, part.triangles, part.surface, places=places) for part in (tyre, rim)] + lamps


def inside() -> list[Mesh]:
    """Dark things in the cabin's glass."""
    return [box(f"seat {x}{z}", (x, 1.02, z), (0.25, 0.3, 0.3), Diffuse((0.2, 0.15, 0.1))) for x in (-0.5, 0.2) for z in (-0.3, 0.3)]

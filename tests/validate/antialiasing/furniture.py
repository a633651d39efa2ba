"""What the calibrated scenes and the harder ones have in common: a car's wheels and lamps, a table among chairs."""

import numpy
from builder import Builder


def wheels(b: Builder, rubber: int, chrome: int, subdivisions: int) -> None:
    """Four wheels with caps, and two lamps."""
    for x in (-1.3, 1.3):
        for z in (-0.85, 0.85):
            b.ball((x, 0.36, z), (0.36, 0.36, 0.14), rubber, subdivisions)
            b.ball((x, 0.36, z * 1.08), (0.2, 0.2, 0.08), chrome, subdivisions)
    for z in (-0.5, 0.5):
        b.ball((2.0, 0.75, z), 0.14, chrome, subdivisions)


def table(b: Builder, top: int, wood: int) -> None:
    """A table with five chairs around it."""
    b.box((0, 0.74, 0), (1.8, 0.04, 0.9), top)
    for x in (-0.85, 0.85):
        for z in (-0.4, 0.4):
            b.box((x, 0.36, z), (0.05, 0.72, 0.05), wood)
    for place, turn in (((-0.5, 0.8), 190.0), ((0.5, 0.85), 170.0), ((-0.5, -0.8), 5.0), ((0.6, -0.8), -10.0), ((1.4, 0.1), 80.0)):
        chair(b, place, turn, wood)


def chair(b: Builder, place: tuple[float, float], turn_deg: float, material: int) -> None:
    """A seat, four legs and a back of rods."""
    cosine, sine = numpy.cos(numpy.radians(turn_deg)), numpy.sin(numpy.radians(turn_deg))

    def at(x: float, y: float, z: float) -> tuple[float, float, float]:
        return (place[0] + cosine * x + sine * z, y, place[1] - sine * x + cosine * z)

    b.box(at(0, 0.45, 0), (0.42, 0.03, 0.42), material, turn_deg)
    for x in (-0.18, 0.18):
        for z in (-0.18, 0.18):
            b.rod(at(x, 0, z), at(x, 0.45 if z > 0 else 0.95, z), 0.018, material)
    for i in range(5):
        b.rod(at(-0.12 + 0.06 * i, 0.46, -0.18), at(-0.12 + 0.06 * i, 0.9, -0.18), 0.007, material)
    b.rod(at(-0.18, 0.92, -0.18), at(0.18, 0.92, -0.18), 0.02, material)

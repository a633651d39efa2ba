"""Glasses and balls on a patterned table before a patterned wall, two wide lights: caustics and textures, 45 thousand triangles."""

import numpy
from cornell import Glass
from description import Camera, Disk, Light, Mesh, Rectangle, Scene, Textured
from shapes import ball, downward, facing, lathed, quad


def scene() -> Scene:
    """Lights are wide, for a path finds them through smooth glass by chance only."""
    lights: list[Light] = [
        Rectangle(downward(0.0, 2.4, 0.0), 2.6, 2.0, (1500.0, 1350.0, 1100.0)),
        Disk(facing((-2.2, 1.3, 1.0), (0.0, 0.3, 0.0)), 0.8, (900.0, 1100.0, 1500.0)),
    ]
    return Scene([*stand(), *glasses()], lights, Camera(facing((0.25, 0.9, 1.7), (0.0, 0.18, 0.0)), 34.0), bounces=16)


def stand() -> list[Mesh]:
    """Table and wall."""
    return [
        quad("table", [(-1.5, 0, 1.2), (1.5, 0, 1.2), (1.5, 0, -0.8), (-1.5, 0, -0.8)], Textured(checks())),
        quad("wall", [(-1.5, 0, -0.8), (1.5, 0, -0.8), (1.5, 1.8, -0.8), (-1.5, 1.8, -0.8)], Textured(waves())),
    ]


def glasses() -> list[Mesh]:
    """Solid bodies of glass that stand a little above the table."""
    goblet = numpy.array(
        [(0.0, 0.0), (0.09, 0.0), (0.09, 0.008), (0.02, 0.02), (0.012, 0.12), (0.05, 0.16), (0.085, 0.22), (0.09, 0.30), (0.08, 0.36)]
        + [(0.074, 0.36), (0.083, 0.30), (0.078, 0.225), (0.045, 0.17), (0.0, 0.155)]
    )
    fine = numpy.stack([numpy.interp(numpy.linspace(0, 13, 53), numpy.arange(14), goblet[:, k]) for k in (0, 1)], axis=1)
    return [
        lathed("goblet", fine, (-0.28, 0.004, 0.05), Glass(1.5), segments=157),
        lathed("other goblet", fine, (0.3, 0.004, -0.2), Glass(1.5), segments=157),
        ball("ball", (0.05, 0.124, 0.2), 0.12, Glass(1.5), 5),
        ball("drop", (0.32, 0.064, 0.3), (0.1, 0.06, 0.1), Glass(1.7), 4),
        ball("water", (-0.05, 0.154, -0.3), 0.15, Glass(1.33), 4),
    ]


def checks() -> numpy.ndarray:
    """Soft-edged checks, finely grained."""
    v, u = numpy.meshgrid((numpy.arange(512) + 0.5) / 512, (numpy.arange(768) + 0.5) / 768, indexing="ij")
    check = 0.5 + 0.5 * numpy.tanh(6.0 * numpy.sin(24.0 * numpy.pi * u) * numpy.sin(16.0 * numpy.pi * v))
    grain = 0.9 + 0.1 * numpy.sin(150.0 * u + 20.0 * numpy.sin(9.0 * v))
    light, dark = numpy.array([0.75, 0.68, 0.55]), numpy.array([0.25, 0.12, 0.08])
    colour: numpy.ndarray = (check * grain)[..., None] * light + ((1.0 - check) * grain)[..., None] * dark
    return colour.astype("f4")


def waves() -> numpy.ndarray:
    """Coloured waves."""
    v, u = numpy.meshgrid((numpy.arange(256) + 0.5) / 256, (numpy.arange(512) + 0.5) / 512, indexing="ij")
    phase = 18.0 * u + 3.0 * numpy.sin(12.0 * v)
    return (0.42 + 0.3 * numpy.stack([numpy.sin(phase), numpy.sin(phase + 1.2), numpy.sin(phase + 2.4)], axis=2)).astype("f4")

"""Small rooms for spectral pictures, described once for both renderers: colours stand for reflectances, lamps for spectra of the CIE.

Lengths in metres, y up, flat faces. Colours are linear Rec.709; what reflectance they mean is told beside the scene, as numbers. Lamps have a
luminance of 1 cd/m².
"""

from collections.abc import Sequence
from dataclasses import dataclass

import cornell
import numpy
from cornell import GREEN, RED, WHITE, Colour, Diffuse, Glass, Part

WIDTH, HEIGHT = 160, 128
BOUNCES = 16
# Half the room's width; it is 2 m high and deep, open towards the camera.
HALF = 1.25
LAMP_CENTRE, LAMP_WIDTH, LAMP_DEPTH = (0.0, 1.999, 0.0), 1.3, 1.1


@dataclass(frozen=True)
class Gloss:
    """A GGX reflector, alpha = roughness squared, single scattering, with its colour at all angles."""

    colour: Colour
    roughness: float


@dataclass(frozen=True)
class Metal:
    """The same with Schlick's curve from its colour to white."""

    colour: Colour
    roughness: float


Surface = cornell.Surface | Gloss | Metal


@dataclass(frozen=True)
class Room:
    """Meshes under one lamp: a rectangle under the ceiling, or a sky that is the same all over."""

    parts: Sequence[Part]
    lamp: str
    ceiling: Colour | None
    camera: tuple[tuple[float, float, float], tuple[float, float, float]]
    fov: float


def enclosed(lamp: str, parts: Sequence[Part], ceiling: Colour = WHITE) -> Room:
    """A room with a lamp under its ceiling; the lamp has the ceiling's reflectance where it is a surface."""
    return Room(parts, lamp, ceiling, ((0.0, 1.0, 3.9), (0.0, 1.0, 0.0)), 37.0)


def walls(floor: Colour, ceiling: Colour, back: Colour, left: Colour, right: Colour) -> list[Part]:
    """Five faces that look inwards."""
    a, b = -HALF, HALF
    return [
        cornell.quad("floor", [(a, 0, 1), (b, 0, 1), (b, 0, -1), (a, 0, -1)], floor),
        cornell.quad("ceiling", [(a, 2, -1), (b, 2, -1), (b, 2, 1), (a, 2, 1)], ceiling),
        cornell.quad("back", [(a, 0, -1), (b, 0, -1), (b, 2, -1), (a, 2, -1)], back),
        cornell.quad("left", [(a, 0, 1), (a, 0, -1), (a, 2, -1), (a, 2, 1)], left),
        cornell.quad("right", [(b, 0, -1), (b, 0, 1), (b, 2, 1), (b, 2, -1)], right),
    ]


def boxes(tall: Colour, short: Colour) -> list[Part]:
    """Two boxes on the floor."""
    return [
        cornell.box("tall", (-0.43, -0.3), (0.6, 1.2, 0.6), 17.0, Diffuse(tall)),
        cornell.box("short", (0.47, 0.35), (0.6, 0.6, 0.6), -17.0, Diffuse(short)),
    ]


def box_led() -> Room:
    """The Cornell box with a yellow and a blue box in it, under a white LED."""
    return enclosed("LED-B3", walls(WHITE, WHITE, WHITE, RED, GREEN) + boxes((0.72, 0.6, 0.08), (0.06, 0.12, 0.6)))


def colours_fluorescent() -> Room:
    """Saturated walls that colour each other, under a lamp of three narrow bands."""
    orange, cream, cyan, magenta, yellow = (0.6, 0.25, 0.06), (0.8, 0.78, 0.7), (0.06, 0.42, 0.5), (0.6, 0.07, 0.35), (0.75, 0.62, 0.06)
    return enclosed("FL11", walls(orange, cream, cyan, magenta, yellow) + boxes((0.12, 0.5, 0.09), (0.25, 0.09, 0.5)), cream)


# Rows of a chart, from the top.
CHART: list[list[Colour]] = [
    [(0.17, 0.08, 0.06), (0.56, 0.3, 0.22), (0.11, 0.19, 0.33), (0.1, 0.15, 0.05), (0.23, 0.22, 0.43)],
    [(0.7, 0.2, 0.03), (0.06, 0.1, 0.38), (0.54, 0.08, 0.12), (0.11, 0.05, 0.14), (0.35, 0.5, 0.04)],
    [(0.03, 0.05, 0.29), (0.05, 0.29, 0.06), (0.45, 0.03, 0.04), (0.82, 0.57, 0.01), (0.5, 0.09, 0.3)],
]


def chart_sodium() -> Room:
    """Grey walls, a chart of fifteen colours and two boxes, under a sodium lamp."""
    grey = (0.5, 0.5, 0.5)
    patches = []
    for row, colours in enumerate(CHART):
        for column, colour in enumerate(colours):
            x, y, z = -0.96 + 0.39 * column, 1.28 - 0.42 * row + 0.2, -0.99
            corners = [(x, y, z), (x + 0.35, y, z), (x + 0.35, y + 0.38, z), (x, y + 0.38, z)]
            patches.append(cornell.quad(f"patch {row} {column}", corners, colour))
    low = [cornell.box("short", (0.75, 0.4), (0.45, 0.45, 0.45), -17.0, Diffuse((0.06, 0.12, 0.6)))]
    low += [cornell.box("flat", (-0.7, 0.45), (0.6, 0.3, 0.4), 20.0, Diffuse(RED))]
    return enclosed("HP1", walls(grey, WHITE, grey, grey, grey) + patches + low)


def glass_daylight() -> Room:
    """A ball of glass of one index on coloured tiles, before two coloured boards, under an even sky."""
    colours: list[Colour] = [(0.7, 0.1, 0.06), (0.1, 0.45, 0.12), (0.06, 0.14, 0.62), (0.76, 0.66, 0.08), (0.73, 0.73, 0.73), (0.45, 0.1, 0.4)]
    parts = []
    for i in range(6):
        for j in range(6):
            x, z = 0.5 * i - 1.5, 0.5 * j - 2.0
            corners = [(x, 0.0, z + 0.5), (x + 0.5, 0.0, z + 0.5), (x + 0.5, 0.0, z), (x, 0.0, z)]
            parts.append(cornell.quad(f"tile {i} {j}", corners, colours[(i + 2 * j + i * j % 2) % 6]))
    parts.append(cornell.box("left board", (-0.9, -1.2), (0.7, 1.1, 0.1), 25.0, Diffuse((0.65, 0.3, 0.05))))
    parts.append(cornell.box("right board", (0.9, -1.2), (0.7, 1.1, 0.1), -25.0, Diffuse((0.08, 0.4, 0.45))))
    parts.append(cornell.ball("glass", (0.0, 0.551, -0.2), 0.55, Glass(1.5)))
    return Room(parts, "D65", None, ((0.0, 1.3, 2.6), (0.0, 0.45, -0.3)), 38.0)


def gold_led() -> Room:
    """Rough balls with gold's and copper's colours, under an LED of three colours."""
    gold, copper = Gloss((0.95, 0.7, 0.27), 0.35), Metal((0.92, 0.5, 0.35), 0.25)
    balls = [cornell.ball("gold", (-0.5, 0.47, -0.35), 0.46, gold), cornell.ball("copper", (0.5, 0.43, 0.25), 0.42, copper)]
    return enclosed("LED-RGB1", walls((0.3, 0.32, 0.4), WHITE, WHITE, (0.1, 0.2, 0.55), (0.6, 0.5, 0.1)) + balls)


ROOMS = {made.__name__: made for made in (box_led, colours_fluorescent, chart_sodium, glass_daylight, gold_led)}


def colours(room: Room) -> set[Colour]:
    """All that reflect."""
    found = {WHITE} | ({room.ceiling} if room.ceiling else set())
    for part in room.parts:
        match part.surface:
            case Diffuse(colour) | Gloss(colour) | Metal(colour):
                found.add(colour)
    return found


def camera_matrix(room: Room) -> numpy.ndarray:
    """The camera's frame, 4 by 4 for column vectors: x right, y up, looking along -z."""
    position, target = (numpy.array(each) for each in room.camera)
    back = (position - target) / numpy.linalg.norm(position - target)
    right = numpy.cross((0.0, 1.0, 0.0), back)
    right /= numpy.linalg.norm(right)
    matrix = numpy.eye(4)
    matrix[:3] = numpy.stack([right, numpy.cross(back, right), back, position], axis=1)
    return matrix


def lamp_matrix() -> list[list[float]]:
    """The rectangle's frame: it shines along its -z, which is downwards."""
    x, y, z = LAMP_CENTRE
    return [[1, 0, 0, x], [0, 0, 1, y], [0, -1, 0, z], [0, 0, 0, 1]]

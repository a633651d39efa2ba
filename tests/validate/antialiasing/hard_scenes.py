"""Three kinds of picture: a smooth thing with reflections, many edges, and things thinner than a pixel before fine texture.

Exposed so that white is 1: values are cd/m² of scenes whose lamps were set by hand.
"""

import gonio
import numpy
from builder import Builder, Make
from furniture import table, wheels


def car(width: int, height: int, margin: int = 0) -> gonio.Scene:
    """A lacquered body on wheels between rods and a fence, on squares, under three hard lights: mirrored three times."""
    b = Builder(width, height, 3, margin)
    b.quad((-12, 0, 12), (24, 0, 0), (0, 0, -24), b.chequered(((0.55, 0.55, 0.5), (0.2, 0.22, 0.25))), repeats=2.0)
    paint = b.surface((0.5, 0.04, 0.03), coat_weight=1.0, coat_roughness=0.0, specular_weight=1.0, specular_roughness=0.35)
    chrome = b.surface((0.9, 0.9, 0.9), metalness=1.0, specular_weight=1.0, specular_roughness=0.0)
    rubber = b.surface((0.04, 0.04, 0.04), specular_weight=1.0, specular_roughness=0.5)
    pane = b.surface((0.08, 0.1, 0.12), specular_weight=1.0, specular_roughness=0.0)
    b.ball((0, 0.75, 0), (2.1, 0.42, 0.9), paint)
    b.ball((-0.2, 1.1, 0), (1.1, 0.45, 0.7), pane)
    wheels(b, rubber, chrome, 4)
    grey, white = b.surface((0.3, 0.3, 0.32)), b.surface((0.7, 0.7, 0.68))
    for i in range(9):
        b.rod((-3.0 + 0.75 * i, 0, -2.4), (-3.0 + 0.75 * i, 1.6, -2.4), 0.012, grey)
    for y in (0.5, 1.0, 1.5):
        b.rod((-3.2, y, -2.4), (3.2, y, -2.4), 0.012, grey)
    for i in range(14):
        b.box((-3.9 + 0.6 * i, 0.5, -4.0), (0.3, 1.0, 0.05), white)
    b.rod((1.0, 1.0, 0.8), (1.8, 2.3, 0.8), 0.01, chrome)
    for position, candela in (((4, 5, 4), 120.0), ((-5, 4, 3), 75.0), ((0, 5, -4), 65.0)):
        b.lamp(position, candela)
    return b.look((3.6, 1.7, 4.6), (0.0, 0.6, 0.0), 42.0)


def room(width: int, height: int, margin: int = 0) -> gonio.Scene:
    """A shelf of books, blinds, chairs around a table that mirrors once, under three hard lights."""
    b = Builder(width, height, 1, margin)
    wall, floor = b.surface((0.7, 0.68, 0.62)), b.surface((0.35, 0.22, 0.13))
    b.quad((-3, 0, 3), (6, 0, 0), (0, 0, -6), floor)
    b.quad((-3, 3, -3), (6, 0, 0), (0, 0, 6), wall)
    b.quad((-3, 0, -3), (6, 0, 0), (0, 3, 0), wall)
    b.quad((-3, 0, 3), (0, 0, -6), (0, 3, 0), b.surface((0.5, 0.3, 0.25)))
    b.quad((3, 0, -3), (0, 0, 6), (0, 3, 0), b.surface((0.3, 0.42, 0.35)))
    shelf(b)
    blinds(b)
    wood = b.surface((0.45, 0.3, 0.15))
    table(b, b.surface((0.25, 0.14, 0.08), specular_weight=1.0, specular_roughness=0.0), wood)
    b.ball((0.2, 0.86, 0.1), 0.1, b.surface((0.85, 0.85, 0.9), metalness=1.0, specular_weight=1.0, specular_roughness=0.0), 4)
    for position, candela in (((0.0, 2.7, 0.5), 12.0), ((-2.0, 2.4, 2.0), 8.0), ((2.2, 2.2, -1.5), 6.0)):
        b.lamp(position, candela)
    return b.look((1.9, 1.6, 2.8), (-0.3, 0.9, -0.4), 60.0)


def shelf(b: Builder) -> None:
    """Five boards of books of seeded sizes and colours."""
    random = numpy.random.default_rng(7)
    board = b.surface((0.6, 0.55, 0.45))
    for level in range(5):
        b.box((-1.6, 0.3 + 0.45 * level, -2.8), (2.2, 0.03, 0.35), board)
        x = -2.65
        while x < -0.6:
            thick, tall = random.uniform(0.02, 0.06), random.uniform(0.22, 0.36)
            colour = tuple(random.uniform(0.08, 0.7, 3).tolist())
            b.box((x + thick / 2, 0.315 + 0.45 * level + tall / 2, -2.78), (thick, tall, 0.24), b.surface(colour))
            x += thick + 0.004


def blinds(b: Builder) -> None:
    """Slats before a bright window."""
    b.quad((0.6, 0.9, -2.97), (1.8, 0, 0), (0, 1.4, 0), b.surface((0.9, 0.92, 0.95)))
    slat = b.surface((0.55, 0.52, 0.45))
    for i in range(26):
        b.box((1.5, 0.93 + 0.053 * i, -2.9), (1.8, 0.004, 0.035), slat)


def thin(width: int, height: int, margin: int = 0) -> gonio.Scene:
    """A hundred rods near or below a pixel's width and mirror balls before a wall of squares three pixels wide: nearly every pixel
    has contrast."""
    b = Builder(width, height, 2, margin)
    squares = b.chequered(((0.75, 0.73, 0.68), (0.25, 0.3, 0.36)))
    b.quad((-4, 0, -2), (8, 0, 0), (0, 6, 0), squares, repeats=9.0)
    b.quad((-4, 0, 4), (8, 0, 0), (0, 0, -6), squares, repeats=5.0)
    random = numpy.random.default_rng(3)
    metal = b.surface((0.8, 0.75, 0.6), metalness=1.0, specular_weight=1.0, specular_roughness=0.25)
    dark = b.surface((0.05, 0.05, 0.06))
    for i in range(110):
        foot = numpy.array([random.uniform(-2.0, 2.0), 0.0, random.uniform(-1.4, 1.2)])
        top = foot + [random.uniform(-0.6, 0.6), random.uniform(0.8, 2.4), random.uniform(-0.4, 0.4)]
        b.rod(tuple(foot), tuple(top), random.uniform(0.0015, 0.006), metal if i % 2 else dark)
    mirror = b.surface((0.9, 0.9, 0.9), metalness=1.0, specular_weight=1.0, specular_roughness=0.0)
    for x, z, radius in ((-1.1, 0.3, 0.35), (0.0, -0.4, 0.5), (1.0, 0.4, 0.3)):
        b.ball((x, radius, z), radius, mirror)
    for position, candela in (((3, 4, 4), 75.0), ((-3, 3.5, 3), 45.0)):
        b.lamp(position, candela)
    return b.look((0.0, 1.4, 4.6), (0.0, 0.95, 0.0), 40.0)


SCENES: dict[str, Make] = {"car": car, "room": room, "thin": thin}

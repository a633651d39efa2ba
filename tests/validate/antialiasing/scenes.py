"""Three scenes to the descriptions of those on which the thresholds were found: a smooth thing with reflections, things thinner than a
pixel before fine texture, and many edges.

Their numbers of triangles, lights and mirrored bounces are those of the descriptions. How much contrast and detail they have was set by
figures alone that no adaptive picture enters: the errors of regular grids and of the mean of pixels' corners, and the share of pixels with
a seam (`calibration.py` has them, and a test holds the scenes to them). Values are exposed so that white is 1.
"""

import gonio
import numpy
from builder import Builder, Make
from furniture import table, wheels


def car(width: int, height: int, margin: int = 0) -> gonio.Scene:
    """A lacquered body on wheels before a fence, between rods, on squares, under three hard lights: mirrored three times;
    23,176 triangles."""
    b = Builder(width, height, 3, margin)
    b.quad((-20, 0, 14), (34, 0, 0), (0, 0, -34), b.chequered(((0.29, 0.29, 0.27), (0.19, 0.195, 0.2))), repeats=12.0)
    b.quad((-40, 0, -9), (54, 0, 0), (0, 19, 0), b.surface((0.3, 0.32, 0.35)))
    body(b)
    grey, white = b.surface((0.22, 0.22, 0.23)), b.surface((0.3, 0.3, 0.29))
    for i in range(24):
        x = -3.6 + 0.3 * i
        b.rod((x, 0, -2.4), (x, 0.9 + 0.3 * (i % 3), -2.4), 0.012, grey)
    for i in range(104):
        b.box((-5.2 + 0.1 * i, 0.25, -4.0), (0.06, 0.5, 0.03), white)
    for y in (0.12, 0.4):
        b.box((0, y, -4.03), (10.5, 0.05, 0.03), white)
    b.box((0, 0.02, -4.0), (10.6, 0.04, 0.1), white)
    for position, candela in (((5, 4, 4), 120.0), ((-2, 4, 6), 90.0), ((-2, 7, -4), 130.0)):
        b.lamp(position, candela)
    return b.look((3.6, 1.7, 4.6), (0.0, 0.6, 0.0), 42.0)


def body(b: Builder) -> None:
    """Body, cabin, wheels and lamps."""
    paint = b.surface((0.26, 0.05, 0.04), coat_weight=1.0, coat_roughness=0.0, specular_weight=1.0, specular_roughness=0.4)
    pane = b.surface((0.08, 0.1, 0.12), specular_weight=1.0, specular_roughness=0.0)
    rubber = b.surface((0.1, 0.1, 0.1), specular_weight=1.0, specular_roughness=0.5)
    chrome = b.surface((0.6, 0.6, 0.6), metalness=1.0, specular_weight=1.0, specular_roughness=0.0)
    b.ball((0, 0.75, 0), (2.1, 0.42, 0.9), paint, 5)
    b.ball((-0.2, 1.1, 0), (1.1, 0.45, 0.7), pane, 5)
    wheels(b, rubber, chrome, 3)


def glass(width: int, height: int, margin: int = 0) -> gonio.Scene:
    """110 rods below or near a pixel's width and mirror balls before a wall of squares three pixels wide, under two hard lights:
    mirrored twice; 11,704 triangles."""
    b = Builder(width, height, 2, margin)
    squares = b.chequered(((0.48, 0.47, 0.45), (0.2, 0.21, 0.22)))
    b.quad((-4, 0, -2), (8, 0, 0), (0, 6, 0), squares, repeats=14.0)
    grey = b.surface((0.3, 0.29, 0.28))
    b.quad((-4, 0, 14), (8, 0, 0), (0, 0, -16), grey)
    b.quad((-4, 6, -2), (8, 0, 0), (0, 0, 16), grey)
    b.quad((-4, 0, 14), (0, 6, 0), (8, 0, 0), grey)
    for x in (-4, 4):
        b.quad((x, 0, -2), (0, 6, 0), (0, 0, 16), grey)
    random = numpy.random.default_rng(3)
    for _ in range(110):
        foot = numpy.array([random.uniform(-2.0, 2.0), 0.0, random.uniform(-1.4, 1.2)])
        top = foot + [random.uniform(-0.2, 0.2), random.uniform(0.7, 1.8), random.uniform(-0.2, 0.2)]
        b.rod(tuple(foot), tuple(top), random.uniform(0.003, 0.007), b.surface((random.uniform(0.2, 0.42),) * 3))
    mirror = b.surface((0.35, 0.35, 0.35), metalness=1.0, specular_weight=1.0, specular_roughness=0.0)
    for x, z, radius in ((-1.1, 0.3, 0.35), (0.0, -0.4, 0.5), (1.0, 0.4, 0.3), (0.5, 0.9, 0.15)):
        b.ball((x, radius, z), radius, mirror, 4)
    for x in (-0.4, -0.1, 0.2):
        b.ball((x, 0.08, 1.2), 0.08, mirror, 3)
    plinth = b.surface((0.3, 0.3, 0.3))
    for i in range(17):
        b.box((-3.2 + 0.4 * i, 0.06, -1.9), (0.3, 0.12, 0.1), plinth)
    for position, candela in (((1.8, 3.4, 8), 100.0), ((-2.2, 2.4, 8), 92.0)):
        b.lamp(position, candela)
    return b.look((0.0, 1.4, 4.6), (0.0, 0.95, 0.0), 40.0)


def room(width: int, height: int, margin: int = 0) -> gonio.Scene:
    """A shelf of books, blinds, and chairs around a table that mirrors once, under three hard lights; 3,950 triangles."""
    b = Builder(width, height, 1, margin)
    wall, floor = b.surface((0.4, 0.39, 0.37)), b.surface((0.3, 0.24, 0.19))
    b.quad((-3, 0, 3), (6, 0, 0), (0, 0, -6), floor)
    b.quad((-3, 3, -3), (6, 0, 0), (0, 0, 6), wall)
    b.quad((-3, 0, -3), (6, 0, 0), (0, 3, 0), wall)
    b.quad((-3, 0, 3), (0, 0, -6), (0, 3, 0), b.surface((0.4, 0.33, 0.3)))
    b.quad((3, 0, -3), (0, 0, 6), (0, 3, 0), b.surface((0.33, 0.37, 0.35)))
    for i in range(3):
        b.quad((-2.99, 1.2, 1.2 - 1.2 * i), (0, 0, -0.6), (0, 0.5, 0), b.surface((0.3, 0.3, 0.28 + 0.03 * i)))
    shelf(b)
    blinds(b)
    wood = b.surface((0.26, 0.22, 0.17))
    table(b, b.surface((0.22, 0.17, 0.13), specular_weight=1.0, specular_roughness=0.0), wood)
    for position, candela in (((1.6, 2.3, 2.7), 9.0), ((-1.0, 2.3, 2.6), 7.3), ((2.7, 0.9, 2.2), 7.3)):
        b.lamp(position, candela)
    return b.look((1.9, 1.6, 2.8), (-0.3, 0.9, -0.4), 60.0)


def shelf(b: Builder) -> None:
    """Five boards of books of seeded sizes and greys."""
    random = numpy.random.default_rng(7)
    board = b.surface((0.35, 0.33, 0.3))
    for level in range(5):
        b.box((-1.6, 0.5 + 0.36 * level, -2.8), (2.2, 0.03, 0.35), board)
        for i in range(45):
            thick, tall = random.uniform(0.032, 0.044), random.uniform(0.18, 0.28)
            colour = tuple(random.uniform(0.27, 0.34, 3).tolist())
            b.box((-2.66 + 0.047 * i, 0.515 + 0.36 * level + tall / 2, -2.75), (thick, tall, 0.24), b.surface(colour))


def blinds(b: Builder) -> None:
    """Slats before a bright window."""
    b.quad((0.9, 0.9, -2.97), (1.2, 0, 0), (0, 1.4, 0), b.surface((0.45, 0.46, 0.47)))
    slat = b.surface((0.38, 0.37, 0.35))
    for i in range(21):
        b.box((1.5, 0.94 + 0.067 * i, -2.95), (1.2, 0.034, 0.01), slat)


SCENES: dict[str, Make] = {"car": car, "room": room, "glass": glass}

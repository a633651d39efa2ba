"""20,000 plants on rolling ground under sun and sky."""

import numpy
from cornell import Diffuse
from description import Camera, Mesh, Scene, Sun
from shapes import facing, moved, sheet, sky

COUNT = 20_000
TOWARD_SUN = (0.5, 0.55, 0.35)


def scene(count: int = COUNT) -> Scene:
    """With so many plants. The sun is a light of its own, the image holds what is around it."""
    sun = Sun(facing(TOWARD_SUN, (0.0, 0.0, 0.0)), 1.0, (3.4e8, 3.0e8, 2.4e8))
    camera = Camera(facing((0.0, 2.2, 14.0), (0.0, 0.6, 0.0)), 42.0)
    return Scene([ground(), *plants(count)], [sun], camera, sky(TOWARD_SUN))


def height(x: numpy.ndarray, z: numpy.ndarray) -> numpy.ndarray:
    """The ground's height in metres."""
    return 0.5 * numpy.sin(0.21 * x + 0.5) * numpy.cos(0.17 * z) + 0.15 * numpy.sin(0.6 * x + 0.8 * z)


def ground() -> Mesh:
    """80 by 80 m."""
    z, x = numpy.meshgrid(numpy.linspace(40, -40, 101), numpy.linspace(-40, 40, 101), indexing="ij")
    return sheet("ground", numpy.stack([x, height(x, z), z], axis=2), Diffuse((0.28, 0.2, 0.12)))


def plants(count: int) -> list[Mesh]:
    """Four kinds, scattered, turned and scaled at random."""
    random = numpy.random.default_rng(7)
    x, z = random.uniform(-38, 38, (2, count))
    z = numpy.where(numpy.hypot(x, z - 14.0) < 2.5, z - 6.0, z)
    turn, scale = random.uniform(0, 360, count), random.uniform(0.5, 1.2, count)
    places = numpy.stack([moved(*each) for each in zip(x, height(x, z), z, turn, scale, strict=True)])
    colours = [(0.18, 0.36, 0.08), (0.3, 0.42, 0.1), (0.12, 0.28, 0.1), (0.55, 0.4, 0.12)]
    return [tuft(f"kind {k}", Diffuse(colour), random, places[k :: len(colours)]) for k, colour in enumerate(colours)]


def tuft(name: str, surface: Diffuse, random: numpy.random.Generator, places: numpy.ndarray) -> Mesh:
    """Twenty-four bent blades of eight triangles."""
    blades = []
    along = numpy.linspace(0, 1, 5)[:, None]
    for angle in random.uniform(0, 2 * numpy.pi, 24):
        lean, tall = random.uniform(0.1, 0.35), random.uniform(0.35, 0.7)
        out = numpy.array([numpy.cos(angle), 0.0, numpy.sin(angle)])
        aside = numpy.array([-out[2], 0.0, out[0]])
        spine = out * (0.05 + lean * along**2) + numpy.array([0.0, 1.0, 0.0]) * tall * along
        wide = aside * 0.02 * (1.0 - 0.9 * along)
        blades.append(sheet(name, numpy.stack([spine - wide, spine + wide], axis=1), surface))
    points = numpy.concatenate([blade.points for blade in blades])
    triangles = numpy.concatenate([blade.triangles + 10 * number for number, blade in enumerate(blades)]).astype("i4")
    return Mesh(name, points, triangles, surface, places=places)

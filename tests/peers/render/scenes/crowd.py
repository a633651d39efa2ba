"""20,000 instances that overlap deeply, four soups of 4,000 random triangles, under a sun and an even sky."""

import math

import numpy
from cornell import Diffuse
from description import LUMENS_PER_WATT, Camera, Mesh, Scene, Sun
from shapes import facing, moved, sheet

COUNT = 20_000
TRIANGLES = 4_000
# Instances a square metre.
DENSITY = 0.44
TOWARD_SUN = (0.4, 0.7, 0.3)
SUN_ANGLE = 0.5
# Watts a square metre, and watts a square metre and steradian.
SUN, SKY = 4.0, 0.6


def scene(count: int = COUNT) -> Scene:
    """With so many instances. The sky is the same all around."""
    radiance = SUN * LUMENS_PER_WATT / (math.pi * math.sin(math.radians(SUN_ANGLE / 2)) ** 2)
    sun = Sun(facing(TOWARD_SUN, (0.0, 0.0, 0.0)), SUN_ANGLE, (radiance,) * 3)
    side = math.sqrt(count / DENSITY) / 2
    camera = Camera(facing((0.0, 4.0, side * 0.5), (0.0, 0.0, side * 0.5 - 16.0)), 45.0)
    sky = numpy.full((64, 128, 3), SKY * LUMENS_PER_WATT, "f4")
    return Scene([ground(side), *soups(count, side)], [sun], camera, sky)


def ground(side: float) -> Mesh:
    """Flat, a little larger than what stands on it."""
    x, z = numpy.meshgrid([-side, side], [side, -side])
    return sheet("ground", numpy.stack([x, numpy.zeros_like(x), z], axis=2).astype(float), Diffuse((0.3, 0.28, 0.25)))


def soups(count: int, side: float) -> list[Mesh]:
    """Scattered, turned and scaled at random."""
    random = numpy.random.default_rng(11)
    x, z = random.uniform(-side, side, (2, count))
    turn, scale = random.uniform(0, 360, count), random.uniform(0.6, 1.4, count)
    places = numpy.stack([moved(*each) for each in zip(x, numpy.zeros(count), z, turn, scale, strict=True)])
    colours = [(0.2, 0.4, 0.1), (0.35, 0.4, 0.1), (0.15, 0.3, 0.1), (0.5, 0.4, 0.15)]
    return [soup(f"soup {k}", Diffuse(colour), random, places[k :: len(colours)]) for k, colour in enumerate(colours)]


def soup(name: str, surface: Diffuse, random: numpy.random.Generator, places: numpy.ndarray) -> Mesh:
    """Small triangles in a ball of two metres across."""
    centre = random.normal(size=(TRIANGLES, 1, 3))
    centre *= random.uniform(0, 1, (TRIANGLES, 1, 1)) ** (1 / 3) / numpy.linalg.norm(centre, axis=2, keepdims=True)
    corners = centre + random.normal(scale=0.05, size=(TRIANGLES, 3, 3)) + (0.0, 0.9, 0.0)
    return Mesh(name, corners.reshape(-1, 3), numpy.arange(3 * TRIANGLES, dtype="i4").reshape(-1, 3), surface, places=places)

"""The Cornell box in three forms, described once for all renderers.

Lengths in metres, y up, the camera looks along -z. Surfaces are triangles with flat normals (balls are finely faceted), so that no
renderer's way with interpolated normals enters. The light's radiance is 1 in each channel, and every renderer is given just that: gonio and
Mitsuba take radiance; Cycles takes watts P, with radiance P / (pi * area).
"""

import math
from dataclasses import dataclass

import numpy

RESOLUTION = 128
MAX_BOUNCES = 64
CAMERA_POSITION = (0.0, 1.0, 3.9)
CAMERA_FOV = 40.0
# Centre, width along x and depth along z of the ceiling light, which shines downwards. It lies close under the ceiling: the lights of gonio
# and Cycles let rays pass, so the ceiling is seen through them; where a light is a surface, it gets the ceiling's reflectance.
LIGHT_CENTRE = (0.0, 1.999, 0.0)
LIGHT_WIDTH = 1.3
LIGHT_DEPTH = 1.1
LIGHT_RADIANCE = 1.0
BALL_SUBDIVISIONS = 5

Colour = tuple[float, float, float]
WHITE: Colour = (0.73, 0.73, 0.73)
RED: Colour = (0.63, 0.065, 0.05)
GREEN: Colour = (0.14, 0.45, 0.091)


@dataclass(frozen=True)
class Diffuse:
    """A Lambertian surface."""

    reflectance: Colour


@dataclass(frozen=True)
class Mirror:
    """A GGX reflector whose Fresnel factor is the same at all angles; alpha = roughness squared."""

    reflectance: float
    roughness: float


@dataclass(frozen=True)
class Glass:
    """A smooth dielectric."""

    ior: float


@dataclass(frozen=True)
class Principled:
    """Blender's Principled BSDF; names are those of its sockets, and what is not named has Blender's default."""

    base_color: Colour
    roughness: float
    metallic: float = 0.0
    specular_tint: Colour = (1.0, 1.0, 1.0)
    coat_weight: float = 0.0
    coat_roughness: float = 0.03


Surface = Diffuse | Mirror | Glass | Principled


@dataclass(frozen=True)
class Part:
    """A mesh of one surface: points (N, 3) as float32, triangles (M, 3) as int32, counter-clockwise seen from outside."""

    name: str
    points: numpy.ndarray
    triangles: numpy.ndarray
    surface: Surface


VARIANTS = ("diffuse", "specular", "principled")


def parts(variant: str) -> list[Part]:
    """The meshes of a variant: its walls and what stands between them."""
    return walls() + {"diffuse": two_boxes, "specular": mirror_and_glass, "principled": gold_and_plastic}[variant]()


def walls() -> list[Part]:
    """A room of 2 m, open towards the camera; its faces look inwards."""
    return [
        quad("floor", [(-1, 0, 1), (1, 0, 1), (1, 0, -1), (-1, 0, -1)], WHITE),
        quad("ceiling", [(-1, 2, -1), (1, 2, -1), (1, 2, 1), (-1, 2, 1)], WHITE),
        quad("back", [(-1, 0, -1), (1, 0, -1), (1, 2, -1), (-1, 2, -1)], WHITE),
        quad("left", [(-1, 0, 1), (-1, 0, -1), (-1, 2, -1), (-1, 2, 1)], RED),
        quad("right", [(1, 0, -1), (1, 0, 1), (1, 2, 1), (1, 2, -1)], GREEN),
    ]


def two_boxes() -> list[Part]:
    """Goral's two boxes."""
    return [
        box("tall", (-0.33, -0.3), (0.6, 1.2, 0.6), 17.0, Diffuse(WHITE)),
        box("short", (0.37, 0.35), (0.6, 0.6, 0.6), -17.0, Diffuse(WHITE)),
    ]


def mirror_and_glass() -> list[Part]:
    """Specular chains that all three renderers can be given exactly."""
    return [
        ball("mirror", (-0.42, 0.4, -0.35), 0.4, Mirror(0.9, 0.2)),
        ball("glass", (0.42, 0.45, 0.25), 0.4, Glass(1.5)),
    ]


def gold_and_plastic() -> list[Part]:
    """Blender's own surface: a metal with coloured edge, lacquered plastic, and a glass ball above it."""
    gold = Principled((0.944, 0.776, 0.373), 0.4, metallic=1.0, specular_tint=(0.99, 0.98, 0.75))
    plastic = Principled((0.1, 0.25, 0.6), 0.5, coat_weight=0.7, coat_roughness=0.3)
    return [
        ball("gold", (-0.42, 0.4, -0.35), 0.4, gold),
        box("plastic", (0.4, 0.1), (0.6, 0.6, 0.6), -17.0, plastic),
        ball("glass", (0.4, 0.95, 0.1), 0.3, Glass(1.5)),
    ]


def quad(name: str, corners: list[tuple[float, float, float]], reflectance: Colour) -> Part:
    """A diffuse quadrilateral."""
    triangles = numpy.array([[0, 1, 2], [0, 2, 3]], "i4")
    return Part(name, numpy.array(corners, "f4"), triangles, Diffuse(reflectance))


def box(name: str, centre: tuple[float, float], size: tuple[float, float, float], turn: float, surface: Surface) -> Part:
    """A box on the floor: centre in x and z, size in x, y and z, turned about y by degrees."""
    corners = numpy.array([(x, y, z) for x in (-0.5, 0.5) for y in (0.0, 1.0) for z in (-0.5, 0.5)]) * size
    cosine, sine = math.cos(math.radians(turn)), math.sin(math.radians(turn))
    points = corners @ numpy.array([[cosine, 0, -sine], [0, 1, 0], [sine, 0, cosine]]) + (centre[0], 0.0, centre[1])
    faces = [(0, 1, 3, 2), (4, 6, 7, 5), (0, 4, 5, 1), (2, 3, 7, 6), (0, 2, 6, 4), (1, 5, 7, 3)]
    triangles = [triangle for a, b, c, d in faces for triangle in ((a, b, c), (a, c, d))]
    # The lowest face would coincide with the floor.
    points[:, 1] += 1e-3
    return Part(name, points.astype("f4"), numpy.array(triangles, "i4"), surface)


def ball(name: str, centre: tuple[float, float, float], radius: float, surface: Surface) -> Part:
    """An octahedron refined towards a sphere: 8 * 4^subdivisions triangles."""
    points = numpy.array([(1, 0, 0), (-1, 0, 0), (0, 1, 0), (0, -1, 0), (0, 0, 1), (0, 0, -1)], "f8")
    faces = [(0, 2, 4), (2, 1, 4), (1, 3, 4), (3, 0, 4), (2, 0, 5), (1, 2, 5), (3, 1, 5), (0, 3, 5)]
    triangles = numpy.array(faces, "i4")
    for _ in range(BALL_SUBDIVISIONS):
        points, triangles = refined(points, triangles)
    return Part(name, (points * radius + centre).astype("f4"), triangles, surface)


def refined(points: numpy.ndarray, triangles: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Every triangle in four, new points moved onto the unit sphere."""
    edges = numpy.sort(numpy.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    unique, where = numpy.unique(edges, axis=0, return_inverse=True)
    middle = points[unique].sum(axis=1)
    middle /= numpy.linalg.norm(middle, axis=1, keepdims=True)
    ab, bc, ca = (where.reshape(3, -1) + len(points)).astype("i4")
    a, b, c = triangles.T
    four = [numpy.stack(corners, axis=1) for corners in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))]
    return numpy.concatenate([points, middle]), numpy.concatenate(four)


def light_matrix() -> list[list[float]]:
    """The light's frame, 4 by 4 for column vectors: its local x and y span it, it shines along its local -z, which is downwards."""
    x, y, z = LIGHT_CENTRE
    return [[1, 0, 0, x], [0, 0, 1, y], [0, -1, 0, z], [0, 0, 0, 1]]


def camera_matrix() -> list[list[float]]:
    """The camera's frame: x right, y up, looking along -z."""
    x, y, z = CAMERA_POSITION
    return [[1, 0, 0, x], [0, 1, 0, y], [0, 0, 1, z], [0, 0, 0, 1]]

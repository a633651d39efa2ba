"""Fresnel, Snell and mirrors in double precision, as the oracles need them. Vectors are arrays (…, 3)."""

import numpy


def dot(a: numpy.ndarray, b: numpy.ndarray) -> numpy.ndarray:
    """Inner products."""
    result: numpy.ndarray = (a * b).sum(axis=-1)
    return result


def towards(gamma: float, plane: float = 0.0) -> numpy.ndarray:
    """The unit vector of C and γ in degrees: nadir is −z, C0 is +x."""
    c, g = numpy.radians(plane), numpy.radians(gamma)
    return numpy.array([numpy.sin(g) * numpy.cos(c), numpy.sin(g) * numpy.sin(c), -numpy.cos(g)])


def across(direction: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Two unit vectors square to a direction and to each other; the first is level."""
    level = numpy.cross(direction, [0.0, 0.0, 1.0])
    length = float(numpy.linalg.norm(level))
    first = level / length if length > 1e-9 else numpy.array([1.0, 0.0, 0.0])
    return first, numpy.cross(first, direction)


def mirrored(direction: numpy.ndarray, normal: numpy.ndarray) -> numpy.ndarray:
    """Directions after a mirror."""
    result: numpy.ndarray = direction - 2 * dot(direction, normal)[..., None] * normal
    return result


def reflectance(cosine: numpy.ndarray, index: numpy.ndarray | float) -> numpy.ndarray:
    """Of unpolarised light at a smooth interface; `index` is that beyond it over that before it. 1 where all is reflected."""
    square = 1 - (1 - cosine**2) / index**2
    inner = numpy.sqrt(numpy.maximum(square, 0))
    s = (cosine - index * inner) / (cosine + index * inner)
    p = (index * cosine - inner) / (index * cosine + inner)
    result: numpy.ndarray = numpy.where(square <= 0, 1.0, 0.5 * (s * s + p * p))
    return result


def refracted(direction: numpy.ndarray, normal: numpy.ndarray, index: numpy.ndarray | float) -> numpy.ndarray:
    """Directions beyond an interface whose normal looks back along them."""
    index = numpy.asarray(index)[..., None]
    cosine = -dot(direction, normal)[..., None]
    inner = numpy.sqrt(numpy.maximum(1 - (1 - cosine**2) / index**2, 0))
    result: numpy.ndarray = direction / index + (cosine / index - inner) * normal
    return result


def strata(count: int, generator: numpy.random.Generator) -> numpy.ndarray:
    """Points of the unit square, one at random in each of `count` × `count` cells."""
    cells = numpy.stack(numpy.meshgrid(numpy.arange(count), numpy.arange(count), indexing="ij"), -1).reshape(-1, 2)
    result: numpy.ndarray = (cells + generator.random(cells.shape)) / count
    return result

"""What is known of the scenes on which the thresholds were found, and the same of a scene here: figures that no adaptive picture enters."""

from dataclasses import dataclass

import gonio
import numpy
from builder import Make
from methods import Subject, colour, shown

# Rays of a map along a pixel's side, and what parts two surfaces: the normals' cosine, and the share of the depth.
MAP_SIDE, LEAST_COSINE, MOST_DEPTH = 4, 0.9, 0.05


@dataclass(frozen=True)
class Figures:
    """Triangles; root mean square errors in steps of 8-bit sRGB of regular grids by their side, and of the mean of pixels' corners;
    the share of pixels in which surfaces part."""

    triangles: int
    grids: dict[int, float]
    corners: float
    seams: float


DESCRIBED = {
    "car": Figures(23176, {1: 3.47, 2: 1.30, 3: 0.76, 4: 0.52, 5: 0.39}, 2.91, 0.018),
    "room": Figures(3950, {1: 3.79, 2: 1.60, 3: 0.98, 4: 0.68, 5: 0.54}, 3.17, 0.066),
    "glass": Figures(11704, {1: 8.95, 2: 3.47, 3: 2.01, 4: 1.43, 5: 1.09}, 7.95, 0.120),
}


def triangles(make: Make) -> int:
    """Triangles of a scene."""
    return sum(len(mesh["triangles"]) for mesh in make(16, 16).to_dict()["meshes"])


def corner_means(make: Make, width: int, height: int) -> numpy.ndarray:
    """The picture whose pixels are the means of their corners, 8-bit sRGB values."""
    film, _, _ = Subject(make(width, height, 1)).film(antialiasing=1)
    corners = colour(film)
    return shown((corners[:-1, :-1] + corners[:-1, 1:] + corners[1:, :-1] + corners[1:, 1:]) / 4.0)


def seams(make: Make, width: int, height: int) -> float:
    """The share of pixels in which a map of `MAP_SIDE` squared rays meets surfaces that part."""
    scene = make(width * MAP_SIDE, height * MAP_SIDE)
    scene.set(passes=["depth", "normal", "primId"], max_bounces=0, antialiasing=1)
    render = gonio.Render(scene)
    render.wait()
    depth, normal, number = (by_pixel(render.film()[name]) for name in ("depth", "normal", "primId"))
    depth, number = depth[..., 0], number[..., 0]
    nothing = ~numpy.isfinite(depth) | (depth <= 0.0)
    found = numpy.zeros(depth.shape[:2], bool)
    for one in range(MAP_SIDE**2):
        for other in range(one):
            bent = (normal[:, :, one] * normal[:, :, other]).sum(axis=-1) < LEAST_COSINE
            nearer = numpy.minimum(depth[:, :, one], depth[:, :, other])
            apart = numpy.abs(depth[:, :, one] - depth[:, :, other]) > MOST_DEPTH * nearer
            apart &= number[:, :, one] != number[:, :, other]
            seen = ~(nothing[:, :, one] & nothing[:, :, other])
            found |= seen & (bent | apart | (nothing[:, :, one] ^ nothing[:, :, other]))
    return float(found.mean())


def by_pixel(values: object) -> numpy.ndarray:
    """A pass of several places a pixel as (height, width, place, channel)."""
    values = numpy.asarray(values, "f4")
    height, width, channels = values.shape
    split = values.reshape(height // MAP_SIDE, MAP_SIDE, width // MAP_SIDE, MAP_SIDE, channels).swapaxes(1, 2)
    return split.reshape(height // MAP_SIDE, width // MAP_SIDE, MAP_SIDE**2, channels)

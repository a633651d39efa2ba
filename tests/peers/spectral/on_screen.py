"""Pictures of the screen of `scenes/prism.py` as metres along it, and what is read from them: light, centroids, noise."""

from dataclasses import dataclass

import numpy
import through_prism
from description import Scene
from scenes import prism
from through_prism import EDGES, HALF_BAND, LUMINANCE

# Of the largest luminance along the screen: what is less is not the rainbow.
LIT = 0.1
# Pixels a side, of the squares whose error tells what noise in single pixels hides.
SQUARE = 8


@dataclass(frozen=True)
class Read:
    """Of each channel: light over the screen's width in cd/m, centroid in m, with standard errors."""

    light: numpy.ndarray
    centroid: numpy.ndarray
    light_error: numpy.ndarray
    centroid_error: numpy.ndarray


@dataclass(frozen=True)
class Noise:
    """Means over lit pixels, relative to the mean square of their luminance."""

    variance: float
    error: float
    squares: float


@dataclass(frozen=True)
class View:
    """The compared rows of a picture: their numbers, and the places of the edges of their pixels along the screen, (rows, width + 1)."""

    rows: numpy.ndarray
    edges: numpy.ndarray


def view(scene: Scene) -> View:
    """By the pinhole; rows of pixels are level, so are lines of one height on the screen."""
    matrix, tall = scene.camera.matrix, numpy.tan(numpy.radians(scene.camera.fov) / 2.0)
    up = tall * (1.0 - (2.0 * numpy.arange(scene.height) + 1.0) / scene.height)
    right = tall * scene.width / scene.height * (2.0 * numpy.arange(scene.width + 1) / scene.width - 1.0)
    x, y = numpy.meshgrid(right, up)
    rays = numpy.stack([x, y, -numpy.ones_like(x)], axis=2) @ matrix[:3, :3].T
    eye = matrix[:3, 3]
    hits = eye + rays * (((prism.TARGET - eye) @ prism.AWAY) / (rays @ prism.AWAY))[..., None] - prism.TARGET
    rows = numpy.flatnonzero(abs((hits @ prism.UP)[:, 0]) < HALF_BAND)
    return View(rows, (hits @ prism.ALONG)[rows])


def read(picture: numpy.ndarray, seen: View) -> Read:
    """Each row of (height, width, channels) tells once, and how rows differ is the error."""
    values = picture[seen.rows] * abs(numpy.diff(seen.edges, axis=1))[..., None]
    light, moment = values.sum(axis=1), (values * middles(seen)[..., None]).sum(axis=1)
    whole = light.mean(axis=0)
    centroid = moment.mean(axis=0) / whole
    return Read(whole, centroid, row_error(light), row_error((moment - centroid * light) / whole))


def row_error(values: numpy.ndarray) -> numpy.ndarray:
    """The standard error of means over rows."""
    error: numpy.ndarray = values.std(axis=0, ddof=1) / numpy.sqrt(len(values))
    return error


def with_luminance(picture: numpy.ndarray) -> numpy.ndarray:
    """Luminance as a fourth channel."""
    return numpy.concatenate([picture, picture @ LUMINANCE[:, None]], axis=2)


def middles(seen: View) -> numpy.ndarray:
    """Of pixels along the screen."""
    made: numpy.ndarray = 0.5 * (seen.edges[:, 1:] + seen.edges[:, :-1])
    return made


def expected(bins: numpy.ndarray, seen: View) -> numpy.ndarray:
    """Pixels of the compared rows for flux in bins along the screen: radiance without noise, (rows, width, 3)."""
    shown = through_prism.radiance(bins) * numpy.diff(EDGES)[:, None]
    summed = numpy.concatenate([numpy.zeros((1, bins.shape[1])), numpy.cumsum(shown, axis=0)])
    upto = numpy.stack([numpy.interp(seen.edges, EDGES, column) for column in summed.T], axis=2)
    made: numpy.ndarray = numpy.diff(upto, axis=1) / numpy.diff(seen.edges, axis=1)[..., None]
    return made


def strips(picture: numpy.ndarray, bins: numpy.ndarray, seen: View) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """Colours (strips, 3) of strips across the lit part of the screen: of a picture, of the closed form, and the picture's standard errors."""
    known, shown = expected(bins, seen), picture[seen.rows]
    luminance = (known @ LUMINANCE).mean(axis=0)
    columns = numpy.flatnonzero(luminance > LIT * luminance.max())
    parts = numpy.array_split(columns, len(columns) // SQUARE)
    means = numpy.stack([[values[:, part].mean(axis=1) for part in parts] for values in (shown, known)])
    errors = numpy.stack([row_error(shown_rows - known_rows) for shown_rows, known_rows in zip(*means, strict=True)])
    return means[0].mean(axis=1), means[1].mean(axis=1), errors


def noise(pictures: list[numpy.ndarray], bins: numpy.ndarray, seen: View) -> Noise:
    """Of two pictures; pixels are lit where the closed form has a tenth of its largest luminance."""
    known = expected(bins, seen) @ LUMINANCE
    lit, scale = known > LIT * known.max(), (known[known > LIT * known.max()] ** 2).mean()
    first, second = ((picture @ LUMINANCE)[seen.rows] for picture in pictures)
    errors = [shown - known for shown in (first, second)]
    squares = [numpy.where(lit, error, 0.0) for error in errors]
    mean = [float((squared(error) ** 2).sum() * SQUARE**2 / lit.sum() / scale) for error in squares]
    return Noise(
        variance=float(0.5 * ((first - second)[lit] ** 2).mean() / scale),
        error=float(numpy.mean([(error[lit] ** 2).mean() / scale for error in errors])),
        squares=float(numpy.mean(mean)),
    )


def squared(values: numpy.ndarray) -> numpy.ndarray:
    """Means over squares of pixels; what is left at the lower and right edge is left out."""
    height, width = (side // SQUARE * SQUARE for side in values.shape)
    made: numpy.ndarray = values[:height, :width].reshape(height // SQUARE, SQUARE, width // SQUARE, SQUARE).mean(axis=(1, 3))
    return made

"""How far pictures are from a reference, in linear luminance."""

from dataclasses import dataclass

import compare
import numpy

LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])
# What is added to the reference's luminance in denominators, as a part of the picture's mean: keeps black pixels from deciding alone.
EPSILON = 0.02
# The share of pixels with the largest errors that the second figure leaves out, on all sides alike.
OUTLIERS = 0.001


@dataclass(frozen=True)
class Error:
    """Means over pixels of the squared error over the squared luminance; `coarse` is the same of blocks, in which noise counts less and light that is
    not there as much (a black picture has 1); `blocks` is the median difference of blocks, `mean` that of the whole.
    """

    whole: float
    without_outliers: float
    coarse: float
    blocks: float
    mean: float
    black: float


def error(picture: numpy.ndarray, reference: numpy.ndarray) -> Error:
    """Of a picture (height, width, 3); `black` is the share of lit blocks in which it shows less than a tenth of the light."""
    shown, known = picture @ LUMINANCE, reference @ LUMINANCE
    relative = numpy.sort((((shown - known) / (known + EPSILON * known.mean())) ** 2).ravel())
    kept = relative.size - round(OUTLIERS * relative.size)
    theirs, mine = (compare.blocks(image[..., None]) for image in (shown, known))
    coarse = float((((theirs - mine) / (mine + EPSILON * known.mean())) ** 2).mean())
    lit = mine > EPSILON * known.mean()
    black = float((theirs[lit] < 0.1 * mine[lit]).mean())
    blocks = float(numpy.median(abs(theirs[lit] / mine[lit] - 1.0)))
    mean = float(shown.mean() / known.mean() - 1.0)
    return Error(float(relative.mean()), float(relative[:kept].mean()), coarse, blocks, mean, black)

"""One case's texels in both engines. No Blender needed."""

import numpy
from .case import Case

OUTPUT, PLACE, EMITTED = "node", "place", "emitted"
# Pixels of a ball at its rim and at edges of its faces, where samples that lie apart meet other faces.
EDGES = 0.01
# Pixels along a side of the blocks whose middles are compared where values are rounded, the share of them that is there at least, and how
# many times the tolerance 95 of 100 pixels alone may differ.
BLOCK, FULL, ROUNDED = 8, 0.75, 20.0
# The share of blocks at the rim that may differ: one of a ball's.
RIM = 0.015


def tile(mine: dict, theirs: dict, case: Case, pixels=None) -> dict:
    """What is found on a tile: both engines had the same inputs to the bit."""
    value, expected = mine[OUTPUT], theirs[OUTPUT]
    with numpy.errstate(invalid="ignore"):
        difference = numpy.abs(value - expected)
    found = summary(difference, expected, case)
    # What is brighter is held back as a firefly; what is not a number takes its whole sample along.
    shines = ((expected > 0.0) & (expected < 1e4)).all(axis=-1, keepdims=True)
    with numpy.errstate(invalid="ignore"):
        emitted = numpy.where(shines, numpy.abs(mine[EMITTED] - expected), 0.0)
    found["emitted"] = summary(emitted, expected, case)["largest"]
    found["exact"] = found["exact"] and found["emitted"] <= case.tolerance
    return found


def summary(difference: numpy.ndarray, expected: numpy.ndarray, case: Case, known=True, steps: float = 0.0) -> dict:
    """Relative differences: the largest but for the share at steps, the 95th percentile, how many are beyond the tolerance.

    They are relative to the value, or to the middle of the case's values where it is smaller than that. Where Cycles gives no number
    nothing is compared.
    """
    known = known & numpy.isfinite(expected).all(axis=-1)
    if not known.any():
        return {"largest": 0.0, "most": 0.0, "percentile95": 0.0, "beyond": 0, "compared": 0, "exact": False, "even": True}
    expected = expected[known]
    size = numpy.abs(expected)
    usual = float(numpy.median(size[size > 0.0])) if (size > 0.0).any() else 1.0
    relative = (difference[known] / numpy.maximum(size, usual)).max(axis=-1)
    relative = numpy.where(numpy.isfinite(relative), relative, numpy.inf)
    ordered, spared = numpy.sort(relative), int(max(case.steps, steps) * relative.size)
    beyond = int((relative > case.tolerance).sum())
    within = ordered[: relative.size - min(spared, beyond)]
    return {
        "largest": _short(within[-1]),
        "most": _short(ordered[-1]),
        "percentile95": _short(ordered[int(0.95 * (ordered.size - 1))]),
        "beyond": beyond,
        "compared": int(relative.size),
        "exact": bool(within[-1] <= case.tolerance),
        # A picture of one value shows little.
        "even": bool(numpy.ptp(expected) == 0.0),
    }


def ball(mine: dict, theirs: dict, case: Case, pixels) -> dict:
    """What is found on a ball: samples lie up to 0.005 pixels apart, so each value is moved along its own slope to the other's place.

    `pixels` gives the row and the column where the camera sees a place.
    """
    value, expected = mine[OUTPUT], theirs[OUTPUT]
    inner = numpy.s_[1:-1, 1:-1]
    here = theirs[PLACE]
    there = numpy.any(here != 0.0, axis=-1) & numpy.any(mine[PLACE] != 0.0, axis=-1)
    known = there[1:-1, 1:-1] & there[:-2, 1:-1] & there[2:, 1:-1] & there[1:-1, :-2] & there[1:-1, 2:]
    offset = (pixels(mine[PLACE]) - pixels(here))[inner]
    slopes, bends = _slopes(expected)
    moved = sum(slope * offset[..., axis, None] for axis, slope in enumerate(slopes))
    leeway = sum(bend * numpy.abs(offset[..., axis, None]) for axis, bend in enumerate(bends))
    difference = numpy.maximum(numpy.abs(value[inner] - expected[inner] - moved) - leeway, 0.0)
    found = summary(difference, expected[inner], case, known, EDGES)
    if case.rounded:
        single = found["percentile95"]
        found = summary(*_middles(value[inner] - expected[inner] - moved, expected[inner], known), case, steps=RIM)
        found["single"] = single
        found["exact"] = found["exact"] and single <= ROUNDED * case.tolerance
    found["apart"] = _short(numpy.abs(offset[known]).max()) if known.any() else 0.0
    return found


def _middles(difference: numpy.ndarray, expected: numpy.ndarray, known: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Medians of signed differences over blocks of pixels, in which rounding that goes both ways falls out, and of the values."""
    found = []
    for row in range(0, known.shape[0], BLOCK):
        for column in range(0, known.shape[1], BLOCK):
            part = numpy.s_[row : row + BLOCK, column : column + BLOCK]
            there = known[part]
            if there.sum() > FULL * BLOCK * BLOCK:
                found.append([numpy.median(values[part][there], axis=0) for values in (difference, expected)])
    middles = numpy.array(found)
    return numpy.abs(middles[:, 0]), middles[:, 1]


def lit(mine: dict, theirs: dict, case: Case, pixels=None) -> dict:
    """What is found on a ball that light falls on: means of blocks, as both have noise."""
    value, expected = (blocks(each[EMITTED]) for each in (mine, theirs))
    return summary(numpy.abs(value - expected), expected, case)


def blocks(picture: numpy.ndarray) -> numpy.ndarray:
    """Means of 4 by 4 blocks of a square picture."""
    side = picture.shape[0] // 4
    return picture.reshape(4, side, 4, side, 3).mean(axis=(1, 3))


def averaged(mine: dict, theirs: dict, case: Case, pixels=None) -> dict:
    """What is found of outputs that rays find out: means of blocks of the outputs themselves."""
    return lit({EMITTED: mine[OUTPUT]}, {EMITTED: theirs[OUTPUT]}, case)


# By the scene that shows it.
WAYS = {"tiles": tile, "balls": ball, "near": ball, "particles": ball, "floor": averaged, "mirror": lit}
WAYS |= {"lit": lit, "found": lit, "filled": lit}


def _slopes(values: numpy.ndarray) -> tuple[list, list]:
    """Of inner pixels: change to the next pixel down and to the right, and how much that differs from side to side."""
    middle = values[1:-1, 1:-1]
    sides = ((values[:-2, 1:-1], values[2:, 1:-1]), (values[1:-1, :-2], values[1:-1, 2:]))
    return [0.5 * (after - before) for before, after in sides], [numpy.abs(after - 2.0 * middle + before) for before, after in sides]


def _short(value: float) -> float:
    """Three digits."""
    return float(f"{min(float(value), 1e30):.2e}")

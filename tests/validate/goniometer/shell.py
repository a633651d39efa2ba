"""A point lamp in the middle of a shell of glass: every ray meets both spheres at right angles, so closed forms hold.

An interface throws back R = ((n − 1) / (n + 1))². Glass between two of them throws back S = 2R / (1 + R) and passes (1 − R) / (1 + R).
What it throws back goes through the middle, where the lamp hides nothing, and comes to the glass on the other side. Without absorption all
light leaves, so an even lamp keeps its intensity. With all light above the lamp caught by a black screen, nothing comes back and (1 − R) /
(1 + R) is left below.
"""

import numpy
from expected import Expected
from luminaires import LUMENS, SHELL_INDEX

BARE = LUMENS / (4 * numpy.pi)
NORMAL = ((SHELL_INDEX - 1) / (SHELL_INDEX + 1)) ** 2
PASSED = (1 - NORMAL) / (1 + NORMAL)


def table(how: str, polar: numpy.ndarray, candela: float, ratio: float) -> Expected:
    """Even intensities."""
    return Expected(how, numpy.zeros(1), polar, numpy.full((1, len(polar)), candela), numpy.zeros((1, len(polar))), ratio)


def expected() -> Expected:
    """The bare lamp's."""
    return table("closed form: I, for nothing is lost", numpy.arange(0.0, 180.01, 1.0), BARE, 1.0)


def screened() -> Expected:
    """Below the screen; its rim is at 90°."""
    return table("closed form: I (1 − R) / (1 + R)", numpy.arange(0.0, 85.01, 1.0), BARE * PASSED, 0.5 * PASSED)

"""Adaptive antialiasing against a reference of 32 by 32 rays a pixel, beside regular grids and two-pass variance sampling.

`pytest -m validate -s tests/validate/antialiasing` prints the whole curve of error against rays and time, and writes crops side by side to the folder that
GONIO_ANTIALIASING names. The thresholds were found on scenes of the same three kinds; those here are others.
"""

import os
import pathlib
from functools import cache

import numpy
import pytest

gonio = pytest.importorskip("gonio")

from compare import write_png  # noqa: E402
from methods import Errors, Picture, Subject, errors  # noqa: E402
from scenes import SCENES  # noqa: E402

WIDTH, HEIGHT = 512, 384
GRIDS = (1, 2, 3, 4, 5)
ADAPTIVE = ("adaptive", "high", "paper")
REFERENCE = 32
# What the standard rule's root mean square error is held to: a regular grid's of so many places each way, times a factor.
GRID_GOALS = {"car": (2, 0.5), "room": (5, 1.25), "thin": (3, 1.0)}
# Crops that show what is hard: left, top, side.
CROPS = {"car": (300, 120, 96), "room": (180, 190, 96), "thin": (200, 150, 96)}
ENLARGED = 3

pytestmark = [pytest.mark.validate, pytest.mark.timeout(7200)]


@cache
def subject(name: str) -> Subject:
    """The scene, laid out once."""
    return Subject(SCENES[name](WIDTH, HEIGHT))


@cache
def reference(name: str) -> numpy.ndarray:
    """What is held to be right."""
    return subject(name).antialiased(REFERENCE).shown


@cache
def picture(name: str, method: str | int) -> Picture:
    """The quickest of three pictures."""
    pictures = [subject(name).antialiased(method) for _ in range(3)]
    return min(pictures, key=lambda found: found.processor)


def error(name: str, method: str | int) -> Errors:
    """Of a picture against the reference."""
    return errors(picture(name, method).shown, reference(name))


def line(label: str, rays: float, found: Errors, seconds: str) -> None:
    """A row of the table."""
    print(f"{label:>24} {rays:6.2f} {found.rmse:6.2f} {found.mae:6.2f} {100 * found.bad:7.3f} {seconds}")


@pytest.mark.parametrize("name", SCENES)
def test_the_curve(name):
    """Prints all, and holds the standard rule to denser grids."""
    print(f"\n{name}: method, rays a pixel, RMSE, MAE, bad %, seconds by the clock and by the processor")
    for method in (*GRIDS, *ADAPTIVE):
        found = picture(name, method)
        label = f"grid {method} x {method}" if isinstance(method, int) else method
        line(label, found.rays, error(name, method), f"{found.clock:.2f} {found.processor:.2f}")
    for rays in (1.5, 2.0, 3.0, 4.0, 6.0):
        shown, spent = subject(name).two_pass(rays)
        line("two-pass variance", spent, errors(shown, reference(name)), "")
    crops(name)
    side, factor = GRID_GOALS[name]
    assert error(name, "adaptive").rmse <= factor * error(name, side).rmse


@pytest.mark.parametrize("name", SCENES)
def test_equal_rays_against_two_passes(name):
    """Two-pass variance sampling gets no closer with as many rays; the paper's one threshold is printed beside."""
    for method in ADAPTIVE:
        shown, spent = subject(name).two_pass(picture(name, method).rays)
        found = errors(shown, reference(name))
        print(f"{name} {method}: {error(name, method).rmse:.2f}, two passes {found.rmse:.2f} with {spent:.2f} rays")
        assert method == "paper" or error(name, method).rmse < found.rmse


@pytest.mark.parametrize("name", ["car", "room"])
def test_equal_time_against_grids(name):
    """In the time it takes, grids (their curve drawn straight between logarithms) are farther off; and it takes less than three by three."""
    found = picture(name, "adaptive")
    seconds = [picture(name, side).processor for side in GRIDS]
    curve = [error(name, side).rmse for side in GRIDS]
    grid = float(numpy.exp(numpy.interp(numpy.log(found.processor), numpy.log(seconds), numpy.log(curve))))
    print(f"{name}: {error(name, 'adaptive').rmse:.2f} in {found.processor:.2f} s, a grid has {grid:.2f} then, 3 x 3 takes {seconds[2]:.2f} s")
    assert error(name, "adaptive").rmse < grid
    assert found.processor < seconds[2]


def crops(name: str) -> None:
    """Writes a part of the pictures, enlarged, side by side: one ray, adaptive, the paper's rule, five by five, reference."""
    folder = os.environ.get("GONIO_ANTIALIASING")
    if folder is None:
        return
    left, top, side = CROPS[name]
    shown = [picture(name, method).shown for method in (1, "adaptive", "paper", 5)] + [reference(name)]
    parts = [values[top : top + side, left : left + side].round().astype("u1") for values in shown]
    pathlib.Path(folder).mkdir(parents=True, exist_ok=True)
    row = numpy.concatenate([part.repeat(ENLARGED, 0).repeat(ENLARGED, 1) for part in parts], axis=1)
    write_png(pathlib.Path(folder) / f"{name}.png", row)

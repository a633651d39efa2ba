"""Rooms by wavelength in gonio and in Mitsuba 3, both given the same reflectances and lamps: XYZ must agree block by block.

Nothing is fitted: lamps have the power that is 1 cd/m² in closed form. Writes the figures to `out/peers/spectral.md`.
"""

from collections.abc import Iterator

import compare
import environments
import in_gonio
import numpy
import pytest
from coloured_rooms import BOUNCES, HEIGHT, ROOMS, WIDTH
from mitsuba_child import THREADS, Mitsuba

OUT = environments.ROOT / "out" / "peers"
# Samples a pixel, two pictures of each renderer; squares, as Mitsuba's sampler wants them.
SAMPLES = {"chart_sodium": 400, "gold_led": 400}
USUAL_SAMPLES = 256
SEEDS = (1, 2)
MOST_NOISE = 0.006
MOST_MEDIAN = 0.005
MOST_PERCENTILE95 = 0.02
# Of the mean ratio beyond four of its standard errors. Mitsuba's observer has steps of 5 nm, which is 0.2 % of a lamp's Z; that is reckoned with
# for the lamp itself, not for its light after coloured walls.
MOST_MEAN = 0.0005
# What that observer may make of a lamp.
MOST_OBSERVER = 0.002
INTRODUCTION = f"""# Spectral pictures beside Mitsuba 3

{WIDTH} × {HEIGHT} pixels, {BOUNCES} bounces, XYZ over blocks of {compare.BLOCK} × {compare.BLOCK} pixels: |Δ| / (reference +
{compare.FLOOR:.0%} of the image's mean). Noise is the standard error of blocks (RMS). Ratios are gonio's mean over Mitsuba's less 1, X, Y, Z, in
parts of a thousand, with their standard errors; "lamp" is what both observers' tables say of the lamp itself.

| room | lamp | median | 95th percentile | largest | noise of gonio | of Mitsuba | ratios | lamp |
| --- | --- | --- | --- | --- | --- | --- | --- | --- |
"""

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1800)]


@pytest.fixture(scope="module")
def rows() -> Iterator[list[str]]:
    """Lines of the table, written when all rooms are done."""
    OUT.mkdir(parents=True, exist_ok=True)
    lines: list[str] = []
    yield lines
    if lines:
        (OUT / "spectral.md").write_text(INTRODUCTION + "\n".join(lines) + "\n")


def ours(name: str, samples: int) -> list[numpy.ndarray]:
    """A room in gonio."""
    room = ROOMS[name]()
    scenes = [in_gonio.described(room, samples=samples, seed=seed, threads=THREADS) for seed in SEEDS]
    return [in_gonio.xyz(in_gonio.rendered(scene)) for scene in scenes]


def theirs(name: str, samples: int) -> tuple[list[numpy.ndarray], numpy.ndarray]:
    """A room in Mitsuba, and its lamp's XYZ; skips where Mitsuba cannot be had."""
    try:
        with Mitsuba(name) as peer:
            return [peer.render(samples, seed)[0] for seed in SEEDS], peer.lamp_xyz
    except environments.Unavailable as reason:
        pytest.skip(f"no Mitsuba: {reason}")


def mean_error(pair: list[numpy.ndarray]) -> numpy.ndarray:
    """The relative standard error of a channel's mean over the picture, from how blocks differ between two pictures."""
    a, b = (compare.blocks(picture).reshape(-1, 3) for picture in pair)
    error: numpy.ndarray = 0.5 * numpy.sqrt(((a - b) ** 2).sum(axis=0)) / (0.5 * (a + b)).sum(axis=0)
    return error


def thousandths(values: numpy.ndarray) -> str:
    return ", ".join(f"{1000.0 * value:+.2f}" for value in values)


@pytest.mark.parametrize("name", ROOMS)
def test_blocks_agree(name: str, rows: list[str]) -> None:
    samples = SAMPLES.get(name, USUAL_SAMPLES)
    reference, lamp = theirs(name, samples)
    found = ours(name, samples)
    here, there = (compare.measured(first, second, samples, 0.0) for first, second in (found, reference))
    apart = compare.difference(here.image, there.image)
    ratio = here.image.mean(axis=(0, 1)) / there.image.mean(axis=(0, 1))
    error = numpy.hypot(mean_error(found), mean_error(reference))
    observers = in_gonio.lamp_xyz(ROOMS[name]().lamp) / lamp
    to_rgb = numpy.linalg.inv(in_gonio.XYZ).T
    compare.write_strip(OUT / f"spectral-{name}.png", here.image @ to_rgb, there.image @ to_rgb)
    cells = [name, ROOMS[name]().lamp, f"{apart.median:.2%}", f"{apart.percentile95:.2%}", f"{apart.largest:.2%}"]
    cells += [f"{here.noise:.2%}", f"{there.noise:.2%}", f"{thousandths(ratio - 1.0)} ± {thousandths(error)}", thousandths(observers - 1.0)]
    rows.append("| " + " | ".join(cells) + " |")
    print(rows[-1])
    assert max(here.noise, there.noise) < MOST_NOISE
    assert apart.median < MOST_MEDIAN
    assert apart.percentile95 < MOST_PERCENTILE95
    assert numpy.abs(observers - 1.0).max() < MOST_OBSERVER
    assert (numpy.abs(ratio / observers - 1.0) < MOST_MEAN + 4.0 * error).all()

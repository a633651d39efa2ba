"""Compares a goniometer's file with an oracle: `python comparing.py SCENE FILE.ldt|ies [--points]`.

What counts is where the expected intensity is above a tenth of its peak and surely known. The goniometer counts rays in zones about its γ,
so a round luminaire's values are held against the oracle's means over those zones; with `--points` against its intensities in the very
directions. Where the oracle has cells of its own, the file has to have them.
"""

import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import expected
import gonio
import numpy

LIMIT = 0.01
BRIGHT = 0.1
# Standard error of what an oracle has to know better than what is judged by it.
SURE = 0.003


@dataclass(frozen=True)
class Deviation:
    """The largest relative deviation of what is bright, where it is, and the oracle's own standard error there."""

    largest: float
    plane: float
    gamma: float
    oracle: float
    mean: float
    points: int

    def __str__(self) -> str:
        place = f"C{self.plane:g} γ{self.gamma:g}"
        own = f"oracle ± {100 * self.oracle:.3f} %"
        return f"{100 * self.largest:.3f} % at {place} ({own}), mean {100 * self.mean:+.3f} %, {self.points} angles"


def unfolded(table: dict[str, Any]) -> tuple[numpy.ndarray, numpy.ndarray, numpy.ndarray]:
    """C planes from 0 to 360, γ and candela of a file of type C as gonio reads it."""
    assert table["photometric_type"] == "C", table["photometric_type"]
    planes, polar = numpy.array(table["horizontal_deg"], float), numpy.array(table["vertical_deg"], float)
    candela = numpy.array(table["factors"], float).reshape(len(planes), len(polar))
    for about in (90.0, 180.0):
        if planes[0] == 0.0 and planes[-1] == about:
            planes, candela = numpy.append(planes, 2 * about - planes[-2::-1]), numpy.append(candela, candela[-2::-1], axis=0)
    if len(planes) == 1:
        planes, candela = numpy.array([0.0, 360.0]), numpy.repeat(candela, 2, axis=0)
    if planes[-1] < 360.0:
        planes, candela = numpy.append(planes, 360.0 + planes[0]), numpy.append(candela, candela[:1], axis=0)
    return planes, polar, candela


def at_planes(wanted: numpy.ndarray, planes: numpy.ndarray, candela: numpy.ndarray) -> numpy.ndarray:
    """Rows between a file's planes."""
    result: numpy.ndarray = numpy.stack([numpy.interp(wanted, planes, column, period=360.0) for column in candela.T], axis=1)
    return result


def compare(name: str, file: Path, points: bool = False) -> Deviation:
    """A file against a scene's oracle, at the angles of γ that both have; round luminaires in every plane of the file."""
    kept = expected.read(name)
    planes, polar, candela = unfolded(gonio.read_goniogram(file.read_bytes(), file.name)[0])
    common = [(i, j) for i, gamma in enumerate(kept.polar) for j in numpy.flatnonzero(numpy.abs(polar - gamma) < 1e-3)]
    assert common, f"{file.name} has none of the oracle's angles"
    ours, theirs = (numpy.array(column) for column in zip(*common, strict=True))
    if kept.cell:
        steps = float(numpy.diff(planes).min()), float(numpy.diff(polar).min())
        assert points or numpy.allclose(steps, kept.cell), f"{file.name} has steps of {steps}, expected {kept.cell}"
    if len(kept.planes) > 1:
        wanted, error, c = kept.candela[:, ours], kept.error[:, ours], kept.planes
        found = at_planes(c, planes, candela)[:, theirs]
    else:
        c, found = planes, candela[:, theirs]
        row = kept.candela[0, ours] if points else kept.cell_means(polar)[theirs]
        wanted, error = numpy.broadcast_to(row, found.shape), numpy.broadcast_to(kept.error[0, ours], found.shape)
    bright = (wanted > BRIGHT * kept.candela.max()) & (error < SURE * wanted)
    # The horizon's value is the harmonic mean of its zone's halves below and above.
    bright &= points | (numpy.abs(kept.polar[ours] - 90.0) > 1e-3)
    off = numpy.where(bright, found / numpy.where(bright, wanted, 1.0) - 1.0, 0.0)
    i, j = numpy.unravel_index(numpy.abs(off).argmax(), off.shape)
    mean = float(off[bright].mean())
    oracle = float(error[i, j] / wanted[i, j])
    return Deviation(float(abs(off[i, j])), float(c[i]), float(kept.polar[ours[j]]), oracle, mean, int(bright.sum()))


def write_ies(name: str, file: Path) -> None:
    """The oracle's own figures as a file, for a look or as a lamp."""
    kept = expected.read(name)
    planes, rows = kept.planes, kept.candela
    numbers = [
        f"1 -1 1 {len(kept.polar)} {len(planes)} 1 2 0 0 0",
        "1 1 0",
        *(" ".join(f"{x:.9g}" for x in row) for row in (kept.polar, planes, *rows)),
    ]
    file.write_text("IESNA:LM-63-2002\nTILT=NONE\n" + "\n".join(numbers) + "\n")


def main(arguments: list[str]) -> int:
    """Prints the deviation; 1 where it is beyond the limit."""
    name, file = (argument for argument in arguments if argument != "--points")
    found = compare(name, Path(file), "--points" in arguments)
    print(f"{name}: {found}")
    return int(found.largest > LIMIT)


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

"""IES and EULUMDAT files read a second time: just what the files at hand need, and bilinear interpolation in double precision."""

from dataclasses import dataclass
from pathlib import Path
from typing import Any

import gonio
import numpy


@dataclass(frozen=True)
class Table:
    """Candela by C (0 to 360, both included) and γ in degrees; nadir is −z, C0 is +x, C90 is +y."""

    planes: numpy.ndarray
    polar: numpy.ndarray
    candela: numpy.ndarray

    def intensity(self, direction: numpy.ndarray) -> numpy.ndarray:
        """Candela of unit vectors (…, 3)."""
        x, y, z = numpy.moveaxis(direction, -1, 0)
        return self.at(numpy.degrees(numpy.arctan2(y, x)) % 360.0, numpy.degrees(numpy.arctan2(numpy.hypot(x, y), -z)))

    def at(self, c: numpy.ndarray, gamma: numpy.ndarray) -> numpy.ndarray:
        """Candela of angles in degrees, linear in both, zero beyond the polar angles."""
        h, share_h = cell(self.planes, c)
        v, share_v = cell(self.polar, gamma)
        low = self.candela[h, v] * (1 - share_v) + self.candela[h, v + 1] * share_v
        high = self.candela[h + 1, v] * (1 - share_v) + self.candela[h + 1, v + 1] * share_v
        inside = (gamma >= self.polar[0] - 1e-9) & (gamma <= self.polar[-1] + 1e-9)
        return numpy.where(inside, low * (1 - share_h) + high * share_h, 0.0)


def cell(knots: numpy.ndarray, x: numpy.ndarray) -> tuple[numpy.ndarray, numpy.ndarray]:
    """Number of the cell, and where in it."""
    low = numpy.clip(numpy.searchsorted(knots, x, side="right") - 1, 0, len(knots) - 2)
    return low, (x - knots[low]) / (knots[low + 1] - knots[low])


def read(path: Path) -> Table:
    """A file of type C photometry by the letter of LM-63 or EULUMDAT."""
    text = path.read_text("latin-1")
    return read_ies(text) if path.suffix.lower() == ".ies" else read_ldt(text)


def read_ies(text: str) -> Table:
    """LM-63: candela × multiplier × ballast factor, by horizontal angle and then by vertical angle."""
    after = text[text.index("TILT=") :].split("\n", 1)[1]
    numbers = [float(word) for word in after.replace(",", " ").split()]
    vertical, horizontal = int(numbers[3]), int(numbers[4])
    assert numbers[5] == 1, "only type C is read here"
    factor = numbers[2] * numbers[10]
    angles = numbers[13 : 13 + vertical + horizontal]
    values = numpy.array(numbers[13 + vertical + horizontal :][: vertical * horizontal]).reshape(horizontal, vertical)
    return unfolded(numpy.array(angles[vertical:]), numpy.array(angles[:vertical]), factor * values)


def read_ldt(text: str) -> Table:
    """EULUMDAT: cd/klm × conversion factor × the first lamp set's flux."""
    lines = [line.strip().replace(",", ".") for line in text.split("\n")]
    symmetry, planes, polar = int(lines[2]), int(lines[3]), int(lines[5])
    sets = int(lines[25])
    factor = float(lines[23]) * float(lines[28]) / 1000.0
    numbers = [float(line) for line in lines[26 + 6 * sets + 10 :] if line]
    c, gamma, values = numpy.array(numbers[:planes]), numpy.array(numbers[planes : planes + polar]), numbers[planes + polar :]
    stored = {0: planes, 1: 1, 2: planes // 2 + 1, 3: planes // 2 + 1, 4: planes // 4 + 1}[symmetry]
    rows = factor * numpy.array(values[: stored * polar]).reshape(stored, polar)
    if symmetry == 0:
        return unfolded(c, gamma, rows)
    if symmetry == 1:
        return unfolded(numpy.zeros(1), gamma, rows)
    if symmetry == 3:
        # From C270 over C0 to C90.
        return unfolded(numpy.concatenate([c[3 * planes // 4 :] - 360.0, c[: planes // 4 + 1]]), gamma, rows)
    return unfolded(c[:stored] if stored <= planes else numpy.append(c, 360.0), gamma, rows)


def unfolded(c: numpy.ndarray, gamma: numpy.ndarray, rows: numpy.ndarray) -> Table:
    """All around from one plane, a quarter, a half about C0–C180 or C90–C270, or all planes."""
    if len(c) == 1:
        return Table(numpy.array([0.0, 360.0]), gamma, numpy.repeat(rows, 2, axis=0))
    if c[0] == 0 and c[-1] == 90:
        c, rows = mirrored(c, rows, 90.0)
    if c[0] == 0 and c[-1] == 180:
        c, rows = mirrored(c, rows, 180.0)
    if c[0] == -90 and c[-1] == 90 or c[0] == 90 and c[-1] == 270:
        c, rows = mirrored(c, rows, float(c[-1]))
        turned = c % 360.0
        order = numpy.argsort(turned[:-1])
        c, rows = turned[:-1][order], rows[:-1][order]
    if c[-1] != 360:
        c, rows = numpy.append(c, 360.0), numpy.append(rows, rows[:1], axis=0)
    assert c[0] == 0 and (numpy.diff(c) > 0).all(), c
    return Table(c, gamma, rows)


def mirrored(c: numpy.ndarray, rows: numpy.ndarray, about: float) -> tuple[numpy.ndarray, numpy.ndarray]:
    """The planes and their mirror images about the last of them."""
    return numpy.append(c, 2 * about - c[-2::-1]), numpy.append(rows, rows[-2::-1], axis=0)


def as_light(path: Path) -> dict[str, Any]:
    """What a point light of 1 cd takes to have the file's candela, by gonio's own reader."""
    return {"goniogram": gonio.read_goniogram(path.read_bytes(), path.name)[0]}

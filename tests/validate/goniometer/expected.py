"""Expected intensities: what the oracles give, and where they are kept. `python expected.py [NAME…]` reckons them anew."""

import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy

FOLDER = Path(__file__).with_name("expected")


@dataclass(frozen=True)
class Expected:
    """Candela by C plane and γ, with their standard errors. One plane stands for all: the luminaire is round about the vertical."""

    how: str
    planes: numpy.ndarray
    polar: numpy.ndarray
    candela: numpy.ndarray
    error: numpy.ndarray
    # What leaves the luminaire of the source's flux, where the oracle knows it.
    ratio: float | None = None
    # Degrees of C and γ over which each value is the mean; None where it is of its very direction.
    cell: tuple[float, float] | None = None

    def write(self, name: str) -> None:
        """Keeps the figures with seven digits."""
        words = {
            "how": self.how,
            "ratio": self.ratio,
            "cell": self.cell,
            "planes": self.planes.tolist(),
            "polar": self.polar.tolist(),
            "candela": [[float(f"{x:.7g}") for x in row] for row in self.candela],
            "error": [[float(f"{x:.2g}") for x in row] for row in self.error],
        }
        FOLDER.mkdir(exist_ok=True)
        (FOLDER / f"{name}.json").write_text(json.dumps(words, separators=(",", ":"), ensure_ascii=False) + "\n")

    def cell_means(self, gamma: numpy.ndarray) -> numpy.ndarray:
        """Of round luminaires, over the zones about a file's γ, whose borders lie half way between them."""
        middles = 0.5 * (gamma[1:] + gamma[:-1])
        low = numpy.concatenate([[max(2 * gamma[0] - middles[0], 0.0)], middles])
        high = numpy.concatenate([middles, [min(2 * gamma[-1] - middles[-1], 180.0)]])
        angles = low[:, None] + (high - low)[:, None] * (numpy.arange(64) + 0.5) / 64
        weights = numpy.sin(numpy.radians(angles))
        result: numpy.ndarray = (numpy.interp(angles, self.polar, self.candela[0]) * weights).sum(axis=1) / weights.sum(axis=1)
        return result


def read(name: str) -> Expected:
    """The kept figures."""
    words = json.loads((FOLDER / f"{name}.json").read_text())
    arrays = {key: numpy.array(words[key], float) for key in ("planes", "polar", "candela", "error")}
    return Expected(words["how"], ratio=words["ratio"], cell=words.get("cell"), **arrays)


def main(names: list[str]) -> None:
    """Reckons and keeps them."""
    import guide
    import lens
    import opal
    import reflector
    import shell

    oracles = {
        "reflector": reflector.expected,
        "lens": lens.expected,
        "guide": guide.expected,
        "opal": opal.expected,
        "shell": shell.expected,
        "screened_shell": shell.screened,
    }
    for name in names or oracles:
        found = oracles[name]()
        found.write(name)
        print(
            f"{name}: peak {found.candela.max():.6g} cd, largest error {(found.error / found.candela.max()).max():.1e} of it; {found.how}"
        )


if __name__ == "__main__":
    main(sys.argv[1:])

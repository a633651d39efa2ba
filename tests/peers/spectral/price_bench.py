"""What `--spectral` costs beside red, green and blue: `price_bench.py [--samples 64] [--seeds 6] [--width 160] [scene ...]`.

Both render each scene in turns, by so many seeds. Time is the processor's, the median of pairs; variance is that of luminance between seeds at equal samples, over
the mean squared, without the thousandth of the pixels with most. Noise of colour is how far pixels stray in a* and b* of CIE Lab, root mean square over
seeds: the median pixel and the one that 95 of 100 are below. Lab's white is D65 of the luminance that 95 of 100 pixels are below. The table is out/peers/spectral-price.md.
"""

import argparse
import sys
from dataclasses import dataclass, field
from pathlib import Path
from statistics import median

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parents[1] / "validate")]

import gonio  # noqa: E402
import numpy  # noqa: E402
from price_scenes import ROOT, SCENES, rendered, rgb  # noqa: E402
from processor import processor_seconds  # noqa: E402

LUMINANCE = numpy.array([0.2126390, 0.7151687, 0.0721923])
XYZ = numpy.array([[0.4123908, 0.3575843, 0.1804808], LUMINANCE, [0.0193308, 0.1191948, 0.9505322]])
# The share of the pixels with the most variance that is left out.
OUTLIERS = 0.001
HEADS = ["scene", "time", "variance of luminance", "stray a*b*, RGB", "spectral", "of 95 %, RGB", "spectral"]


@dataclass
class Way:
    """A scene in colour or by wavelength; trees and tables are kept from picture to picture."""

    scene: gonio.Scene
    previous: gonio.Render | None = None
    seconds: list[float] = field(default_factory=list)
    pictures: list[numpy.ndarray] = field(default_factory=list)

    def render(self, seed: int) -> None:
        before = processor_seconds()
        self.scene.set(seed=seed)
        self.previous = rendered(self.scene, self.previous)
        self.seconds.append(processor_seconds() - before)
        self.pictures.append(rgb(self.previous))


def variance(pictures: numpy.ndarray) -> float:
    """Of luminance between pictures, over its mean squared."""
    luminance = pictures @ LUMINANCE
    found = numpy.sort((luminance.var(axis=0, ddof=1) / (luminance.mean(axis=0) + 0.01 * luminance.mean()) ** 2).ravel())
    return float(found[: len(found) - max(round(OUTLIERS * len(found)), 1)].mean())


def lab(pictures: numpy.ndarray, white: float) -> numpy.ndarray:
    """CIE Lab of linear Rec.709."""
    shown = pictures @ XYZ.T / (white * XYZ.sum(axis=1))
    root = numpy.where(shown > (6 / 29) ** 3, numpy.cbrt(shown), shown / (3 * (6 / 29) ** 2) + 4 / 29)
    return numpy.stack([116 * root[..., 1] - 16, 500 * (root[..., 0] - root[..., 1]), 200 * (root[..., 1] - root[..., 2])], axis=-1)


def stray(pictures: numpy.ndarray, white: float) -> list[float]:
    """How far pixels stray in a* and b*: the median, and what 95 of 100 are below."""
    spread = numpy.sqrt(lab(pictures, white)[..., 1:].var(axis=0, ddof=1).sum(axis=-1))
    return [float(numpy.quantile(spread, share)) for share in (0.5, 0.95)]


def held(name: str, asked: argparse.Namespace) -> str:
    """A line of the table."""
    ways = []
    for spectral in (False, True):
        scene = SCENES[name]()
        width, height = scene.resolution
        scene.set(width=asked.width, height=max(round(asked.width * height / width), 1), samples=asked.samples, threads=asked.threads)
        scene.set(passes=["color"], spectral=spectral, film_transparent=False, noise_threshold=0.0)
        ways.append(Way(scene))
    for seed in range(asked.seeds + 1):
        for way in ways:
            way.render(seed)
    # The first builds trees and tables.
    times = [after / before for before, after in zip(*(way.seconds[1:] for way in ways), strict=True)]
    colour, spectral = (numpy.array(way.pictures[1:]) for way in ways)
    white = float(numpy.quantile((colour @ LUMINANCE).mean(axis=0), 0.95))
    strays = zip(stray(colour, white), stray(spectral, white), strict=True)
    cells = [median(times), variance(spectral) / variance(colour), *(value for pair in strays for value in pair)]
    return "| " + " | ".join([name, *(f"{cell:.2f}" for cell in cells)]) + " |"


def main() -> None:
    """Holds the scenes one after the other."""
    parser = argparse.ArgumentParser(description="What spectral pictures cost beside those in red, green and blue.")
    parser.add_argument("scenes", nargs="*", metavar="scene", help=f"which of {', '.join(SCENES)}; all without any")
    parser.add_argument("--samples", type=int, default=64, help="a pixel")
    parser.add_argument("--seeds", type=int, default=6, help="pictures of each")
    parser.add_argument("--width", type=int, default=160, help="of pictures, pixels")
    parser.add_argument("--threads", type=int, default=1)
    asked = parser.parse_args()
    if unknown := set(asked.scenes) - set(SCENES):
        parser.error(f"no such scene: {', '.join(sorted(unknown))}")
    table = ["| " + " | ".join(HEADS) + " |", "|" + " --- |" * len(HEADS)]
    print("\n".join(table), flush=True)
    for name in asked.scenes or SCENES:
        table.append(held(name, asked))
        print(table[-1], flush=True)
    out = ROOT / "out" / "peers"
    out.mkdir(parents=True, exist_ok=True)
    (out / "spectral-price.md").write_text("\n".join(table) + "\n")


if __name__ == "__main__":
    main()

"""What spectral pictures cost beside Mitsuba 3: `bench.py [--samples 64] [--rounds 3] [--variants llvm_ad_spectral,scalar_spectral] [room ...]`.

Cost is relative variance times the processor's seconds, the engines taking turns; below 1 gonio is cheaper. `DRJIT_LIBLLVM_PATH` names the
LLVM (19) that Mitsuba's vector mode uses. The table is out/peers/spectral-cost.md.
"""

import argparse
import sys
from collections.abc import Callable
from contextlib import ExitStack
from pathlib import Path
from statistics import median

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "validate")]

import compare  # noqa: E402
import environments  # noqa: E402
import gonio  # noqa: E402
import in_gonio  # noqa: E402
import numpy  # noqa: E402
from coloured_rooms import ROOMS  # noqa: E402
from mitsuba_child import THREADS, Mitsuba  # noqa: E402
from processor import processor_seconds  # noqa: E402

Picture = tuple[numpy.ndarray, float]
Renderer = Callable[[int, int], Picture]
VARIANTS = "llvm_ad_spectral,scalar_spectral"
# The share of the pixels with the most variance that is left out on all sides.
OUTLIERS = 0.001
HEADS = ["room", "engine", "cost of Y", "of X, Y, Z", "variance of Y", "of X, Y, Z", "processor s", "median block"]


class Gonio:
    """A room laid out; trees and tables are kept."""

    def __init__(self, name: str) -> None:
        self.version = f"gonio {gonio.__version__} {gonio.simd_level}"
        self._scene = in_gonio.described(ROOMS[name](), samples=1, threads=THREADS)
        self._previous = in_gonio.rendered(self._scene)

    def render(self, samples: int, seed: int) -> Picture:
        """XYZ and the processor's seconds."""
        before = processor_seconds()
        self._scene.set(samples=samples, seed=seed)
        self._previous = in_gonio.rendered(self._scene, self._previous)
        return in_gonio.xyz(self._previous), processor_seconds() - before


def held(name: str, variants: list[str], samples: int, rounds: int) -> list[list[str]]:
    """Two pictures of each engine a round; lines of the table, gonio's first."""
    with ExitStack() as stack:
        engines: dict[str, Renderer] = {"gonio": Gonio(name).render}
        for variant in variants:
            try:
                peer = stack.enter_context(Mitsuba(name, variant))
            except (environments.Unavailable, RuntimeError) as reason:
                # An LLVM that is absent or unfit ends the process.
                print(f"{variant} is left out: {reason}", file=sys.stderr)
                continue
            engines[variant] = peer.render
        for render in engines.values():
            # Kernels are compiled here, not among the figures.
            render(samples, 0)
        made: dict[str, list[Picture]] = {engine: [] for engine in engines}
        for seed in range(1, 2 * rounds + 1):
            for engine, render in engines.items():
                made[engine].append(render(samples, seed))
    return lines(name, made)


def lines(name: str, made: dict[str, list[Picture]]) -> list[list[str]]:
    """Figures of a room; what is best known of it is the mean of all engines' means."""
    means = {engine: numpy.mean([picture for picture, _ in pictures], axis=0) for engine, pictures in made.items()}
    reference = numpy.mean(list(means.values()), axis=0)
    known = reference + compare.FLOOR * reference.mean(axis=(0, 1))
    figures: dict[str, list[tuple[float, float, float]]] = {}
    for engine, pictures in made.items():
        pairs = zip(pictures[::2], pictures[1::2], strict=True)
        figures[engine] = [(*variances(a[0], b[0], known), 0.5 * (a[1] + b[1])) for a, b in pairs]
    rows = []
    for engine, found in figures.items():
        costs = [median(ours[k] * ours[2] / (each[k] * each[2]) for ours, each in zip(figures["gonio"], found, strict=True)) for k in (0, 1)]
        middle = [median(each[k] for each in found) for k in range(3)]
        apart = compare.difference(means["gonio"], means[engine]).median
        cells = [*(f"{cost:.3f}" for cost in costs), *(f"{value:.2e}" for value in middle[:2]), f"{middle[2]:.2f}", f"{apart:.2%}"]
        rows.append([name, engine, *cells])
    return rows


def variances(first: numpy.ndarray, second: numpy.ndarray, known: numpy.ndarray) -> tuple[float, float]:
    """Relative variances of one picture's pixels, without outliers: of Y, and the mean of X, Y and Z."""
    # The difference of two has twice the variance of one.
    squares = numpy.sort((0.5 * ((first - second) / known) ** 2).reshape(-1, 3), axis=0)
    kept = squares[: len(squares) - round(OUTLIERS * len(squares))].mean(axis=0)
    return float(kept[1]), float(kept.mean())


def main() -> None:
    """Holds the rooms one after the other."""
    parser = argparse.ArgumentParser(description="Cost of spectral pictures in gonio and in Mitsuba, in the same rooms.")
    parser.add_argument("rooms", nargs="*", metavar="room", help=f"which of {', '.join(ROOMS)}; all without any")
    parser.add_argument("--samples", type=int, default=64, help="a pixel, the same for all; a square")
    parser.add_argument("--rounds", type=int, default=3, help="pairs of pictures of each engine")
    parser.add_argument("--variants", default=VARIANTS, help="Mitsuba's, with commas between them")
    asked = parser.parse_args()
    if unknown := set(asked.rooms) - set(ROOMS):
        parser.error(f"no such room: {', '.join(sorted(unknown))}")
    table = ["| " + " | ".join(HEADS) + " |", "|" + " --- |" * len(HEADS)]
    for name in asked.rooms or ROOMS:
        for cells in held(name, asked.variants.split(","), asked.samples, asked.rounds):
            table.append("| " + " | ".join(cells) + " |")
            print(table[-1], flush=True)
    out = environments.ROOT / "out" / "peers"
    out.mkdir(parents=True, exist_ok=True)
    (out / "spectral-cost.md").write_text("\n".join(table) + "\n")


if __name__ == "__main__":
    main()

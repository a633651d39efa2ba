"""Noise of a rainbow at equal wall time, in gonio and in LuxCore: `prism_bench.py [scene ...] [--seconds 20] [--rounds 3] [--engines gonio luxcore]`.

Scenes are those of `scenes/prism.py`. The engines take turns; each round has two pictures of each. Figures are of luminance in the lit pixels of the
compared part, over the mean square of what the engine's own scheme of colours has there in closed form: variance from how the two pictures differ,
error of a pixel and of squares of pixels against that closed form. `GONIO_PEER_LUXCORE` names a Python that has pyluxcore. Medians go to
out/peers/prism.md, pictures beside it.
"""

import argparse
import os
import sys
from pathlib import Path
from statistics import mean, median

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), *(str(HERE.parent / other) for other in ("caustics", "render")), str(HERE.parents[1] / "validate")]

import compare  # noqa: E402
import numpy  # noqa: E402
import on_screen  # noqa: E402
import through_prism  # noqa: E402
from description import described  # noqa: E402
from peer import ROOT, Entrant, Peer, Unavailable  # noqa: E402

OUT = ROOT / "out" / "peers"
ENTRANTS = (
    "gonio:spectral=true,integrator=light",
    "gonio:spectral=true,caustics=on",
    "luxcore:LIGHTCPU",
    "luxcore:LIGHTCPU+metropolis",
    "luxcore:BIDIRCPU",
    "luxcore:BIDIRCPU+metropolis",
    "luxcore:PATHCPU+hybrid",
    "luxcore:PATHCPU+photons@0.002",
)
HEADS = ["scene", "engine", "seconds", "processor s", "variance", "variance × processor s", "over gonio's first", "error", "error of squares"]


def main() -> int:
    """1 where an engine cannot be had."""
    parser = argparse.ArgumentParser(description="Noise of a rainbow at equal wall time.")
    parser.add_argument("scenes", nargs="*", default=["spot_flint", "sun_flint"], metavar="scene")
    parser.add_argument("--seconds", type=float, default=20.0, help="a picture")
    parser.add_argument("--rounds", type=int, default=3, help="pairs of pictures of each")
    parser.add_argument("--engines", nargs="+", default=[""], help="only those whose names start so")
    parser.add_argument("--threads", type=int, default=2)
    asked = parser.parse_args()
    entrants = [entrant for entrant in ENTRANTS if entrant.startswith(tuple(asked.engines))]
    OUT.mkdir(parents=True, exist_ok=True)
    table = ["| " + " | ".join(HEADS) + " |", "|" + " --- |" * len(HEADS)]
    for name in asked.scenes:
        try:
            table += held(name, entrants, asked)
        except Unavailable as reason:
            print(reason, file=sys.stderr)
            return 1
        (OUT / "prism.md").write_text("\n".join([*table, "", f"Load of the machine: {os.getloadavg()}"]) + "\n")
    print("\n".join(table))
    return 0


def held(name: str, entrants: list[str], asked: argparse.Namespace) -> list[str]:
    """Lines of a scene."""
    scene = described(f"prism.{name}")
    bins = {engine: scheme(scene) for engine, scheme in through_prism.SCHEMES.items()}
    found: dict[str, list[list[float]]] = {entrant: [] for entrant in entrants}
    for seed in range(1, asked.rounds + 1):
        for entrant, figures in found.items():
            with Peer(Entrant(entrant, f"prism.{name}"), threads=asked.threads) as peer:
                peer.calibrate(asked.seconds)
                pair = [peer.render(2 * seed + half) for half in (0, 1)]
            pictures = [picture.values for picture in pair]
            noise = on_screen.noise(pictures, bins[entrant.partition(":")[0]], on_screen.view(scene))
            spent = [mean(picture.seconds for picture in pair), mean(picture.processor for picture in pair)]
            figures.append([*spent, noise.variance, noise.variance * spent[1], noise.error, noise.squares])
            print(name, entrant, *(f"{figure:.4g}" for figure in figures[-1]), file=sys.stderr, flush=True)
            write(OUT / f"prism-{name}-{entrant.replace(':', '-')}.png", 0.5 * (pictures[0] + pictures[1]))
    middle = {entrant: [median(column) for column in zip(*figures, strict=True)] for entrant, figures in found.items()}
    ours = next(iter(middle.values()))
    rows = []
    for entrant, (seconds, processor, variance, cost, error, squares) in middle.items():
        cells = [f"{seconds:.1f}", f"{processor:.1f}", f"{variance:.3g}", f"{cost:.3g}", f"{cost / ours[3]:.3g}", f"{error:.3g}", f"{squares:.3g}"]
        rows.append("| " + " | ".join([name, entrant, *cells]) + " |")
    return rows


def write(file: Path, picture: numpy.ndarray) -> None:
    """The picture, three times as large; its brightest part is white."""
    shown = compare.encoded(picture / max(float(numpy.quantile(picture.max(axis=2), 0.985)), 1e-9))
    compare.write_png(file, (shown * 255 + 0.5).astype("u1").repeat(3, axis=0).repeat(3, axis=1))


if __name__ == "__main__":
    sys.exit(main())

"""All contestants at equal wall time on the hard scenes: `bench.py [scene ...] [--seconds 8 24] [--rounds 3] [--engines gonio luxcore]`.

References come first: `references.py`. `GONIO_CAUSTICS` has the settings of gonio with light paths (`lineup.py`), `DRJIT_LIBLLVM_PATH` names the
LLVM of Mitsuba's vector mode. Prints the table; figures and pictures are kept in out/peers/caustics.
"""

import argparse
import json
import os
import sys
from pathlib import Path
from typing import Any

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render"), str(HERE.parents[1] / "validate")]

import compare  # noqa: E402
import numpy  # noqa: E402
from errors import LUMINANCE, error  # noqa: E402
from lineup import SCENES, entrants  # noqa: E402
from peer import Entrant, Peer, Unavailable  # noqa: E402
from references import kept  # noqa: E402

OUT = HERE.parents[2] / "out" / "peers" / "caustics"
HEADS = [
    "scene",
    "engine",
    "budget s",
    "seconds",
    "samples",
    "rMSE",
    "without outliers",
    "over gonio",
    "of blocks",
    "blocks",
    "mean",
    "black blocks",
]


def main() -> int:
    """1 where a reference is missing."""
    parser = argparse.ArgumentParser(description="Error at equal time on scenes full of caustics.")
    parser.add_argument("scenes", nargs="*", metavar="scene", help=f"which of {', '.join(SCENES)}; all without any")
    parser.add_argument("--seconds", type=float, nargs="+", default=[8.0, 24.0], help="budgets a picture")
    parser.add_argument("--rounds", type=int, default=1, help="pictures of each, the contestants taking turns")
    parser.add_argument("--engines", nargs="+", help="only those whose names start so; gonio takes part always")
    parser.add_argument("--threads", type=int, default=2)
    asked = parser.parse_args()
    rows: list[dict[str, Any]] = []
    for scene in asked.scenes or SCENES:
        found = kept(scene)
        if found is None:
            print(f"{scene}: no reference, see references.py", file=sys.stderr)
            return 1
        reference, halves = found
        rows.append(of_reference(scene, reference, halves))
        engines = [e for e in entrants(scene) if e.startswith(("gonio", *(asked.engines or [""])))]
        rows += held(scene, engines, reference, asked)
        OUT.mkdir(parents=True, exist_ok=True)
        (OUT / "caustics.json").write_text(json.dumps({"load": os.getloadavg(), "rows": rows}, indent=1))
    print(text(rows))
    return 0


def held(scene: str, engines: list[str], reference: numpy.ndarray, asked: argparse.Namespace) -> list[dict[str, Any]]:
    """Rows of a scene; each engine's errors are means over its pictures."""
    found: dict[tuple[str, float], list[dict[str, Any]]] = {}
    shown: dict[str, numpy.ndarray] = {}
    for seed in range(1, asked.rounds + 1):
        for engine in engines:
            try:
                with Peer(Entrant(engine, scene), threads=asked.threads) as peer:
                    for seconds in asked.seconds:
                        peer.calibrate(seconds)
                        picture = peer.render(seed)
                        shown[engine] = picture.values
                        figures = {"seconds": picture.seconds, "samples": picture.samples, **vars(error(picture.values, reference))}
                        found.setdefault((engine, seconds), []).append(figures)
                        print(f"{scene} {engine} {seconds:g} s: rMSE {figures['whole']:.3g}", file=sys.stderr, flush=True)
            except Unavailable as reason:
                print(f"{engine} is left out of {scene}: {reason}", file=sys.stderr, flush=True)
    write_strip(OUT / f"{scene}.png", reference, list(shown.values()))
    rows = []
    for (engine, seconds), each in found.items():
        middle = {name: float(numpy.mean([figures[name] for figures in each])) for name in each[0]}
        rows.append({"scene": scene, "engine": engine, "budget": seconds, **middle, "rounds": each})
    for row in rows:
        ours = next(other for other in rows if other["engine"] == "gonio" and other["budget"] == row["budget"])
        row["over"] = row["whole"] / ours["whole"]
    return rows


def of_reference(scene: str, reference: numpy.ndarray, halves: numpy.ndarray) -> dict[str, Any]:
    """The reference's own error, from its halves: half their difference is as large as the error of their mean."""
    own = error(reference + 0.5 * (halves[0] - halves[1]), reference)
    return {"scene": scene, "engine": "the reference itself", "budget": 0.0, "seconds": 0.0, "samples": 0, **vars(own), "over": 0.0}


def write_strip(file: Path, reference: numpy.ndarray, pictures: list[numpy.ndarray]) -> None:
    """The reference and all pictures in a row, as in the table."""
    exposure = 1.0 / max(float(numpy.quantile(reference @ LUMINANCE, 0.97)), 1e-9)
    row = numpy.concatenate([compare.encoded(numpy.nan_to_num(picture) * exposure) for picture in (reference, *pictures)], axis=1)
    compare.write_png(file, (row * 255 + 0.5).astype("u1"))


def text(rows: list[dict[str, Any]]) -> str:
    """The table in columns."""
    table = [HEADS]
    for row in rows:
        cells = [row["scene"], row["engine"], f"{row['budget']:g}", f"{row['seconds']:.1f}", f"{row['samples']:.0f}"]
        cells += [f"{row[name]:.3g}" for name in ("whole", "without_outliers", "over", "coarse")]
        table.append([*cells, *(f"{row[name]:.2%}" for name in ("blocks", "mean", "black"))])
    widths = [max(len(line[column]) for line in table) for column in range(len(HEADS))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(line, widths, strict=True)).rstrip() for line in table)


if __name__ == "__main__":
    sys.exit(main())

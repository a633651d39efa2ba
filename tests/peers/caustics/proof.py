"""The maps that make references against Mitsuba's path tracing, on a scene that both find: prints the difference of blocks in JSON.

Run by a Python that has `mitsuba`: `proof.py [--photons 8e6] [--samples 484]`.
"""

import argparse
import json
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render"), str(HERE.parents[1] / "validate")]

import compare  # noqa: E402
from description import described  # noqa: E402
from references import half  # noqa: E402


def main() -> None:
    """Two halves of each, for their noise."""
    parser = argparse.ArgumentParser()
    parser.add_argument("--photons", type=float, default=8e6)
    parser.add_argument("--samples", type=int, default=484)
    asked = parser.parse_args()
    ours = [half("proof", seed, asked.photons / 2, asked.samples // 2) for seed in (0, 1)]
    # After the maps, which choose the variant.
    from engine_mitsuba import Engine

    engine = Engine(described("proof"), 2, "llvm_ad_rgb")
    theirs = [engine.render(asked.samples, seed)[0] for seed in (1, 2)]
    mine, other = (compare.measured(*pair, 0, 0.0) for pair in (ours, theirs))
    print(json.dumps({"noise": [mine.noise, other.noise], **vars(compare.difference(mine.image, other.image))}))


if __name__ == "__main__":
    main()

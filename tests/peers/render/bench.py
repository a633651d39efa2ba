"""Rendering against Cycles and Mitsuba 3 on identical scenes: `bench.py [--seconds 60] [--rounds 5] [contest ...]`.

`DRJIT_LIBLLVM_PATH` names the LLVM (19) that Mitsuba's vector mode uses. The page is out/peers/index.html.
"""

import argparse
import json
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "validate")]

import page  # noqa: E402
from contest import CONTESTS, held  # noqa: E402


def main() -> int:
    """Holds the contests; 1 if blocks do not agree somewhere."""
    known = [contest.name for contest in CONTESTS]
    parser = argparse.ArgumentParser(description="Cost of rendering in gonio, in Cycles and in Mitsuba, on identical scenes.")
    parser.add_argument("contests", nargs="*", metavar="contest", help=f"which of {', '.join(known)}; all without any")
    parser.add_argument("--seconds", type=float, default=10.0, help="seconds a picture, the same for all")
    parser.add_argument("--rounds", type=int, default=3, help="pairs of pictures of each engine")
    parser.add_argument("--scale", type=float, default=1.0, help="of the picture's sides; they must stay multiples of 16 pixels")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--json", action="store_true", help="print the figures for machines")
    asked = parser.parse_args()
    if unknown := set(asked.contests) - set(known):
        parser.error(f"no such contest: {', '.join(sorted(unknown))}")
    results = []
    for contest in CONTESTS:
        if contest.name in (asked.contests or known):
            limits = {"seconds": asked.seconds, "rounds": asked.rounds, "scale": asked.scale, "threads": asked.threads}
            results.append(held(contest, **limits, say=lambda line: print(line, file=sys.stderr, flush=True)))
    found = page.summary(results, asked.seconds)
    page.write(results, found)
    print(json.dumps(found) if asked.json else page.text(found))
    return 0 if all(row["agrees"] for row in found["entrants"]) else 1


if __name__ == "__main__":
    sys.exit(main())

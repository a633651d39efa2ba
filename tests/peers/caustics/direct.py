"""Whether lamps are equally strong everywhere: `direct.py [scene ...]` renders each scene without its casters, by direct light alone.

Prints the mean of each engine's picture over gonio's without the brightest pixels (lamps that are seen), and how far blocks that are lit
differ; fails where either is more than 1 % off.
"""

import argparse
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render"), str(HERE.parents[1] / "validate")]

import compare  # noqa: E402
import numpy  # noqa: E402
from lineup import IN_THE_SUN, SCENES  # noqa: E402
from peer import Entrant, Peer, Unavailable  # noqa: E402

# Relative.
MOST = 0.01
# The share of pixels that counts, the darkest.
COUNTED = 0.98
LUMINANCE = numpy.array([0.2126, 0.7152, 0.0722])


def main() -> int:
    """1 if a mean is off."""
    parser = argparse.ArgumentParser(description="Direct light of the hard scenes in all renderers.")
    parser.add_argument("scenes", nargs="*", metavar="scene", help=f"which of {', '.join(SCENES)}; all without any")
    parser.add_argument("--seconds", type=float, default=2.0, help="seconds a picture")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--pictures", type=Path, help="a folder for the pictures as arrays")
    asked = parser.parse_args()
    is_held = True
    for scene in asked.scenes or SCENES:
        ours = None
        for engine in engines(scene):
            try:
                with Peer(Entrant(engine, f"{scene}.bare"), threads=asked.threads) as peer:
                    peer.calibrate(asked.seconds)
                    picture = peer.render(1).values
            except Unavailable as reason:
                print(f"{scene:12}{engine:32}left out: {reason}", flush=True)
                continue
            if asked.pictures:
                asked.pictures.mkdir(parents=True, exist_ok=True)
                numpy.save(asked.pictures / f"{scene}-{engine.replace(':', '-')}.npy", picture)
            ours = picture if ours is None else ours
            ratio, blocks = held_against(picture, ours)
            is_held &= abs(ratio - 1.0) < MOST and blocks < MOST
            print(f"{scene:12}{engine:32}{ratio:9.4f}  blocks {blocks:7.2%}", flush=True)
    return 0 if is_held else 1


def held_against(picture: numpy.ndarray, ours: numpy.ndarray) -> tuple[float, float]:
    """The ratio of the means, and the median difference of blocks brighter than a tenth of the mean."""
    luminance, known = picture @ LUMINANCE, ours @ LUMINANCE
    counted = known <= numpy.quantile(known, COUNTED)
    theirs, mine = (compare.blocks(image[..., None]) for image in (luminance, known))
    lit = mine > 0.1 * known[counted].mean()
    return float(luminance[counted].mean() / known[counted].mean()), float(numpy.median(abs(theirs[lit] / mine[lit] - 1.0)))


def engines(scene: str) -> list[str]:
    """One of each renderer, and Mitsuba's particles where they work."""
    return ["gonio", "cycles", "mitsuba:llvm_ad_rgb", "luxcore:PATHCPU", *([] if scene in IN_THE_SUN else ["mitsuba:llvm_ad_rgb+ptracer"])]


if __name__ == "__main__":
    sys.exit(main())

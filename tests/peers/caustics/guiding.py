"""Path guiding beside none at equal processor time: `guiding.py [scene ...] [--samples 64 256] [--rounds 3] [--reference 16384]`.

Needs gonio alone. References are long renders without guiding, kept in out/peers/guiding. Time is the processor's, learning included, so
that other work on the machine counts little. Prints for each scene and number of samples: relative squared errors, times, what was learned,
and the ratio of error × time: how many times less time guiding takes for the same error.
"""

import argparse
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render"), str(HERE.parents[1] / "validate")]

import engine_gonio  # noqa: E402
import gonio  # noqa: E402
import numpy  # noqa: E402
from bench import write_strip  # noqa: E402
from description import described  # noqa: E402
from errors import error  # noqa: E402
from references import fingerprint  # noqa: E402

OUT = HERE.parents[2] / "out" / "peers" / "guiding"
SCENES = ("door_ajar", "cove", "small_window", "louvres", "cornell", "diffuse_room", "nine_lights", "glass", "hall")


class Contestant:
    """A scene laid out once."""

    def __init__(self, name: str, threads: int) -> None:
        self._scene = engine_gonio.Engine(described(name), threads)

    def render(self, samples: int, seed: int, guiding: str) -> tuple[numpy.ndarray, float, str]:
        """A picture, its processor seconds, and what was told of guiding."""
        scene = self._scene
        scene._scene.set(samples=samples, seed=seed, guiding=guiding)
        render = gonio.Render(scene._scene, scene._previous)
        start = time.process_time()
        render.wait()
        seconds = time.process_time() - start
        scene._previous = render
        return engine_gonio.colour(render.film()), seconds, render.guiding or ""


def reference(name: str, contestant: Contestant, samples: int) -> numpy.ndarray:
    """A long render without guiding, made where none is kept."""
    file = OUT / f"{name}.npz"
    if file.exists():
        found = numpy.load(file)
        if str(found["of"]) == fingerprint(name) and int(found["samples"]) >= samples:
            kept: numpy.ndarray = found["picture"]
            return kept
    picture, seconds, _ = contestant.render(samples, 1000, "off")
    OUT.mkdir(parents=True, exist_ok=True)
    numpy.savez(file, picture=picture, of=fingerprint(name), samples=samples)
    print(f"{name}: reference in {seconds:.0f} s", file=sys.stderr, flush=True)
    return picture


def main() -> None:
    """Prints the table."""
    parser = argparse.ArgumentParser(description="Path guiding beside none at equal processor time.")
    parser.add_argument("scenes", nargs="*", metavar="scene", help=f"which of {', '.join(SCENES)}; all without any")
    parser.add_argument("--samples", type=int, nargs="+", default=[64, 256])
    parser.add_argument("--rounds", type=int, default=3, help="pictures of each, taking turns")
    parser.add_argument("--reference", type=int, default=16384, help="samples of references")
    parser.add_argument("--guiding", nargs="+", default=["on"], help="on, auto, or both")
    parser.add_argument("--threads", type=int, default=2)
    asked = parser.parse_args()
    for name in asked.scenes or SCENES:
        contestant = Contestant(name, asked.threads)
        known = reference(name, contestant, asked.reference)
        for samples in asked.samples:
            compare(name, contestant, known, samples, asked)


def compare(name: str, contestant: Contestant, known: numpy.ndarray, samples: int, asked: argparse.Namespace) -> None:
    """Rows of one scene and number of samples."""
    found: dict[str, list[list[float]]] = {}
    told, shown = {}, {}
    for seed in range(1, asked.rounds + 1):
        for guiding in ("off", *asked.guiding):
            picture, seconds, told[guiding] = contestant.render(samples, seed, guiding)
            made = error(picture, known)
            found.setdefault(guiding, []).append([made.whole, made.without_outliers, made.mean, seconds])
            shown[guiding] = picture
    write_strip(OUT / f"{name}_{samples}.png", known, list(shown.values()))
    means = {guiding: numpy.mean(rows, axis=0) for guiding, rows in found.items()}
    off = means["off"]
    for guiding, (whole, inner, mean, seconds) in means.items():
        gain = off[0] * off[3] / (whole * seconds)
        print(
            f"{name:13} {samples:5} {guiding:5} rMSE {whole:8.4f}, without outliers {inner:8.4f}, mean {mean:+.2%}, {seconds:7.2f} s "
            f"({seconds / off[3]:.2f} x), worth {gain:.2f} x  {told[guiding]}",
            flush=True,
        )


if __name__ == "__main__":
    main()

"""Light paths and rays a second of Mitsuba's `ptracer` where light alone is followed, and of a command of gonio's on the same stage.

    rays.py [--scenes louvres.alone lens] [--seconds 10] [--gonio COMMAND]

Run by a Python that has `mitsuba`. Mitsuba does not count rays: how many segments a light path has is counted by a walk of the same rules (depth,
roulette from the fifth on), and `ptracer`'s connections to the camera, one a vertex, are not counted. gonio's command gets the stage, as many
light paths as `ptracer` followed, and a file name; its seconds are those of the whole command, and what it prints is shown. It has to trace them
all: `gonio goniometer {stage} --luminaire /World --rays {paths} --error 0 -o {out}.ldt`.
"""

import argparse
import shlex
import subprocess
import sys
import tempfile
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), str(HERE.parent / "render"), str(HERE.parents[1] / "validate")]

from description import described  # noqa: E402

# In scalar mode with two threads `ptracer` of Mitsuba 3.9 stops for good after a few samples.
VARIANTS = ("llvm_ad_rgb",)
# Light paths of the walk that counts.
COUNTED = 1_000_000


def main() -> None:
    """Prints a row a scene and an engine."""
    parser = argparse.ArgumentParser(description="Rays a second where light alone is followed.")
    parser.add_argument("--scenes", nargs="+", default=["louvres.alone", "lens"])
    parser.add_argument("--seconds", type=float, default=10.0)
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--gonio", help="a command with {stage}, {paths} and {out}")
    asked = parser.parse_args()
    for name in asked.scenes:
        segments, paths = segments_of(name), 0
        print(f"{name}: {segments:.3f} segments a light path")
        for variant in VARIANTS:
            seconds, paths = particles(name, variant, asked.seconds, asked.threads)
            print(row(f"ptracer, {variant}", paths, seconds, segments), flush=True)
        if asked.gonio:
            seconds, said = run(asked.gonio, name, paths)
            print(row("gonio", paths, seconds, segments))
            print(said, flush=True)


def row(who: str, paths: int, seconds: float, segments: float) -> str:
    """Millions a second."""
    return f"  {who:24}{paths:12d} light paths in {seconds:8.2f} s: {paths / seconds / 1e6:8.3f} M/s, {segments * paths / seconds / 1e6:8.3f} M segments/s"


def particles(name: str, variant: str, wanted: float, threads: int) -> tuple[float, int]:
    """Seconds of `ptracer` without compiling, and its light paths: as many a pixel as samples."""
    from engine_mitsuba import Engine

    scene = described(name)
    engine = Engine(scene, threads, f"{variant}+ptracer")
    samples, seconds = 4, 0.0
    while seconds < wanted / 4.0:
        _, seconds, samples = engine.render(4 * samples, 1)
    _, seconds, samples = engine.render(max(1, round(samples * wanted / seconds)), 2)
    return seconds, samples * scene.width * scene.height


def segments_of(name: str) -> float:
    """Mean segments of a light path, the last one into the void with them."""
    import maps

    scene = described(name)
    with tempfile.TemporaryDirectory() as folder:
        return maps.walked(maps.World(scene, folder, 1.0), COUNTED) / COUNTED


def run(command: str, name: str, paths: int) -> tuple[float, str]:
    """Seconds of a command on the scene's stage, and what it printed."""
    from usd_stage import stage

    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / "stage.usda"
        file.write_text(stage(described(name)))
        words = [word.format(stage=file, paths=paths, out=Path(folder) / "out") for word in shlex.split(command)]
        start = time.perf_counter()
        done = subprocess.run(words, capture_output=True, text=True, check=False)
        seconds = time.perf_counter() - start
    return seconds, "".join(f"    {line}\n" for line in (done.stdout + done.stderr).splitlines()[-12:])


if __name__ == "__main__":
    main()

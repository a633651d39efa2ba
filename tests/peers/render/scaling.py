"""How the time of a path grows with triangles, instances, lights, pixels and threads: `scaling.py [--samples 4] [curve ...]`.

Prints processor time and writes curves to out/peers/scaling.svg. Each point is the median of three renders after one that does not count.
"""

import argparse
import dataclasses
import math
import statistics
import sys
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[2] / "validate")]

import numpy  # noqa: E402
from cornell import Diffuse  # noqa: E402
from description import Camera, Scene, described  # noqa: E402
from engine_gonio import Engine  # noqa: E402
from processor import processor_seconds  # noqa: E402
from scenes import field, hall  # noqa: E402
from shapes import facing, sheet, sky  # noqa: E402

PAGE = Path(__file__).resolve().parents[3] / "out/peers/scaling.svg"
WIDTH, HEIGHT, MARGIN = 320, 220, 46


@dataclass(frozen=True)
class Curve:
    """What grows, through which sizes, and the scene (and its threads) of a size."""

    title: str
    sizes: tuple[int, ...]
    scene: Callable[[int], tuple[Scene, int]]


def hills(triangles: int) -> tuple[Scene, int]:
    """Wrinkled ground of so many triangles under a sky."""
    side = math.isqrt(triangles // 2) + 1
    z, x = numpy.meshgrid(numpy.linspace(10, -10, side), numpy.linspace(-10, 10, side), indexing="ij")
    y = 0.6 * numpy.sin(0.7 * x + 0.5) * numpy.cos(0.6 * z) + 0.05 * numpy.sin(9.0 * x) * numpy.sin(8.0 * z)
    ground = sheet("ground", numpy.stack([x, y, z], axis=2), Diffuse((0.5, 0.45, 0.4)))
    return Scene([ground], [], Camera(facing((0.0, 3.0, 12.0), (0.0, 0.0, 0.0)), 45.0), sky(field.TOWARD_SUN)), 1


def plants(count: int) -> tuple[Scene, int]:
    """The field with so many plants."""
    return field.scene(count), 1


def lamps(count: int) -> tuple[Scene, int]:
    """The hall with the lights of so many bays' ten, those around the camera's first."""
    bays = [(column, row) for column in range(hall.COLUMNS) for row in range(hall.ROWS)]
    bays.sort(key=lambda bay: math.hypot(*hall.middle(*bay)))
    return hall.built(bays[: count // 10]), 1


def pixels(side: int) -> tuple[Scene, int]:
    """The Cornell box, so many pixels wide and high."""
    return dataclasses.replace(described("cornell"), width=side, height=side), 1


def threads(count: int) -> tuple[Scene, int]:
    """The car on so many threads."""
    return described("car"), count


CURVES = {
    "triangles": Curve("triangles", (10_000, 100_000, 1_000_000, 4_000_000), hills),
    "instances": Curve("instances", (2_000, 20_000, 200_000), plants),
    "lights": Curve("lights", (10, 100, 1_000, 10_000), lamps),
    "pixels": Curve("pixels a side", (128, 256, 512, 1024), pixels),
    "threads": Curve("threads", (1, 2), threads),
}


def measured(scene: Scene, threads: int, samples: int) -> tuple[float, float]:
    """Microseconds of the processor and of the clock that a camera path takes."""
    engine = Engine(scene, threads)
    engine.render(1, 1)
    taken = []
    for seed in range(3):
        before = processor_seconds()
        _, clock, _ = engine.render(samples, 10 + seed)
        taken.append((processor_seconds() - before, clock))
    paths = samples * scene.width * scene.height * 1e-6
    return statistics.median(p for p, _ in taken) / paths, statistics.median(c for _, c in taken) / paths


def plot(curves: dict[str, list[tuple[int, float]]]) -> str:
    """All curves side by side, both axes logarithmic, as SVG."""
    parts = [drawn(CURVES[name].title, points, number * WIDTH) for number, (name, points) in enumerate(curves.items())]
    head = f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH * len(parts)}" height="{HEIGHT}" font-family="sans-serif" font-size="11">'
    return "\n".join([head, '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>", ""])


def drawn(title: str, points: list[tuple[int, float]], left: int) -> str:
    """One curve in its frame."""
    first, last = math.log(points[0][0]), math.log(points[-1][0])
    least, most = (math.log(f(time for _, time in points)) for f in (min, max))
    # Half an octave of room at least, so that what stays level looks level.
    middle, span = (least + most) / 2, max(most - least, math.log(4.0)) * 1.2
    across, down = WIDTH - 2 * MARGIN, HEIGHT - 2 * MARGIN
    places = [
        (left + MARGIN + across * (math.log(size) - first) / (last - first), MARGIN + down * (0.5 - (math.log(value) - middle) / span))
        for size, value in points
    ]
    line = " ".join(f"{x:.1f},{y:.1f}" for x, y in places)
    texts = [f'<text x="{left + MARGIN}" y="20">µs a path against {title}</text>']
    for (x, y), (size, value) in zip(places, points, strict=True):
        texts.append(f'<circle cx="{x:.1f}" cy="{y:.1f}" r="3"/>')
        texts.append(f'<text x="{x:.1f}" y="{y - 8:.1f}" text-anchor="middle">{value:.3g}</text>')
        texts.append(f'<text x="{x:.1f}" y="{HEIGHT - 18}" text-anchor="middle">{size:,}</text>')
    return f'<polyline points="{line}" fill="none" stroke="#2060b0" stroke-width="2"/>' + "".join(texts)


def main() -> None:
    """Measures the curves asked for."""
    parser = argparse.ArgumentParser(description="Time of a path against the size of what is rendered.")
    parser.add_argument("curves", nargs="*", metavar="curve", help=f"which of {', '.join(CURVES)}; all without any")
    parser.add_argument("--samples", type=int, default=4, help="paths a pixel")
    asked = parser.parse_args()
    if unknown := set(asked.curves) - set(CURVES):
        parser.error(f"no such curve: {', '.join(sorted(unknown))}")
    found: dict[str, list[tuple[int, float]]] = {}
    for name in asked.curves or CURVES:
        for size in CURVES[name].sizes:
            processor, clock = measured(*CURVES[name].scene(size), asked.samples)
            print(f"{size:>10,} {CURVES[name].title}: {processor:.3f} µs of the processor a path, {clock:.3f} µs of the clock", flush=True)
            found.setdefault(name, []).append((size, clock if name == "threads" else processor))
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(plot(found), encoding="utf-8")
    print(f"{PAGE} shows the curves")


if __name__ == "__main__":
    main()

"""How time and memory of heavy scenes grow in Blender, in gonio and in Cycles: `curves.py [curve ...] [--most 64e6]`.

From the file to the first sample, each render in a Blender of its own. Prints rows of a table and writes curves to out/peers/heavy.svg.
"""

import argparse
import math
import sys
from pathlib import Path

from bench import ENGINES, SCENES, run

PAGE = Path(__file__).resolve().parents[3] / "out/peers/heavy.svg"
SIZES = {
    "triangles": (1e6, 4e6, 16e6, 64e6),
    "objects": (1e6, 4e6, 16e6, 40e6),
    "instances": (1e3, 1e4, 1e5, 1e6, 1e7),
    "lights": (1, 100, 10_000, 100_000),
    "textures": (1, 16, 64, 256),
    "pixels": (256, 1024, 4096),
}
COLOURS = {"GONIO": "#2060b0", "CYCLES": "#c07020"}
# Figure -> title, divisor.
FIGURES = {"processor": ("seconds of the processor", 1.0), "peak": ("megabytes", 1e6)}
WIDTH, HEIGHT, MARGIN = 300, 220, 46


def main() -> None:
    """Measures the curves asked for."""
    parser = argparse.ArgumentParser(description="Time and memory of heavy scenes by their size, in gonio and in Cycles.")
    parser.add_argument("curves", nargs="*", metavar="curve", help=f"which of {', '.join(SIZES)}; all without any")
    parser.add_argument("--most", type=float, default=1e9, help="leave out larger sizes")
    parser.add_argument("--threads", type=int, default=2)
    asked = parser.parse_args()
    if unknown := set(asked.curves) - set(SIZES):
        parser.error(f"no such curve: {', '.join(sorted(unknown))}")
    found: dict[str, dict[str, list[tuple[float, dict[str, float]]]]] = {}
    for name in asked.curves or SIZES:
        for size in SIZES[name]:
            if size > asked.most:
                continue
            request = {**SCENES.get(name, {"things": name}), "count": round(size), "threads": asked.threads}
            for engine in ENGINES:
                figures = run(engine, request)
                found.setdefault(name, {}).setdefault(engine, []).append((size, figures))
            print(row(name, size, {engine: found[name][engine][-1][1] for engine in ENGINES}), flush=True)
    PAGE.parent.mkdir(parents=True, exist_ok=True)
    PAGE.write_text(plot(found), encoding="utf-8")
    print(f"{PAGE} shows the curves")


def row(name: str, size: float, found: dict[str, dict[str, float]]) -> str:
    """A row of the table: seconds of the processor and of the clock, megabytes."""
    cells = [f"{found[engine][figure] / by:,.2f}" for figure, by in (("processor", 1.0), ("seconds", 1.0), ("peak", 1e6)) for engine in ENGINES]
    return f"| {name}, {round(size):,} | " + " | ".join(cells) + " |"


def plot(found: dict[str, dict[str, list[tuple[float, dict[str, float]]]]]) -> str:
    """All curves, a column each, in double logarithmic frames as SVG."""
    parts = []
    for column, (name, engines) in enumerate(found.items()):
        for line, (figure, (title, by)) in enumerate(FIGURES.items()):
            corner = column * WIDTH + MARGIN, line * HEIGHT + MARGIN
            parts.append(f'<text x="{corner[0]}" y="{corner[1] - 24}">{title} by {name}</text>')
            parts += frame(corner, {engine: [(size, each[figure] / by) for size, each in rows] for engine, rows in engines.items()})
    size = f'width="{WIDTH * len(found)}" height="{HEIGHT * len(FIGURES)}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="11">'
    return "\n".join([head, '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>", ""])


def frame(corner: tuple[int, int], curves: dict[str, list[tuple[float, float]]]) -> list[str]:
    """The curves of one figure, their last values, and the sizes below."""
    places = [(math.log(size), math.log(max(value, 1e-3))) for rows in curves.values() for size, value in rows]
    (x0, x1), (y0, y1) = ((min(p[axis] for p in places), max(p[axis] for p in places)) for axis in (0, 1))
    across, down = (WIDTH - 2.4 * MARGIN) / max(x1 - x0, 1.0), (HEIGHT - 2 * MARGIN) / max(y1 - y0, 1.0)
    at = lambda size, value: (corner[0] + across * (math.log(size) - x0), corner[1] + down * (y1 - math.log(max(value, 1e-3))))  # noqa: E731
    least = min(curves, key=lambda engine: curves[engine][-1][1])
    parts = []
    for engine, rows in curves.items():
        drawn = " ".join(f"{x:.1f},{y:.1f}" for x, y in (at(*row) for row in rows))
        parts.append(f'<polyline points="{drawn}" fill="none" stroke="{COLOURS[engine]}" stroke-width="2"/>')
        x, y = at(*rows[-1])
        text = f"{engine.title()} {short(rows[-1][1])}"
        parts.append(f'<text x="{x + 6:.1f}" y="{y + (12 if engine == least else -2):.1f}" fill="{COLOURS[engine]}">{text}</text>')
    for size, _ in next(iter(curves.values())):
        x = corner[0] + across * (math.log(size) - x0)
        parts.append(f'<text x="{x:.1f}" y="{corner[1] + HEIGHT - 1.5 * MARGIN:.1f}" text-anchor="middle">{short(size)}</text>')
    return parts


def short(value: float) -> str:
    """A number in few letters."""
    for by, unit in ((1e6, " M"), (1e3, " k")):
        if value >= 10 * by or (value >= by and value % by == 0.0):
            return f"{value / by:.3g}{unit}"
    return f"{value:,.0f}" if value >= 100.0 else f"{value:.3g}"


if __name__ == "__main__":
    sys.exit(main())

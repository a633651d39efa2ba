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
            left, top = column * WIDTH + MARGIN, line * HEIGHT + MARGIN
            curves = {engine: [(math.log(size), math.log(max(each[figure] / by, 1e-3))) for size, each in rows] for engine, rows in engines.items()}
            places = [place for rows in curves.values() for place in rows]
            (x0, x1), (y0, y1) = ((min(p[axis] for p in places), max(p[axis] for p in places)) for axis in (0, 1))
            across, down = (WIDTH - 1.5 * MARGIN) / max(x1 - x0, 1.0), (HEIGHT - 2 * MARGIN) / max(y1 - y0, 1.0)
            parts.append(f'<text x="{left}" y="{top - 16}">{title} by {name}</text>')
            for engine, rows in curves.items():
                at = [(left + across * (x - x0), top + HEIGHT - 2 * MARGIN - down * (y - y0)) for x, y in rows]
                drawn = " ".join(f"{x:.1f},{y:.1f}" for x, y in at)
                parts.append(f'<polyline points="{drawn}" fill="none" stroke="{COLOURS[engine]}" stroke-width="2"/>')
                x, y = at[-1]
                value = math.exp(rows[-1][1])
                lower = engine == min(curves, key=lambda each: curves[each][-1][1])
                parts.append(
                    f'<text x="{x:.1f}" y="{y + (14 if lower else -6):.1f}" text-anchor="end" fill="{COLOURS[engine]}">{engine.title()} {value:,.3g}</text>'
                )
            sizes = [size for size, _ in next(iter(engines.values()))]
            for size in sizes:
                x = left + across * (math.log(size) - x0)
                parts.append(f'<text x="{x:.1f}" y="{top + HEIGHT - 1.5 * MARGIN:.1f}" text-anchor="middle">{size:.0e}</text>'.replace("e+0", "e"))
    size = f'width="{WIDTH * len(found)}" height="{HEIGHT * len(FIGURES)}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="11">'
    return "\n".join([head, '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>", ""])


if __name__ == "__main__":
    sys.exit(main())

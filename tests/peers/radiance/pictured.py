"""The curves as SVG, the figures as text and as the tables of docs/radiance.md."""

import math
from pathlib import Path

import two_rooms
from equal_error import CACHED, GONIO, TRACED, Equal, Row, front
from reference import Reference

ROOT = Path(__file__).resolve().parents[3]
DOCS = ROOT / "docs" / "radiance.md"
DRAWING = ROOT / "docs" / "radiance.svg"
FIRST_MARKER, LAST_MARKER = "<!-- figures: bench.py --write-docs -->", "<!-- end of figures -->"
COLOURS = {GONIO: "#2060b0", TRACED: "#c04010", CACHED: "#d09020"}
WIDTH, HEIGHT, MARGIN = 380, 290, 48
Range = tuple[float, float]


def drawn(rows: list[Row]) -> str:
    """Relative error against processor seconds, both logarithmic, a panel a grid. Lines join what no quicker setting is better than."""
    parts = [panel(rows, grid.name, number * WIDTH) for number, grid in enumerate(two_rooms.GRIDS)]
    size = f'width="{WIDTH * len(parts)}" height="{HEIGHT}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="11">'
    return "\n".join([head, '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>", ""])


def panel(rows: list[Row], grid: str, left: int) -> str:
    """One grid's curves in their frame."""
    across, down = decades([row.seconds for row in rows]), decades([row.errors[grid] for row in rows])

    def x(seconds: float) -> float:
        return left + MARGIN + (WIDTH - 1.5 * MARGIN) * share(seconds, across)

    def y(error: float) -> float:
        return HEIGHT - MARGIN - (HEIGHT - 2 * MARGIN) * share(error, down)

    parts = [f'<text x="{left + MARGIN}" y="18">{grid}: RMS relative error against processor seconds</text>']
    for tick in ticks(across):
        parts.append(f'<path d="M{x(tick):.1f} {y(down[0]):.1f}V{y(down[1]):.1f}" stroke="#ddd"/>')
        parts.append(f'<text x="{x(tick):.1f}" y="{HEIGHT - MARGIN + 16}" text-anchor="middle">{tick:g} s</text>')
    for tick in ticks(down):
        parts.append(f'<path d="M{x(across[0]):.1f} {y(tick):.1f}H{x(across[1]):.1f}" stroke="#ddd"/>')
        parts.append(f'<text x="{left + MARGIN - 5}" y="{y(tick) + 4:.1f}" text-anchor="end">{100 * tick:g} %</text>')
    for number, (curve, colour) in enumerate(COLOURS.items()):
        line = " ".join(f"{x(seconds):.1f},{y(error):.1f}" for seconds, error in front(rows, curve, grid))
        parts.append(f'<polyline points="{line}" fill="none" stroke="{colour}" stroke-width="2"/>')
        places = [(x(row.seconds), y(row.errors[grid])) for row in rows if row.setting.curve == curve]
        parts += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="3" fill="{colour}"/>' for a, b in places]
        parts.append(f'<text x="{left + MARGIN + 80 * number}" y="{HEIGHT - 8}" fill="{colour}">{curve}</text>')
    return "\n".join(parts)


def decades(values: list[float]) -> Range:
    """The powers of ten about values."""
    return 10.0 ** math.floor(math.log10(min(values))), 10.0 ** math.ceil(math.log10(max(values)))


def ticks(limits: Range) -> list[float]:
    """Every power of ten."""
    first, last = (round(math.log10(limit)) for limit in limits)
    return [10.0**power for power in range(first, last + 1)]


def share(value: float, limits: Range) -> float:
    """Where in a range, by its logarithm."""
    low, high = (math.log(limit) for limit in limits)
    return (math.log(value) - low) / (high - low)


def table(head: list[str], lines: list[list[str]], left: int) -> str:
    """Markdown whose first `left` columns stand to the left."""
    rule = ["---" if number < left else "---:" for number in range(len(head))]
    return "\n".join("| " + " | ".join(cells) + " |" for cells in [head, rule, *lines])


def agreements(reference: Reference) -> str:
    """How gonio and the tracer agree, and what is left of uncertainty."""
    head = ["grid", "points", "gonio, lx", "tracer, lx", "apart, standard errors", "squared difference over variance", "left, RMS"]
    lines = []
    for grid in two_rooms.GRIDS:
        found = reference.agreements[grid.name]
        means = f"{found.ours:.2f} ± {found.our_error:.2f}", f"{found.theirs:.2f} ± {found.their_error:.2f}"
        apart = f"{found.apart:.1f} of {found.most:.1f}" + ("" if found.holds else " **no**")
        left = percent(reference.errors[grid.name], ".2f")
        lines.append([grid.name, str(len(grid.points())), *means, apart, f"{found.chi:.2f}", left])
    return table(head, lines, 1)


def runs(rows: list[Row]) -> str:
    """A line a setting."""
    names = [grid.name for grid in two_rooms.GRIDS]
    head = ["engine", "setting", *(f"error, {name}" for name in names), *(f"mean, {name}" for name in names), "processor s"]
    lines = []
    for row in rows:
        figures = [percent(row.errors[name], ".2f") for name in names] + [percent(row.biases[name], "+.2f") for name in names]
        lines.append([row.setting.curve, f"`{row.setting.options}`", *figures, f"{row.seconds:.2f}"])
    return table(head, lines, 2)


def at_equal_error(equals: list[Equal]) -> str:
    """A line an error: seconds of all curves, and Radiance's over gonio's."""
    head = ["grid", "error", *(f"{curve}, s" for curve in COLOURS), f"ratio, {TRACED}", f"ratio, {CACHED}"]
    lines = []
    for equal in equals:
        seconds = [figure(equal.seconds[curve], ".2f") for curve in COLOURS]
        lines.append([equal.grid, percent(equal.error, "g"), *seconds, *(figure(equal.ratio(curve), ".2g") for curve in (TRACED, CACHED))])
    return table(head, lines, 2)


def percent(value: float, form: str) -> str:
    """A share in per cent."""
    return f"{format(100 * value, form)} %"


def figure(value: float | None, form: str) -> str:
    """A dash where there is none."""
    return "–" if value is None else format(value, form)


def text(reference: Reference, rows: list[Row], equals: list[Equal], conditions: str) -> str:
    """All tables."""
    parts = ["Reference:", agreements(reference), "Settings:", runs(rows), "Time at equal error:", at_equal_error(equals), conditions]
    return "\n\n".join(parts)


def write_docs(found: str, rows: list[Row]) -> None:
    """Puts the tables between the page's markers, and the curves beside the page."""
    page = DOCS.read_text(encoding="utf-8")
    before, rest = page.split(FIRST_MARKER)
    after = rest.split(LAST_MARKER)[1]
    curves = f"![Error against processor time]({DRAWING.name})"
    DOCS.write_text(f"{before}{FIRST_MARKER}\n\n{curves}\n\n{found}\n\n{LAST_MARKER}{after}", encoding="utf-8")
    DRAWING.write_text(drawn(rows), encoding="utf-8")

"""The plots of docs/paper.md, drawn from its own tables.

    python docs/site/paper.py [MEASURED]

`MEASURED` is what `gonio bench --paper` printed: its tables replace those of the page first, under the same headings.
"""

from __future__ import annotations

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

DOCS = Path(__file__).resolve().parents[1]
PAGE = DOCS / "paper.md"
COLOURS = ("#9ecae1", "#4292c6", "#084594", "#041f4a")
# Pixels: to the axis, of the longest bar, of a bar, between rows, and above the first row.
AXIS, LONGEST, BAR, GAP, TOP = 170, 500, 9, 9, 62
TABLE = re.compile(r"^## ([^\n]+)\n(?:(?!\||## )[^\n]*\n)*((?:\|[^\n]*\n)+)", re.MULTILINE)
Row = dict[str, str]


def tables(text: str) -> dict[str, list[Row]]:
    """A page's tables by their headings, a dictionary a row; names of columns that come twice get the one before in front."""
    return {found[1]: rows(found[2]) for found in TABLE.finditer(text)}


def rows(table: str) -> list[Row]:
    head, _, *lines = [[cell.strip().strip("*") for cell in line.strip()[1:-1].split("|")] for line in table.splitlines()]
    names = [name if head.count(name) == 1 else f"{head[place - 1]}: {name}" for place, name in enumerate(head)]
    return [dict(zip(names, line, strict=True)) for line in lines]


def replaced(page: str, measured: str) -> str:
    """The page with measured tables in place of those under the same headings."""
    new = {found[1]: found[2] for found in TABLE.finditer(measured)}
    if missing := set(new) - {found[1] for found in TABLE.finditer(page)}:
        raise SystemExit(f"the page has no table under {sorted(missing)}")
    return TABLE.sub(lambda found: found[0].removesuffix(found[2]) + new.get(found[1], found[2]), page)


@dataclass
class Panel:
    """Bars a row and a series, with what they are held against: a mark a row, or a line for all."""

    title: str
    series: list[str]
    bars: list[tuple[str, list[float]]]
    unit: str = ""
    marks: list[float] = field(default_factory=list)
    mark: str = ""
    line: float | None = None
    digits: int = 1

    def height(self) -> int:
        return TOP + len(self.bars) * (len(self.series) * BAR + GAP) + 14


def figure(cell: str) -> float:
    return float(cell.split()[0])


def levels(row: Row, before: str = "") -> dict[str, float]:
    """A row's figures at the SIMD levels, and on one lane where that is the same quantity."""
    of = {name.removeprefix(before): cell for name, cell in row.items() if name.startswith(before)}
    return {name: figure(cell) for name, cell in of.items() if name == "one lane" or re.fullmatch(r"[A-Z0-9.-]+(, \d+ lanes)?", name)}


def speed(page: dict[str, list[Row]]) -> list[Panel]:
    """Tables 1 to 3: how much faster than one lane."""
    panels = []
    for title, lines in page.items():
        if title.startswith(("Table 1", "Table 2", "Table 3")):
            bars = [(row[""], list(levels(row).values())) for row in lines]
            marks = [figure(row["paper, 4 lanes"]) for row in lines]
            name = f"{title}: times as fast as one lane"
            panels.append(Panel(name, list(levels(lines[0])), bars, marks=marks, mark="the paper, 4 lanes"))
    return panels


def rays(page: dict[str, list[Row]]) -> list[Panel]:
    """Table 4: the share of tracing, and the rays of the antialiasing."""
    lines = next(lines for title, lines in page.items() if title.startswith("Table 4"))
    shares = [levels(row, "tracing, ") for row in lines]
    shown = [(row[""], list(share.values())) for row, share in zip(lines, shares, strict=True)]
    counts = [(row[""], [figure(row["camera rays a pixel"])]) for row in lines]
    return [
        Panel("Share of tracing in the time", list(shares[0]), shown, unit=" %", digits=0),
        Panel("Camera rays a pixel", ["adaptive antialiasing"], counts, line=25.0, mark="regular sampling: 25", digits=2),
    ]


def frames(page: dict[str, list[Row]]) -> list[Panel]:
    """Frames a second, where they were measured."""
    for title, lines in page.items():
        if title.startswith("Frames a second"):
            bars = [(row[""], list(levels(row).values())) for row in lines]
            return [Panel(title, list(levels(lines[0])), bars, line=10.0, mark="interactive: 10")]
    return []


def drawn(panels: list[Panel]) -> str:
    """Panels one below the other."""
    parts, top = [], 0
    for panel in panels:
        parts += pictured(panel, top)
        top += panel.height()
    size = f'width="760" height="{top}" viewBox="0 0 760 {top}"'
    head = f'<svg xmlns="http://www.w3.org/2000/svg" {size} font-family="sans-serif" font-size="11">'
    return "\n".join([head, '<rect width="100%" height="100%" fill="white"/>', *parts, "</svg>", ""])


def pictured(panel: Panel, top: int) -> list[str]:
    values = [value for _, several in panel.bars for value in several]
    most = max(*values, *panel.marks, panel.line or 0.0)
    step = next(step for step in (1, 2, 5, 10, 20, 50, 100, 200) if most / step <= 8)
    scale, first, last = LONGEST / most, top + TOP, top + panel.height() - 14

    def x(value: float) -> float:
        return AXIS + value * scale

    parts = [f'<text x="12" y="{top + 20}" font-size="13">{panel.title}</text>', *key(panel, top + 30)]
    for tick in range(0, int(most) + 1, step):
        parts.append(f'<path d="M{x(tick):.1f} {first - 4}V{last}" stroke="#ddd"/>')
        parts.append(f'<text x="{x(tick):.1f}" y="{first - 7}" text-anchor="middle" fill="#666">{tick}{panel.unit}</text>')
    for number, (name, several) in enumerate(panel.bars):
        y = first + number * (len(panel.series) * BAR + GAP) + GAP / 2
        middle = y + len(several) * BAR / 2
        parts.append(f'<text x="{AXIS - 8}" y="{middle + 4:.1f}" text-anchor="end">{name}</text>')
        for place, value in enumerate(several):
            at = y + place * BAR
            parts.append(f'<rect x="{AXIS}" y="{at:.1f}" width="{value * scale:.1f}" height="{BAR - 1}" fill="{colour(panel, place)}"/>')
        if panel.marks:
            place = x(panel.marks[number])
            parts.append(f'<path d="M{place:.1f} {y - 2:.1f}v{len(several) * BAR + 3}" stroke="#d6402b" stroke-width="2"/>')
        # Figures stand on a white edge, so that a mark behind them does not strike them out.
        white = 'font-size="9" stroke="white" stroke-width="3" paint-order="stroke"'
        for place, value in enumerate(several):
            at = y + place * BAR + 8
            parts.append(f'<text x="{x(value) + 4:.1f}" y="{at:.1f}" {white}>{value:.{panel.digits}f}{panel.unit}</text>')
    if panel.line is not None:
        parts.append(f'<path d="M{x(panel.line):.1f} {first - 4}V{last}" stroke="#d6402b" stroke-width="2"/>')
    return parts


def colour(panel: Panel, place: int) -> str:
    """The same for a level in every panel, whether one lane is among them or not."""
    return "#aaaaaa" if panel.series[place] == "one lane" else COLOURS[place - ("one lane" in panel.series)]


def key(panel: Panel, y: int) -> list[str]:
    """What colours and the mark mean."""
    parts = []
    for place, name in enumerate(panel.series):
        x = AXIS + place * 115
        parts.append(f'<rect x="{x}" y="{y}" width="10" height="10" fill="{colour(panel, place)}"/>')
        parts.append(f'<text x="{x + 15}" y="{y + 9}">{name}</text>')
    if panel.mark:
        x = AXIS + max(len(panel.series), 2) * 115
        parts.append(f'<path d="M{x + 5} {y}v10" stroke="#d6402b" stroke-width="2"/><text x="{x + 15}" y="{y + 9}">{panel.mark}</text>')
    return parts


def plots(text: str) -> dict[str, str]:
    """The files beside the page, by name."""
    page = tables(text)
    drawings = {"paper-speed.svg": speed(page), "paper-rays.svg": rays(page), "paper-frames.svg": frames(page)}
    return {name: drawn(panels) for name, panels in drawings.items() if panels}


def main() -> None:
    text = PAGE.read_text(encoding="utf-8")
    if len(sys.argv) > 1:
        text = replaced(text, Path(sys.argv[1]).read_text(encoding="utf-8"))
        PAGE.write_text(text, encoding="utf-8")
    for name, drawing in plots(text).items():
        (DOCS / name).write_text(drawing, encoding="utf-8")
        print(DOCS / name)


if __name__ == "__main__":
    main()

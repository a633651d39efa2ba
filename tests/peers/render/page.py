"""Results as text, as JSON, and as a page with the pictures."""

import html
import json
import os
from pathlib import Path
from statistics import geometric_mean, median
from typing import Any

import compare
from contest import MOST_MEDIAN, Result, Standing
from cost import OUTLIERS

OUT = Path(__file__).resolve().parents[3] / "out" / "peers"
HEADS = ["scene", "engine", "cost ratio", "with outliers", "by processor", "cost", "relative variance", "of a sample"]
HEADS += ["outliers from", "seconds", "samples", "preparation s", "compiling s", "blocks differ", "noise of blocks"]
FIGURES = ("cost", "variance", "sample_variance", "outliers_from", "seconds", "processor")
EXPLANATION = f"""Cost is relative variance × seconds of two pictures with different seeds; a ratio is gonio's cost over the other's, the
median over rounds (less than 1: gonio is cheaper). Variance is that of luminance over the squared luminance of the mean of all pictures,
which has {compare.FLOOR:.0%} of the image's mean added; the {OUTLIERS:.1%} of pixels with the most variance are left out on all sides,
"with outliers" has them. Seconds are those of the samples alone: laying out the scene and compiling kernels stand apart. "By processor"
takes seconds of the processor instead of the clock's. Blocks of {compare.BLOCK} × {compare.BLOCK} pixels: the median relative difference
of gonio's, which must stay below {MOST_MEDIAN:.0%}."""
PAGE = """<!doctype html>
<meta charset="utf-8">
<title>Gonio beside other renderers</title>
<style>
body {{ font: 14px sans-serif; max-width: 84em; margin: auto }}
img {{ image-rendering: pixelated; width: 100% }}
td, th {{ padding: 0.2em 0.6em; text-align: right }}
.over {{ color: #b00 }}
</style>
<h1>Gonio beside other renderers</h1>
<p>{explanation}</p>
<p>{versions}</p>
<table><tr>{heads}</tr>
{rows}
</table>
{pictures}
"""


def figures(result: Result, standing: Standing) -> dict[str, Any]:
    """An entrant's figures by name; of what each round has, medians."""
    ours = result.standings[0]
    middle = {name: median(getattr(cost, name) for cost in standing.costs) for name in FIGURES}
    return {
        "scene": standing.entrant.scene,
        "engine": standing.entrant.engine,
        "version": standing.version,
        "ratio": standing.ratio(ours, lambda cost: cost.cost),
        "ratio_with_outliers": standing.ratio(ours, lambda cost: cost.whole_cost),
        "ratio_by_processor": standing.ratio(ours, lambda cost: cost.processor_cost),
        **middle,
        "samples": standing.costs[0].samples,
        "preparation": standing.preparation,
        "jit": standing.jit,
        "difference": standing.difference.median,
        "noise": standing.noise,
        "agrees": standing.agrees,
        "rounds": [{"variance": c.variance, "whole_variance": c.whole_variance, "seconds": c.seconds} for c in standing.costs],
        "load": result.load,
    }


def summary(results: list[Result], seconds: float) -> dict[str, Any]:
    """All figures for machines."""
    rows = [figures(result, standing) for result in results for standing in result.standings]
    means = {}
    for engine in sorted({row["engine"] for row in rows} - {"gonio"}):
        means[engine] = geometric_mean(row["ratio"] for row in rows if row["engine"] == engine)
    return {"seconds": seconds, "processors": os.cpu_count(), "entrants": rows, "geometric_mean_ratio": means}


def cells(row: dict[str, Any]) -> list[str]:
    """A row of the table."""
    texts = [row["scene"], row["engine"], *(f"{row[name]:.3f}" for name in ("ratio", "ratio_with_outliers", "ratio_by_processor"))]
    texts += [f"{row[name]:.3g}" for name in ("cost", "variance", "sample_variance", "outliers_from")]
    texts += [f"{row['seconds']:.2f}", str(row["samples"]), f"{row['preparation']:.2f}", f"{row['jit']:.2f}"]
    return [*texts, f"{row['difference']:.2%}" + ("" if row["agrees"] else " OVER"), f"{row['noise']:.2%}"]


def text(found: dict[str, Any]) -> str:
    """The table in columns."""
    table = [HEADS, *(cells(row) for row in found["entrants"])]
    widths = [max(len(row[column]) for row in table) for column in range(len(HEADS))]
    lines = ["  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in table]
    means = [f"geometric mean of ratios to {engine}: {ratio:.3f}" for engine, ratio in found["geometric_mean_ratio"].items()]
    loads = [row["load"] for row in found["entrants"]]
    return "\n".join([*lines, *means, f"load of the machine: {min(map(min, loads)):.1f} to {max(map(max, loads)):.1f}"])


def write(results: list[Result], found: dict[str, Any]) -> None:
    """The page, the pictures (gonio's, the other's, the blocks' difference), and the figures beside it."""
    OUT.mkdir(parents=True, exist_ok=True)
    pictures = []
    for result in results:
        ours, *others = result.standings
        for other in others:
            name = f"{result.name}-{other.entrant.engine.replace(':', '-')}.png"
            compare.write_strip(OUT / name, ours.image, other.image)
            shown = " beside ".join(f"{each.entrant.engine} on {each.entrant.scene}" for each in (ours, other))
            pictures.append(f'<h2>{shown}, and the difference (grey is none, white +5 %)</h2>\n<img src="{name}" alt="{shown}">')
    rows = ["<tr>" + "".join(f"<td>{html.escape(cell)}</td>" for cell in cells(row)) + "</tr>" for row in found["entrants"]]
    heads = "".join(f"<th>{head}</th>" for head in HEADS)
    versions = "; ".join(sorted({row["version"] for row in found["entrants"]}))
    page = PAGE.format(explanation=EXPLANATION, versions=versions, heads=heads, rows="\n".join(rows), pictures="\n".join(pictures))
    (OUT / "index.html").write_text(page, encoding="utf-8")
    (OUT / "peers.json").write_text(json.dumps(found, indent=1))

"""The comparison as a page: each pair, its difference picture, and its figures. `python report.py` writes it again from what is there."""

import dataclasses
import json
from pathlib import Path

import compare
import numpy
from suite import SCENES, Scene

OUT = Path(__file__).resolve().parents[3] / "out" / "compare-cycles"
MOST_NOISE = 0.003
MOST_MEDIAN = 0.01
MOST_PERCENTILE95 = 0.04
PAGE = """<!doctype html>
<meta charset="utf-8">
<title>Cycles and Gonio</title>
<style>
body {{ font: 15px sans-serif; max-width: 70em; margin: auto }}
img {{ image-rendering: pixelated; width: 100% }}
.over {{ color: #b00 }}
</style>
<h1>The same file in Cycles and in Gonio</h1>
<p>No clamping, no filter glossy, no adaptive sampling, caustics on; settings and file are the same for both. Differences are per channel over
blocks of {block} × {block} pixels, |Δ| / (reference + {floor:.0%} of the image's mean). Each rendering is the mean of two with different seeds;
noise is the standard error of its blocks (RMS) that follows from those two. Allowed: noise {noise:.1%}, median {median:.0%}, 95th percentile
{percentile95:.0%}. Each strip shows Gonio, Cycles, and the blocks' difference (grey is none, white Gonio 5 % brighter, black 5 % darker).</p>
{scenes}
"""
SECTION = """<h2 id="{name}">{name}</h2>
<p>median {median}, 95th percentile {percentile95}, largest {largest:.2%}, image mean {mean:.3%}; noise of Gonio {noise_gonio}, of Cycles
{noise_cycles}; {samples_gonio} samples in {seconds_gonio:.0f} s, {samples_cycles} in {seconds_cycles:.0f} s</p>
<img src="{name}.png" alt="{name} in Gonio, in Cycles, and the difference">
"""


def measured(path: Path, samples: int) -> compare.Measured:
    """What `render.py` wrote."""
    with numpy.load(path) as pair:
        return compare.measured(pair["first"], pair["second"], samples, float(pair["seconds"]))


def add(scene: Scene, ours: compare.Measured, theirs: compare.Measured) -> compare.Difference:
    """Compares a pair, and puts its strip and its figures into the report."""
    OUT.mkdir(parents=True, exist_ok=True)
    found = compare.difference(ours.image, theirs.image)
    compare.write_strip(OUT / f"{scene.name}.png", ours.image, theirs.image)
    figures = dataclasses.asdict(found)
    for engine, one in (("gonio", ours), ("cycles", theirs)):
        figures.update({f"noise_{engine}": one.noise, f"samples_{engine}": one.samples, f"seconds_{engine}": one.seconds})
    (OUT / f"{scene.name}.json").write_text(json.dumps(figures))
    write()
    return found


def write() -> None:
    """Writes the page from the figures of all scenes that were rendered."""
    known = [(scene, OUT / f"{scene.name}.json") for scene in SCENES]
    sections = [section(scene.name, json.loads(path.read_text())) for scene, path in known if path.is_file()]
    limits = {"noise": MOST_NOISE, "median": MOST_MEDIAN, "percentile95": MOST_PERCENTILE95}
    page = PAGE.format(block=compare.BLOCK, floor=compare.FLOOR, scenes="\n".join(sections), **limits)
    (OUT / "index.html").write_text(page, encoding="utf-8")


def section(name: str, figures: dict[str, float]) -> str:
    """A scene's part of the page; what is over its limit stands out."""
    limits = {"median": MOST_MEDIAN, "percentile95": MOST_PERCENTILE95, "noise_gonio": MOST_NOISE, "noise_cycles": MOST_NOISE}
    return SECTION.format(name=name, **(figures | {key: judged(figures[key], limit) for key, limit in limits.items()}))


def judged(value: float, limit: float) -> str:
    """A share in per cent, marked where it is over its limit."""
    return f"{value:.2%}" if value < limit else f'<b class="over">{value:.2%}</b>'


if __name__ == "__main__":
    write()

"""Writes `docs/validation.md` from the rows that the last run recorded: `python tests/validate/lighting/page.py`."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
import figures
from numpy import format_float_positional

ROOT = Path(__file__).resolve().parents[3]
PAGE = ROOT / "docs" / "validation.md"
# Sections in the page's order, with what to know of them.
SECTIONS = {
    "Point sources": "A source over 7 × 7 points of a floor and of a wall (CIE 171, 5.2).",
    "Area sources": "Sources of a known luminance over the same floor and over a wall (CIE 171, 5.3).",
    "Flux conservation": "What the six faces of a closed black box get of 1000 lm, source off its middle and tilted (CIE 171, 5.4).",
    "Glass": "A sheet of glass of index 1.52 between a light and a floor (CIE 171, 5.5); both polarisations are followed in the reference.",
    "Diffuse reflection": "Sunlit matt plates onto planes in the shade (CIE 171, 5.6), and past an obstruction (5.7).",
    "Interreflection": "Closed rooms with walls of one reflectance, mean illuminance of all faces (CIE 171, 5.8).",
    "Illumination maps": "Mean illuminance of whole faces by light paths; beside path tracing the interval is that of the difference.",
    "Caustics": "A matt floor behind clear glass and before mirrors, by light paths, as its picture shows it; four parts of it.",
    "Mirrors": "A floor with a perfect mirror beside it, against the source's image.",
    "Sky through openings": "Points of the floor of a black room of 4 m × 4 m × 3 m (CIE 171, 5.9 to 5.14); the sun itself does not shine.",
    "Photometric files": "IES and EULUMDAT files against a second, independent reader.",
    "Flux of photometric files": (
        "The closed form that `gonio photometry` states against 259,200 directions of a render's light, and against what a black cube gets; with the"
        " luminous opening instead of a point where the row says so."
    ),
    "Goniophotometer": (
        "Intensities that `gonio goniometer` measures of made-up luminaires, where they are above a tenth of the peak, against closed forms and tracers in"
        " double precision."
    ),
    "Media": (
        "Fog, smoke and what shines, as cameras, meters and the goniophotometer see them; paths end after 256 scatterings, and so do the half-spaces'"
        " references, which at albedo 0.999 takes 1.6 to 3.9 % of all orders away and at 0.99 0.05 to 0.13 %."
    ),
    "100 lm at 1 m": "From the hosts: 7.96 lx from an isotropic source, 31.83 lx straight on before a Lambertian one.",
    "Sun and skies": "The sun's place and the skies' luminances.",
}
INTRODUCTION = """# Validation

Illuminances that gonio renders against closed forms and against integrals in double precision that share no code with it. `make validation` runs the
tests in `tests/validate/lighting` and `tests/validate/goniometer` and writes this page; every figure is a measured one.

The cases are of the kind of CIE 171:2006, computed anew; the report's own tables are not used.

- *largest*: the largest relative deviation of a point from its reference, and what it may be. Where light is random it is that of the mean of
  eight renders with different seeds. Points darker than a hundredth of the brightest are measured by that.
- *mean*: the mean deviation of all points, ± half of its interval of 99.9 % confidence by Student's distribution over the eight renders and 0.01 %
  for single precision. It has to hold zero: a bias far smaller than the limit of single points would show.

The deterministic cases have no mean.
"""
OTHERS = """
## Tested elsewhere

Without figures here, each with its bounds in the test:

- shapes of lights under all of UsdLux's parameters against quadrature, by frame of luxtest's stages: `tests/usd/light/test_luxtest.py`
- sampling, density and value of every light at every SIMD level: `rust-core/light/src/tests`
- media without figures above: phase functions other than Henyey and Greenstein's (`tests/python/test_phase.py`), bodies that overlap and fog that touches
  floors (`tests/python/test_media.py`, `tests/python/test_absorbing_volumes.py`), grids that shine by heat, and grids beside even media
  (`tests/python/test_fields.py`), maps and bakes in haze (`tests/python/test_same_lux.py`, `tests/python/test_baking.py`), volumes of stages and files
  (`tests/usd/volume`) and of Blender (`tests/blender/export/volumes`)
- closed forms of the film, the white furnace inside a shining box, absorbing glass: `tests/rust/analytic.rs`
- readers and writers of photometric files, their bad input and their flux: `rust-core/formats/tests/photometry`
- daylight from USD, the command line and Blender: `tests/usd/light/test_daylight_stage.py`, `tests/blender/export/light/test_export_daylight.py`
- pictures of the same files in Cycles: `make compare-cycles`
"""


def number(value: float, unit: str) -> str:
    """A deviation with two digits."""
    if unit == "degrees":
        return f"{value:.5f}°"
    return f"{format_float_positional(100 * value, precision=2, fractional=False, trim='-')} %"


def line(row: figures.Row) -> str:
    """A row of the table."""
    mean = "" if row.mean is None or row.uncertainty is None else f"{100 * row.mean:+.3f} % ± {100 * row.uncertainty:.3f} %"
    held = "yes" if row.holds else "**no**"
    cells = [row.case, row.reference, str(row.points), f"{number(row.largest, row.unit)} of {number(row.limit, row.unit)}", mean, held]
    return "| " + " | ".join(cell.replace("|", "\\|") for cell in cells) + " |"


def page(rows: list[figures.Row]) -> str:
    """The whole page."""
    parts = [INTRODUCTION]
    for section, words in SECTIONS.items():
        found = sorted((row for row in rows if row.section == section), key=lambda row: row.case)
        if found:
            head = ["| case | reference | points | largest, limit | mean | holds |", "| --- | --- | ---: | ---: | ---: | --- |"]
            parts.append("\n".join([f"\n## {section}\n", words, "", *head, *map(line, found)]) + "\n")
    return "".join(parts) + OTHERS


def main() -> int:
    """Writes the page; fails where nothing was measured or a row is of no section."""
    rows = figures.recorded()
    strangers = {row.section for row in rows} - SECTIONS.keys()
    if not rows or strangers:
        sys.exit(
            f"no figures under {figures.FOLDER}: run make validation" if not rows else f"sections without a place on the page: {strangers}"
        )
    PAGE.write_text(page(rows))
    print(f"{PAGE.relative_to(ROOT)}: {len(rows)} cases, {sum(row.holds for row in rows)} hold")
    return 0


if __name__ == "__main__":
    sys.exit(main())

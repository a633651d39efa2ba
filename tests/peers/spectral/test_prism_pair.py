"""A rainbow in gonio and in LuxCore, each beside Snell's and Fresnel's laws in double precision: where colours lie, how bright they are.

Both get the same triangles, lamp and index. Their colours differ as their schemes do (`through_prism.py`); each must show what its own scheme makes
of the light. Writes the figures to `out/peers/prism-light.md`.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import numpy
import pytest

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE), *(str(HERE.parent / other) for other in ("caustics", "render"))]

import engine_gonio  # noqa: E402
import gonio  # noqa: E402
import on_screen  # noqa: E402
import through_prism  # noqa: E402
from description import described  # noqa: E402
from peer import ROOT, Entrant, Peer, Unavailable  # noqa: E402
from through_prism import index  # noqa: E402

OUT = ROOT / "out" / "peers"
LIGHT, PHOTONS, THEIRS = "gonio:spectral=true,integrator=light", "gonio:spectral=true,caustics=on", "luxcore:LIGHTCPU"
# LuxCore starts the sun's paths over the whole scene: too few pass the slit.
PAIRS = [(scene, engine) for scene in ("spot_crown", "spot_flint") for engine in (LIGHT, PHOTONS, THEIRS)]
PAIRS += [("sun_flint", LIGHT), ("sun_flint", PHOTONS)]
# Samples a pixel; LuxCore's are milliseconds.
SAMPLES = {LIGHT: 1024, PHOTONS: 384, THEIRS: 16_000}
# Errors are of rows as if these were independent, which sequences of random numbers are not wholly.
STANDARD_ERRORS = 5.0
# Beyond these: of the light, and of a centroid in m (a pixel is half a millimetre).
MOST_LIGHT, MOST_CENTROID = 0.003, 0.00001
INTRODUCTION = """# A rainbow beside LuxCore

Red, green, blue and luminance over the closed form's less 1, in parts of a thousand, and centroids beyond the closed form's in µm, with standard
errors.

| scene | engine | light | centroid |
| --- | --- | --- | --- |
"""

pytestmark = [pytest.mark.validate, pytest.mark.timeout(600)]


@pytest.fixture(scope="module")
def rows() -> Iterator[list[str]]:
    """Lines of the table, written when all is done."""
    OUT.mkdir(parents=True, exist_ok=True)
    lines: list[str] = []
    yield lines
    if lines:
        (OUT / "prism-light.md").write_text(INTRODUCTION + "\n".join(lines) + "\n")


def rendered(scene: str, engine: str) -> numpy.ndarray:
    """A picture; skips where the engine cannot be had."""
    try:
        with Peer(Entrant(engine, f"prism.{scene}")) as peer:
            peer.samples = SAMPLES[engine]
            return peer.render(1).values
    except Unavailable as reason:
        pytest.skip(f"no {engine}: {reason}")


def listed(values: numpy.ndarray, scale: float) -> str:
    return ", ".join(f"{scale * value:+.1f}" for value in values)


def test_index_is_that_of_both_figures() -> None:
    glass = through_prism.glass_of(described("prism.spot_crown"))
    d, f, c = (index(glass, nm) for nm in (587.56, 486.13, 656.27))
    assert abs(d - 1.5168) < 1e-12 and abs((d - 1.0) / (f - c) - 64.17) < 1e-9
    a, b = glass.cauchy()
    assert abs(a - 1.50458) < 1e-5 and abs(b - 0.004217) < 1e-6


@pytest.mark.parametrize("scene", ["spot_crown", "spot_flint"])
def test_wavelengths_land_where_snell_has_them(scene: str) -> None:
    made = described(f"prism.{scene}")
    laid_out = engine_gonio.Engine(made, 2, "spectral=true,integrator=light")._scene
    laid_out.set(samples=32)
    picture = gonio.spectral_picture(laid_out, band=20)
    found = on_screen.read(numpy.asarray(picture.radiance).astype("f8"), on_screen.view(made))
    # Light of a band has the wavelength of its middle.
    known = [through_prism.centroid(made, nm) for nm in numpy.asarray(picture.wavelengths_nm)]
    apart = found.centroid - known
    print(f"{scene}: µm {listed(apart, 1e6)}, ± {listed(found.centroid_error, 1e6)}")
    assert (abs(apart) < STANDARD_ERRORS * found.centroid_error + MOST_CENTROID).all()


@pytest.mark.parametrize(("scene", "engine"), PAIRS)
def test_colours_are_those_of_the_scheme(scene: str, engine: str, rows: list[str]) -> None:
    picture, made = rendered(scene, engine), described(f"prism.{scene}")
    seen, bins = on_screen.view(made), through_prism.SCHEMES[engine.partition(":")[0]](made)
    known = numpy.zeros_like(picture)
    known[seen.rows] = on_screen.expected(bins, seen)
    found, wanted = (on_screen.read(on_screen.with_luminance(values), seen) for values in (picture, known))
    light, error = found.light / wanted.light - 1.0, found.light_error / wanted.light
    apart = found.centroid - wanted.centroid
    cells = [f"{listed(light, 1e3)} ± {listed(error, 1e3)}", f"{listed(apart, 1e6)} ± {listed(found.centroid_error, 1e6)}"]
    rows.append("| " + " | ".join([scene, engine, *cells]) + " |")
    shown, known, errors = on_screen.strips(picture, bins, seen)
    told = abs(known) > on_screen.LIT * abs(known).max(axis=0)
    spread = abs(shown - known)[told] / errors[told]
    print(rows[-1], f"strips: RMS {numpy.sqrt((spread**2).mean()):.2f}, largest {spread.max():.2f} standard errors of {spread.size}")
    assert (abs(light) < STANDARD_ERRORS * error + MOST_LIGHT).all()
    assert (abs(apart) < STANDARD_ERRORS * found.centroid_error + MOST_CENTROID).all()
    assert spread.max() < STANDARD_ERRORS

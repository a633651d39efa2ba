"""Gonio, Radiance and the independent tracer agree on the two rooms, with few samples; what else the comparison rests on."""

import os
from pathlib import Path

import bench
import environments
import equal_error
import measured_by
import numpy
import pictured
import pytest
import tracer
import two_rooms
import usd_stage
from equal_error import CACHED, GONIO, TRACED, Equal, Row, Setting

pytestmark = [pytest.mark.validate, pytest.mark.timeout(1800)]

# Of the mean illuminance of the office.
MOST_APART = 0.01
# The noise of the office's mean is below 0.2 % with each of these.
SAMPLES, PATHS, BATCHES = 1024, 64, 8
OPTIONS = "-ab 6 -ad 128 -as 0 -aa 0 -ds .05 -lw 2e-3".split()


@pytest.fixture(scope="module")
def python() -> Path:
    """A Python that has pyradiance."""
    try:
        named = Path(os.environ.get("GONIO_PEER_RADIANCE") or environments.python_of("radiance"))
        measured_by.packaged(named)
    except (environments.Unavailable, measured_by.Unavailable) as reason:
        pytest.skip(f"no pyradiance: {reason}")
    return named


@pytest.fixture(scope="module")
def ours(tmp_path_factory: pytest.TempPathFactory) -> dict[str, float]:
    """Gonio's mean illuminances by grid, in lux."""
    found = measured_by.by_gonio(usd_stage.write(tmp_path_factory.mktemp("stage")), SAMPLES, 1)
    return {name: float(part.mean()) for name, part in two_rooms.each_grid(found.lux).items()}


def test_the_office_has_radiances_mean(ours: dict[str, float], python: Path, tmp_path: Path) -> None:
    peer = measured_by.radiance(python, tmp_path)
    office = two_rooms.each_grid(peer.measure(OPTIONS).lux)["office"].mean()
    assert ours["office"] == pytest.approx(office, rel=MOST_APART)


def test_the_bench_runs_through(python: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    sizes = "--rounds 1 --most-samples 16 --most-settings 1 --reference-samples 64 --reference-seeds 4 --tracer-paths 64"
    monkeypatch.setattr("sys.argv", ["bench.py", *sizes.split()])
    monkeypatch.setattr(bench, "OUT", tmp_path)
    monkeypatch.setenv("GONIO_PEER_RADIANCE", str(python))
    # So small a reference need not agree.
    assert bench.main() in (0, 1)
    said = capsys.readouterr().out
    for curve in (GONIO, TRACED, CACHED):
        assert f"| {curve} | `" in said
    assert (tmp_path / "radiance.svg").exists()


def test_both_rooms_have_the_tracers_means(ours: dict[str, float]) -> None:
    found = two_rooms.each_grid(tracer.traced(PATHS, BATCHES, 1))
    assert ours["office"] == pytest.approx(found["office"].mean(), rel=MOST_APART)
    # The corridor's mean is some 5 % uncertain with so few paths.
    means = found["corridor"].mean(axis=1)
    assert ours["corridor"] == pytest.approx(means.mean(), abs=5 * means.std(ddof=1) / BATCHES**0.5)


def test_points_of_both_grids_lie_in_their_rooms() -> None:
    places = two_rooms.each_grid(two_rooms.points().T)
    assert {name: each.shape[1] for name, each in places.items()} == {"office": 70, "corridor": 18}
    assert places["office"][1].max() < two_rooms.OFFICE_DEPTH < two_rooms.CORRIDOR_START < places["corridor"][1].min()


def test_rectangles_close_both_rooms_and_face_inwards() -> None:
    # From the middle of a closed room every ray meets a front.
    around = tracer.cosine(numpy.repeat([[0.0, 0.0, 1.0], [0.0, 0.0, -1.0]], 2000, axis=0), numpy.random.default_rng(1).random((4000, 2)))
    rooms = tracer.made()
    for middle in ([1.0, 1.0, 1.4], [1.0, 5.5, 1.4]):
        distance, hit = rooms.nearest(numpy.broadcast_to(middle, around.shape), around)
        assert numpy.isfinite(distance).all()
        assert ((rooms.normal[hit] * around).sum(axis=1) < 0).all()


def made(curve: str, seconds: float, error: float) -> Row:
    """A setting with the same error everywhere."""
    everywhere = {grid.name: error for grid in two_rooms.GRIDS}
    return Row(Setting(curve, "of a test"), everywhere, everywhere, seconds)


def test_time_at_equal_error_goes_along_the_front() -> None:
    # Half the error in four times the time; a slow setting that is worse does not count.
    rows = [made(GONIO, 1.0, 0.04), made(GONIO, 16.0, 0.01), made(GONIO, 8.0, 0.5)]
    rows += [made(TRACED, 10.0, 0.04), made(TRACED, 160.0, 0.01), made(CACHED, 0.5, 0.05)]
    found = {(each.grid, each.error): each for each in equal_error.equals(rows)}
    at: Equal = found["office", 0.02]
    assert at.seconds[GONIO] == pytest.approx(4.0)
    assert at.ratio(TRACED) == pytest.approx(10.0)
    assert at.ratio(CACHED) is None
    # What the quickest setting reaches already takes its time.
    assert found["office", 0.1].ratio(CACHED) == pytest.approx(0.5)
    assert ("office", 0.005) not in found


def test_figures_come_between_the_markers_and_curves_beside_the_page(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    page, drawing = tmp_path / "page.md", tmp_path / "curves.svg"
    monkeypatch.setattr(pictured, "DOCS", page)
    monkeypatch.setattr(pictured, "DRAWING", drawing)
    page.write_text(f"before\n{pictured.FIRST_MARKER}\nold\n{pictured.LAST_MARKER}\nafter\n")
    rows = [made(curve, seconds, error) for curve in (GONIO, TRACED, CACHED) for seconds, error in ((1.0, 0.1), (9.0, 0.02))]
    curves = "![Error against processor time](curves.svg)"
    for found in ("first", "second"):
        pictured.write_docs(found, rows)
        assert page.read_text() == f"before\n{pictured.FIRST_MARKER}\n\n{curves}\n\n{found}\n\n{pictured.LAST_MARKER}\nafter\n"
    # A panel a grid, a line a curve.
    assert drawing.read_text().count("<polyline") == 3 * len(two_rooms.GRIDS)

"""A year of an office: gonio's figures, and those that honeybee's post-processing makes of gonio's own series."""

import json

import annual_office
import honeybee_results
import numpy as np
import office_room
import pytest

pytestmark = [pytest.mark.validate, pytest.mark.timeout(900)]

WEATHER = ["rule", "mannheim.epw", "chicago.epw"]
GRID = ("--grid", "/Floor", "--height", 0.76, "--spacing", 0.5, "--margin", 0.3, "-p", 2048, "-m", 2)
USED = np.arange(8760) % 24
USED = (USED >= 8) & (USED < 18)


@pytest.fixture(params=WEATHER)
def weather(request, tmp_path, shared):
    """An EPW file."""
    if request.param != "rule":
        return shared("weather", request.param)
    (tmp_path / "rule.epw").write_text(annual_office.epw())
    return tmp_path / "rule.epw"


@pytest.fixture
def year(weather, tmp_path, run):
    """Runs gonio with options for the office in a year; gives the grid's figures and both series, points × hours."""
    honeybee_results.python()
    (tmp_path / "office.usda").write_text(annual_office.stage())

    def call(*options):
        words = ("--weather", weather, *GRID, "--json", "-q", "-o", tmp_path / "out", *options)
        done = run("annual", tmp_path / "office.usda", *words, timeout=300)
        assert done.returncode == 0, done.stderr
        series = (np.load(tmp_path / "out" / f"Floor_{name}.npy") for name in ("total", "direct"))
        return json.loads(done.stdout)["grids"][0], *series

    return call


def lit(series):
    """Hours in which there is any light."""
    return np.flatnonzero(series.any(axis=0))


def same_exposure(ours, theirs):
    assert [point["hours_direct_1000"] for point in ours["points"]] == theirs["hours"]
    assert 100 * ours["ase_1000_250"] == pytest.approx(theirs["ase_beyond_250"], abs=1e-9)


def test_without_blinds(year, tmp_path):
    ours, total, direct = year()
    results = honeybee_results.folder(tmp_path / "results", {honeybee_results.STATIC: [(total, direct)]}, lit(total))
    theirs = honeybee_results.asked(tmp_path, results=results)
    honeybee_results.same_points(ours, theirs)
    same_exposure(ours, theirs)
    assert theirs["used"] == 3650 and 0 < theirs["sda"] < 1 and 0 < theirs["ase"] < 100


def test_a_schedule_of_ones_own(year, tmp_path):
    """Weekdays from 9 to 17 without an hour at noon."""
    used = [int(hour % 24 in (9, 10, 11, 13, 14, 15, 16) and hour // 24 % 7 < 5) for hour in range(8760)]
    (tmp_path / "used.csv").write_text("\n".join(map(str, used)))
    ours, total, direct = year("--schedule", tmp_path / "used.csv")
    results = honeybee_results.folder(tmp_path / "results", {honeybee_results.STATIC: [(total, direct)]}, lit(total))
    theirs = honeybee_results.asked(tmp_path, results=results, schedule=used)
    honeybee_results.same_points(ours, theirs)
    same_exposure(ours, theirs)


@pytest.mark.parametrize("blinds", ["share", "variant"])
def test_with_blinds(year, tmp_path, blinds):
    """Honeybee chooses the state of each hour. Its closed state has what gonio's closed blinds let through, and no direct sun."""
    _, total, direct = year()
    if blinds == "share":
        closed, options = np.float32(0.05) * total, ("--blinds", 0.05)
    else:
        _, closed, straight = year("--variant", annual_office.CLOSED)
        assert straight.max() == 0
        options = ("--closed-variant", annual_office.CLOSED)
    ours, operated, _ = year(*options)
    results = honeybee_results.folder(tmp_path / "results", {"South": [(total, direct), (closed, 0 * direct)]}, lit(total))
    theirs = honeybee_results.asked(tmp_path, results=results, blinds=True)
    # Honeybee closes blinds in used hours alone.
    assert theirs["blinds"]["closed"]["South"] == np.flatnonzero((operated != total).any(axis=0) & USED).tolist()
    assert theirs["blinds"]["failing"] == {}
    honeybee_results.same_points(ours, theirs["with_blinds"] | {"used": theirs["used"]})
    same_exposure(ours, theirs)
    leed = theirs["blinds"]["leed"]
    # Honeybee counts points of just 250 hours too.
    exposed = np.mean([point["hours_direct_1000"] >= 250 for point in ours["points"]])
    assert [100 * ours["sda_300_50"], 100 * exposed] == pytest.approx([leed["sda"], leed["ase"]], abs=0.0051)
    assert theirs["with_blinds"]["sda"] < theirs["sda"]
    print(f"sDA {ours['sda_300_50']:.3f}, open {theirs['sda']:.3f}; closed in {len(theirs['blinds']['closed']['South'])} h")


def inside(point, altitude, azimuth):
    """Whether each sun is seen from a point through the window, in the plane y = 0."""
    east, north, up = np.sin(azimuth) * np.cos(altitude), np.cos(azimuth) * np.cos(altitude), np.sin(altitude)
    far = np.divide(-point[1], north, out=np.zeros_like(north), where=north < -1e-6)
    across, high = point[0] + far * east, point[2] + far * up
    (west_end, east_end), (sill, lintel) = office_room.WINDOW
    return (far > 0) & (up > 0) & (west_end < across) & (across < east_end) & (sill < high) & (high < lintel)


@pytest.mark.parametrize(("position", "off"), [("true", 0.5), ("radiance", 1.5)])
def test_direct_sun_is_ladybugs_sun_in_the_window(year, weather, tmp_path, position, off):
    """Where as many degrees to any side change nothing, hours are the same: Radiance's formulas differ from ladybug's by up to 1.1° in the sun's height."""
    ours, _, direct = year("--sun-position", position)
    suns = honeybee_results.asked(tmp_path, suns=weather)
    altitude, azimuth = np.radians(suns["altitude"]), np.radians(suns["azimuth"])
    moves = [(up, aside) for up in np.radians([-off, 0, off]) for aside in np.radians([-off, 0, off])]
    sines = np.sin([altitude + up for up in np.radians([-off, off])])
    # Efficacies differ by some per cent, with other clearnesses and dew points.
    least, most = 0.9 * np.array(suns["normal"]) * sines[0], 1.1 * np.array(suns["normal"]) * sines[1]
    sure, sunny = 0, 0
    for point, series in zip(ours["points"], direct, strict=True):
        seen = np.array([inside(point["position_m"], altitude + up, azimuth + aside / np.cos(altitude)) for up, aside in moves])
        is_sunny, is_none = seen.all(axis=0) & (least >= 1000) & USED, (~seen.any(axis=0) | (most < 1000)) & USED
        assert series[is_sunny].min(initial=1000) >= 1000 and series[is_none].max(initial=0) < 1000
        sure, sunny = sure + (is_sunny | is_none).sum(), sunny + is_sunny.sum()
    share = sure / (USED.sum() * len(direct))
    print(f"{share:.1%} of the used hours are sure, {sunny / len(direct):.0f} of them sunny at a point")
    assert share > 0.9 and sunny / len(direct) > 100

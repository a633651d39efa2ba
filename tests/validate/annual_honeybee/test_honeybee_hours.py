"""Which hours count: EN 17037's half of the year, and a leap year."""

import json

import annual_office
import honeybee_results
import numpy as np
import pytest

pytestmark = [pytest.mark.validate, pytest.mark.timeout(600)]

GRID = ("--grid", "/Floor", "--height", 0.85, "--spacing", 0.5, "--margin", 0.5, "-p", 1024, "-m", 1)
LEVELS = ("minimum", "medium", "high")


@pytest.fixture
def year(tmp_path, run):
    """Runs gonio for the office in the year of a weather file."""
    honeybee_results.python()
    (tmp_path / "office.usda").write_text(annual_office.stage())

    def call(weather):
        words = ("--weather", weather, *GRID, "--json", "-q", "-o", tmp_path / "out")
        done = run("annual", tmp_path / "office.usda", *words, timeout=300)
        assert done.returncode == 0, done.stderr
        series = (np.load(tmp_path / "out" / f"Floor_{name}.npy") for name in ("total", "direct"))
        return json.loads(done.stdout)["grids"][0], *series

    return call


@pytest.mark.parametrize("brightness", [0.2, 0.5, 1, 2])
def test_daylight_provision(year, tmp_path, brightness):
    """Honeybee finds the 4380 hours in the weather file. No two of its lit hours have the same skylight, so that the half is one alone."""
    steps = np.arange(8760)
    is_light = (steps % 24 >= 5) & (steps % 24 < 20)
    diffuse = np.where(is_light, 2000 + steps * 7919 % 8760 * 4, 0) * brightness
    direct = np.where(is_light, steps * 37 % 13 * 3000, 0)
    weather = tmp_path / "year.wea"
    weather.write_text(annual_office.wea(direct.tolist(), diffuse.tolist()))
    ours, total, light = year(weather)
    kept = np.flatnonzero(total.any(axis=0))
    results = honeybee_results.folder(tmp_path / "results", {honeybee_results.STATIC: [(total, light)]}, kept)
    theirs = honeybee_results.asked(tmp_path, results=results, daylight_hours=weather)["en17037"]
    area = dict(zip((100, 300, 500, 750), ours["en17037"]["hourly"]["area_100_300_500_750"], strict=True))
    minimum, target = theirs["Minimum Illuminance"], theirs["Target Illuminance"]
    assert [100 * area[lux] for lux in (100, 300, 500)] == pytest.approx([minimum[level][0] for level in LEVELS], abs=1e-9)
    assert [100 * area[lux] for lux in (300, 500, 750)] == pytest.approx([target[level][0] for level in LEVELS], abs=1e-9)
    met = [level for level in LEVELS if minimum[level][1] and target[level][1]]
    assert ours["en17037"]["hourly"]["level"] == (met[-1] if met else "none")
    print(brightness, ours["en17037"]["hourly"])


def test_a_leap_year(year, tmp_path):
    """Ladybug's calendar has 3660 hours from 8 to 18. Honeybee's functions of arrays take them; its classes know years of 8760 hours alone."""
    weather = tmp_path / "leap.epw"
    weather.write_text(annual_office.epw(is_leap_year=True))
    ours, total, direct = year(weather)
    assert total.shape[1] == 8784
    paths = [tmp_path / "out" / f"Floor_{name}.npy" for name in ("total", "direct")]
    theirs = honeybee_results.asked(tmp_path, calendar=[*paths, True])
    assert ours["used_hours"] == theirs["used"] == 3660
    assert [100 * point["da_300"] for point in ours["points"]] == pytest.approx(theirs["da"], abs=1e-9)
    assert [point["hours_direct_1000"] for point in ours["points"]] == theirs["hours"]
    assert 100 * ours["ase_1000_250"] == pytest.approx(theirs["ase"], abs=1e-9)

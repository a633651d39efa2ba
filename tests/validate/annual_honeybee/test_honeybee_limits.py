"""Hours that lie on a limit, or just beside it: gonio's figures and honeybee's of the same series."""

import json

import honeybee_results
import made_years
import numpy as np
import pytest
from made_years import SUNNY

pytestmark = [pytest.mark.validate, pytest.mark.timeout(600)]


@pytest.fixture
def metrics(tmp_path, run):
    """Runs `gonio annual-metrics` for points × hours in lx, by groups of windows; gives its figures and the series of the first file's name."""
    honeybee_results.python()
    (tmp_path / "year.wea").write_text(made_years.weather())

    def call(*groups, options=()):
        files = {"--coefficients": [], "--sun-coefficients": [], "--sun-total": []}
        for number, (total, direct) in enumerate(groups):
            matrices = (made_years.dark(len(total)), made_years.suns(direct), made_years.suns(total))
            for (option, paths), matrix in zip(files.items(), matrices, strict=True):
                paths.append(tmp_path / f"group{number}{option}.npy")
                np.save(paths[-1], matrix)
        words = [word for option, paths in files.items() for word in (option, *paths)]
        words += ["--groups"] * (len(groups) > 1) + ["-o", tmp_path / "out", "--json", *options]
        done = run("annual-metrics", "--weather", tmp_path / "year.wea", *words)
        assert done.returncode == 0, done.stderr
        series = (np.load(tmp_path / "out" / f"group0--coefficients_{name}.npy") for name in ("total", "direct"))
        return json.loads(done.stdout)["grids"][0], *series

    return call


def in_hours(counts, lux, otherwise=0.0):
    """Points × hours: each has the illuminance in so many used hours with a sun, and otherwise another one."""
    series = np.zeros((len(counts), 8760), np.float32)
    for row, count, value in zip(series, counts, np.broadcast_to(lux, len(counts)), strict=True):
        row[SUNNY] = otherwise
        row[SUNNY[:count]] = value
    return series


def statically(tmp_path, total, direct):
    results = honeybee_results.folder(tmp_path / "results", {honeybee_results.STATIC: [(total, direct)]}, SUNNY)
    return honeybee_results.asked(tmp_path, results=results)


def test_illuminances_on_the_limits_count(metrics, tmp_path):
    """100 and 300 lx are enough, 3000 lx are not too much, and half of the hours is enough."""
    beside = [np.nextafter(limit, np.float32(end)) for limit in made_years.LIMITS for end in (0, np.inf)]
    wanted = np.random.default_rng(3).choice(np.float32([*made_years.LIMITS, *beside, 0, 20]), (20, 8760)) * made_years.UP
    halves = in_hours([1824, 1825, 1826], np.float32(300), np.nextafter(np.float32(300), np.float32(0)))
    wanted = np.vstack([wanted, halves])
    ours, total, direct = metrics((wanted, 0 * wanted))
    assert all((total == limit).any() for limit in made_years.LIMITS)
    theirs = statically(tmp_path, total, direct)
    honeybee_results.same_points(ours, theirs)
    assert [point["da_300"] >= 0.5 for point in ours["points"][-3:]] == [False, True, True]


def test_exposure_of_just_250_hours_and_just_1000_lux(metrics, tmp_path):
    """LM-83: direct sun is 1000 lx or more, in more than 250 hours. Honeybee asks for more than 1000 lx, and 250 hours are enough for it."""
    wanted = in_hours([249, 250, 250, 251, 251], [1001, 1001, 1001, 1001, 1000])
    ours, total, direct = metrics((wanted, wanted))
    assert (direct == 1000).sum() == 251
    theirs = statically(tmp_path, total, direct)
    assert [point["hours_direct_1000"] for point in ours["points"]] == [249, 250, 250, 251, 251] and ours["ase_1000_250"] == 0.4
    assert theirs["hours"] == [249, 250, 250, 251, 0]
    assert theirs["ase"] == pytest.approx(60) and theirs["ase_beyond_250"] == pytest.approx(20)


def test_blinds_close_beyond_two_per_cent(metrics, tmp_path):
    """Of 150 points 3 in the sun are two per cent; 4 are more. 1000 lx are sun, a little less are none."""
    counts, lux = [2, 3, 4, 4], [5000, 5000, 1000, np.nextafter(np.float32(1000), np.float32(0))]
    direct = np.zeros((150, 8760), np.float32)
    for kind, (count, value) in enumerate(zip(counts, lux, strict=True)):
        direct[:count, SUNNY[kind::4]] = value
    total = direct + np.float32(400) * made_years.UP
    _, total, direct = metrics((total, direct))
    ours, operated, _ = metrics((total, direct), options=("--blinds", 0.5))
    closed = np.flatnonzero((operated != total).any(axis=0))
    assert closed.tolist() == SUNNY[2::4].tolist()
    states = {"South": [(total, direct), (np.float32(0.5) * total, 0 * direct)]}
    theirs = honeybee_results.asked(tmp_path, results=honeybee_results.folder(tmp_path / "results", states, SUNNY), blinds=True)
    assert theirs["blinds"]["closed"]["South"] == closed.tolist()
    honeybee_results.same_points(ours, theirs["with_blinds"] | {"used": theirs["used"]})


def groups_of_100(first, second):
    """Two groups of windows: points in the sun of each, at hours one after the other; all points have some skylight by both."""
    made = []
    for counts in (first, second):
        direct = np.zeros((100, 8760), np.float32)
        for kind, points in enumerate(counts):
            direct[np.ix_(points, SUNNY[kind :: len(counts)])] = 5000
        made.append((direct + np.float32(200) * made_years.UP, direct))
    return made


def operated_by_both(metrics, tmp_path, groups):
    """Gonio's figures and honeybee's, and how many groups are closed in the hours of each kind."""
    kinds = range(3)
    ours, operated, _ = metrics(*groups, options=("--blinds", 0.25))
    # What the first group brings, and the second, with blinds open, to points without sun.
    shadow = operated[50, SUNNY]
    states = {name: [(total, direct), (np.float32(0.25) * total, 0 * direct)] for name, (total, direct) in zip(("A", "B"), groups, strict=True)}
    theirs = honeybee_results.asked(tmp_path, results=honeybee_results.folder(tmp_path / "results", states, SUNNY), blinds=True)
    by_us = [np.unique((400 - shadow[kind::3]) / 150).tolist() for kind in kinds]
    closed = [set(theirs["blinds"]["closed"][name]) for name in ("A", "B")]
    by_them = [sorted({sum(hour in hours for hours in closed) for hour in SUNNY[kind::3].tolist()}) for kind in kinds]
    return ours, theirs, [np.round(values, 4).tolist() for values in by_us], by_them


def test_groups_of_windows_whose_own_sun_closes_them(metrics, tmp_path):
    """None is lit; the first alone is; both are."""
    groups = groups_of_100([range(0), range(3), range(3)], [range(0), range(0), range(10, 14)])
    ours, theirs, by_us, by_them = operated_by_both(metrics, tmp_path, groups)
    assert by_us == by_them == [[0], [1], [2]]
    honeybee_results.same_points(ours, theirs["with_blinds"] | {"used": theirs["used"]})


# LM-83-12 has blinds of any groups close until no more than 2 % of the points are in the sun that all groups let in.
def test_groups_of_windows_that_together_bring_too_much_sun(metrics, tmp_path):
    """Two points of a hundred by each group are four: one of them has to close."""
    groups = groups_of_100([range(0), range(2), range(2)], [range(0), range(10, 12), range(20, 22)])
    _, _, by_us, by_them = operated_by_both(metrics, tmp_path, groups)
    assert by_them == [[0], [1], [1]] and by_us == by_them

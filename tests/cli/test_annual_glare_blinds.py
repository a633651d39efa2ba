"""`gonio annual-glare` with blinds: hours in which they are closed are those of the stage with closed ones, and direct sun on the floor says which these are."""

import json

import almanac
import facade_room
import numpy as np
import pytest
from failures import error_of
from wea_years import HOUR, write_wea

# An eye in the middle of the room that looks at the window to the south, and one that looks at that to the west.
EYES = ("--eye", "2,3,1.2", "--facing", "0,-1,0", "--facing", "-1,0,0")
SOUTH, WEST = "/Room/South{blinds=closed}", "/Room/West{blinds=closed}"
GROUPS = ("--group", "south=/Room/South", "--group", "west=/Room/West")
FLOOR = ("--blinds-floor", "/Room/Floor")
ALWAYS = ("--closed-hours", "0-24")
USED = (HOUR > 8) & (HOUR < 18)


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    folder = tmp_path_factory.mktemp("glare")
    height = almanac.of_hours()[0]
    write_wea(folder / "year.wea", np.where(height > 5, 50000, 0), np.where(height > 0, 9000, 0))
    (folder / "room.usda").write_text(facade_room.stage())
    return folder


@pytest.fixture(scope="module")
def year(run, folder):
    """Rates the eyes' year; gives what is told, and values by eye and hour. Runs with the same words are the same."""
    known = {}

    def rate(*options, expect=0):
        words = ("annual-glare", folder / "room.usda", "--weather", folder / "year.wea", *EYES, "-m", 1, "-p", 1024, "-q", "--json", *options)
        if expect:
            return error_of(run(*words, timeout=300), expect)
        if options not in known:
            out = folder / str(len(known))
            done = run(*words, "-o", out, timeout=300)
            assert done.returncode == 0, done.stderr
            known[options] = json.loads(done.stdout), np.load(out / "glare.npy")
        return known[options]

    return rate


@pytest.fixture(scope="module")
def sunny(run, folder):
    """Hours in which more than 2 % of LM-83's points on the floor have 1000 lx of direct sun, by group of windows: all, south, west."""

    def of(*options):
        grid = ("--grid", "/Room/Floor", "--height", 0.76, "--spacing", 0.5, "--margin", 0.3)
        out = folder / "sun"
        done = run("annual", folder / "room.usda", "--weather", folder / "year.wea", *grid, "-m", 1, "-p", 16, "-q", "--json", "-o", out, *options, timeout=300)
        assert done.returncode == 0, done.stderr
        return (np.load(out / "Floor_direct.npy") >= 1000).mean(axis=0) > 0.02

    return of


def test_closed_hours_are_those_of_closed_blinds(year):
    _, open_ = year()
    _, closed = year("--variant", SOUTH)
    found, always = year("--closed-variant", SOUTH, *ALWAYS)
    np.testing.assert_allclose(always, closed, atol=1e-6)
    assert found["closed_hours"] == [3650 - np.sum(USED & ~open_.any(axis=0))]
    _, midday = year("--closed-variant", SOUTH, "--closed-hours", "11-13")
    np.testing.assert_allclose(midday, np.where(np.abs(HOUR - 12) < 1, closed, open_), atol=1e-6)
    # The screen takes the sun's disc from the eye that looks at it, and its glare.
    assert (open_[0] - closed[0]).max() > 0.2


@pytest.mark.parametrize("floor", [FLOOR, ("--blinds-floor", "/Room/Floor", *EYES[:2])])
def test_direct_sun_on_the_floor_closes_them(year, sunny, floor):
    _, open_ = year()
    _, closed = year("--variant", SOUTH, "--variant", WEST)
    found, operated = year("--closed-variant", SOUTH, "--closed-variant", WEST, *floor)
    is_closed = sunny()
    assert 500 < is_closed.sum() < 3650
    np.testing.assert_allclose(operated[:2], np.where(is_closed, closed, open_), atol=1e-6)
    assert found["closed_hours"] == [np.sum(is_closed & USED)] and "groups" not in found


def test_groups_close_by_themselves(year, sunny):
    _, open_ = year()
    _, told_apart = year(*GROUPS)
    np.testing.assert_allclose(told_apart, open_, atol=2e-4)
    # A closed facade that lets nothing in is one with a board before it, but for what boards and panes throw back.
    _, shut = year("--variant", "/Room/South{blinds=shut}")
    found, operated = year(*GROUPS, "--blinds", "south=0", "--closed-hours", "south=0-24")
    assert np.abs(operated - shut).mean() < 0.01 and found["groups"] == ["south", "west"]
    # By direct sun: hours with sun by the south alone close the south alone, and the other way round.
    by_sun, operated = year(*GROUPS, "--blinds", 0, *FLOOR)
    south = sunny("--variant", "/Room/West{blinds=shut}")
    west = sunny("--variant", "/Room/South{blinds=shut}")
    assert (south & ~west).sum() > 100 and (west & ~south).sum() > 50
    assert 0.9 < by_sun["closed_hours"][0] / np.sum(south & USED) <= 1 and 0.9 < by_sun["closed_hours"][1] / np.sum(west & USED) <= 1
    never = ~sunny()
    np.testing.assert_allclose(operated[:, never], told_apart[:, never], atol=1e-6)
    _, without_west = year(*GROUPS, "--blinds", "west=0", "--closed-hours", "west=0-24")
    np.testing.assert_allclose(operated[:, west & ~south], without_west[:, west & ~south], atol=1e-6)


def test_what_is_missing_is_told(year):
    assert "name one with --blinds-floor /Prim, or hours with --closed-hours" in year("--blinds", 0.1, expect=1)
    assert "but no blinds" in year(*ALWAYS, expect=1)
    assert "expected one of both" in year("--blinds", 0.1, "--closed-variant", SOUTH, expect=1)
    assert "/Room/Nothing" in year("--blinds", 0.1, "--blinds-floor", "/Room/Nothing", expect=1)


def test_lines_tell_closed_hours(run, folder):
    words = ("annual-glare", folder / "room.usda", "--weather", folder / "year.wea", *EYES, "-m", 1, "-p", 64, "-q")
    done = run(*words, *GROUPS, "--blinds", 0.1, "--closed-hours", "south=12-14", timeout=300)
    assert done.returncode == 1 and "--blinds-floor" in done.stderr
    done = run(*words, *GROUPS, "--blinds", "south=0.1", "--closed-hours", "south=12-14", timeout=300)
    assert "blinds closed, used hours: south 730, west 0" in done.stdout


def test_python_closes_them_too(year, folder):
    import gonio

    weather = (folder / "year.wea").read_bytes()
    closed_stage = facade_room.stage().replace('string blinds = "open"', 'string blinds = "closed"', 1)
    (folder / "closed.usda").write_text(closed_stage)
    scene, closed = [gonio.load_usd(str(folder / f"{name}.usda")) for name in ("room", "closed")]
    eyes = [((2, 3, 1.2), (0, -1, 0)), ((2, 3, 1.2), (-1, 0, 0))]
    words = {"samples": 1024, "division": 1}
    always = gonio.annual_glare(scene, weather, eyes, closed=closed, closed_hours=(0, 24), **words)
    _, values = year("--closed-variant", SOUTH, *ALWAYS)
    np.testing.assert_array_equal(np.asarray([reading.values for reading in always], np.float32), values)
    assert always[0].closed_hours[0] > 2500
    with pytest.raises(gonio.Error, match="there is none"):
        gonio.annual_glare(scene, weather, eyes, blinds=0.1, **words)
    scene.add_grid(corner=(0.3, 0.3, 0.76), edges=((3.4, 0, 0), (0, 4.4, 0)), spacing=0.5, name="Desks")
    (by_sun, _) = gonio.annual_glare(scene, weather, eyes, blinds=0.1, **words)
    assert 500 < by_sun.closed_hours[0] < 3600

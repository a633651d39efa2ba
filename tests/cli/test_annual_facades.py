"""Groups of windows in one trace of `gonio annual`: their light adds up to all of it, each has its blinds, and what is said of none is told."""

import json

import facade_room
import numpy as np
import pytest
from failures import error_of
from wea_years import HOUR, write_wea

SOUTH, WEST = ("--group", "south=/Room/South"), ("--group", "west=/Room/West")
ALWAYS = "0-24"


@pytest.fixture(scope="module")
def year(run, tmp_path_factory):
    """Calculates a year of the room; gives the grid's figures, all light and the direct one. Runs with the same words are the same."""
    folder = tmp_path_factory.mktemp("facades")
    write_wea(folder / "year.wea", np.where(np.abs(HOUR - 12) < 3, 50000, 0), np.where(np.abs(HOUR - 12) < 6, 9000, 0))
    (folder / "room.usda").write_text(facade_room.stage())
    known = {}

    def calculate(*options, spp=4096, expect=0):
        words = ["annual", folder / "room.usda", "--weather", folder / "year.wea", "--grid", "/Room/Floor", "--height", 0.8, "--spacing", 1]
        words = tuple(map(str, [*words, "-p", spp, "-q", "--json", *options]))
        if expect:
            return error_of(run(*words))
        if words not in known:
            out = folder / str(len(known))
            done = run(*words, "-o", out, timeout=300)
            assert done.returncode == 0, done.stderr
            known[words] = json.loads(done.stdout)["grids"][0], np.load(out / "Floor_total.npy"), np.load(out / "Floor_direct.npy")
        return known[words]

    return calculate


def darkened(year, name):
    """The year while one facade lets nothing in."""
    return year(*SOUTH, *WEST, "--blinds", f"{name}=0", "--closed-hours", f"{name}={ALWAYS}")[1]


def test_groups_add_up_to_all_light(year):
    _, total, direct = year()
    for groups in (SOUTH, (*SOUTH, *WEST)):
        _, grouped, sun = year(*groups)
        assert grouped == pytest.approx(total, rel=1e-5, abs=1e-3) and sun == pytest.approx(direct, rel=1e-5, abs=1e-3)
    # Nothing comes by another way: each facade has what the other one does not.
    assert darkened(year, "south") + darkened(year, "west") == pytest.approx(total, rel=1e-5, abs=1e-2)


@pytest.mark.parametrize(("name", "other"), [("South", "West"), ("West", "South")])
def test_a_group_has_what_comes_through_its_panes(year, name, other):
    """With a board before the other window the same light comes in, but for what boards and panes throw back from inside."""
    _, shut, sun = year("--variant", f"/Room/{other}{{blinds=shut}}", spp=16384)
    found = darkened(year, other.lower())
    bright = shut > 50
    assert found.mean() == pytest.approx(shut.mean(), rel=0.02)
    assert np.median(found[bright] / shut[bright]) == pytest.approx(1, abs=0.03)
    _, _, both = year()
    _, _, rest = year("--variant", f"/Room/{name}{{blinds=shut}}", spp=16384)
    # Straight light is that of both to the ray.
    assert sun + rest == pytest.approx(both, rel=1e-5, abs=1e-2) and sun.max() > 1000


def test_real_blinds_of_one_and_of_both(year):
    for closed in (["south"], ["south", "west"]):
        states = {name: f"/Room/{name.title()}{{blinds=closed}}" for name in closed}
        blinds = [("--closed-hours", f"{name}={ALWAYS}", "--closed-variant", f"{name}={state}") for name, state in states.items()]
        grid, found, _ = year(*SOUTH, *WEST, *(word for words in blinds for word in words))
        _, total, _ = year(*(word for state in states.values() for word in ("--variant", state)))
        # What closed screens throw back of the other facade's light is left out: a little too dark.
        assert 0.93 < found.mean() / total.mean() < 1.01, (closed, found.mean(), total.mean())
        assert grid["groups"] == ["south", "west"] and grid["closed_hours"][0] > 3000
    assert grid["closed_hours"][1] > 3000
    # Traced together that is there too.
    shared = [word for state in states.values() for word in ("--closed-variant", state)]
    _, found, _ = year(*SOUTH, *WEST, *shared, "--closed-hours", ALWAYS)
    assert found == pytest.approx(total, rel=1e-5, abs=1e-2)


def test_sun_closes_the_groups_that_leave_most_light(year):
    """The rule (LM-83) by hand: of all ways to close blinds that keep the sun from all but 2 % of the points the brightest."""
    share = 0.1
    grid, found, _ = year(*SOUTH, *WEST, "--blinds", share)
    light = [darkened(year, other) for other in ("west", "south")]
    suns = [year("--variant", f"/Room/{other}{{blinds=shut}}", spp=16384)[2] for other in ("West", "South")]
    ways = [(1, 1), (share, 1), (1, share), (share, share)]
    totals = np.array([south * light[0] + west * light[1] for south, west in ways])
    sunny = np.array([((south == 1) * suns[0] + (west == 1) * suns[1] >= 1000).mean(axis=0) > 0.02 for south, west in ways])
    brightness = np.where(sunny, -1, totals.sum(axis=1))
    brightness[3] = np.maximum(brightness[3], 0)
    best = brightness.argmax(axis=0)
    expected = np.take_along_axis(totals, best[None, None, :], axis=0)[0]
    assert found == pytest.approx(expected, rel=1e-4, abs=1e-1)
    used = (HOUR > 8) & (HOUR < 18) & (found.max(axis=0) > 0)
    closed = [(np.isin(best, which) & used).sum() for which in ([1, 3], [2, 3])]
    assert grid["closed_hours"] == closed and min(closed) > 100


def test_what_is_said_of_none_is_told(year):
    def said(*options):
        return year(*options, expect=1)

    assert "no group is called 'east'; --group east=/Prim makes one" in said(*SOUTH, "--blinds", "east=0.1")
    assert "'south' has no surface at or below /Room/Sout that light could come through" in said("--group", "south=/Room/Sout")
    assert "of the groups 'south' and 'all'; light comes by one" in said(*SOUTH, "--group", "all=/Room")
    assert "expected one of both" in said("--blinds", "0.1", "--closed-variant", "/Room/South{blinds=closed}")
    assert "but no blinds" in said(*SOUTH, "--closed-hours", "south=12-18")
    assert "1.5 was found, expected 0 to 1" in said("--blinds", "1.5")
    assert "'south' was found, expected NAME=/Prim" in said("--group", "south")


def test_python_has_groups_too(year, tmp_path):
    import gonio

    (tmp_path / "open.usda").write_text(facade_room.stage())
    (tmp_path / "closed.usda").write_text(facade_room.stage().replace('string blinds = "open"', 'string blinds = "closed"', 1))
    write_wea(tmp_path / "year.wea", np.where(np.abs(HOUR - 12) < 3, 50000, 0), np.where(np.abs(HOUR - 12) < 6, 9000, 0))
    weather = (tmp_path / "year.wea").read_bytes()
    scene, closed = [gonio.load_usd(str(tmp_path / f"{state}.usda")) for state in ("open", "closed")]
    for each in (scene, closed):
        each.add_grid(corner=(0.5, 0.5, 0.8), edges=((3, 0, 0), (0, 4, 0)), spacing=1.0, name="Desks")
    groups = {"south": "/Room/South", "west": ["/Room/West/Glass"]}
    (plain,) = gonio.annual(scene, weather, samples=512)
    (grouped,) = gonio.annual(scene, weather, samples=512, groups=groups)
    assert grouped.total == pytest.approx(np.asarray(plain.total), rel=1e-5, abs=1e-3)
    words = {"closed": {"south": closed}, "blinds": {"west": 0.0}, "closed_hours": {"south": (0, 24)}}
    (operated,) = gonio.annual(scene, weather, samples=512, groups=groups, **words)
    assert operated.figures["closed_hours"][0] > 3000
    assert np.asarray(operated.total).sum() < 0.8 * np.asarray(plain.total).sum()
    with pytest.raises(gonio.Error, match="no group is called 'east'"):
        gonio.annual(scene, weather, samples=64, groups=groups, blinds={"east": 0.1})

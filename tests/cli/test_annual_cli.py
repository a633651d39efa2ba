"""`gonio annual-metrics` against numpy: points see a share of the whole sky, so their light is that of the weather file, which is in lux."""

import csv
import json
import math

import numpy as np
import pytest

HEAD = "place Here\nlatitude 49.52\nlongitude -8.55\ntime_zone -15\nsite_elevation 96\nweather_data_file_units 3\n"
MONTHS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
DATES = [(month, day, hour) for month, days in enumerate(MONTHS, 1) for day in range(1, days + 1) for hour in range(24)]
STEPS = np.arange(8760)
HOUR = STEPS % 24 + 0.5
IS_LIGHT = (HOUR > 9) & (HOUR < 16)
USED = (HOUR > 8) & (HOUR < 18)
DIRECT = np.where(IS_LIGHT, STEPS * 37 % 13 * 6000, 0).astype(float)
DIFFUSE = np.where(IS_LIGHT, 6100 + STEPS * 53 % 11 * 3500, 0).astype(float)
DISC = math.pi * math.radians(0.2665) ** 2


def patches():
    """Sines of the heights and solid angles of Tregenza's patches, the ground first."""
    height = math.pi / 2 / 7.5
    sines, angles = [-1.0], [2 * math.pi]
    for row, count in enumerate((30, 30, 24, 24, 18, 12, 6)):
        solid = 2 * math.pi * (math.sin(height * (row + 1)) - math.sin(height * row)) / count
        sines += [math.sin(height * (row + 0.5))] * count
        angles += [solid] * count
    return np.array([*sines, 1.0]), np.array([*angles, 2 * math.pi * (1 - math.cos(height / 2))])


def level(*shares):
    """Coefficients of points that have these shares of the light outside."""
    sines, angles = patches()
    return np.array([share * np.maximum(sines, 0) * angles for share in shares], np.float32)


def sun_is_up():
    """By the formulas of Radiance's sun.c."""
    day = STEPS // 24 + 1
    declination = 0.4093 * np.sin(2 * np.pi / 365 * (day - 81))
    adjusted = 0.170 * np.sin(4 * np.pi / 373 * (day - 80)) - 0.129 * np.sin(2 * np.pi / 355 * (day - 8)) + 12 / 180 * (8.55 - 15)
    turn, latitude = (HOUR + adjusted) * np.pi / 12, math.radians(49.52)
    sine = math.sin(latitude) * np.sin(declination) - math.cos(latitude) * np.cos(declination) * np.cos(turn)
    return np.arcsin(sine) > -math.radians(0.2665)


def suns(*shares):
    """Coefficients of points that have these shares of the sun's light on a surface that faces it."""
    return np.repeat(np.array(shares, np.float32)[:, None] * np.float32(DISC), sun_is_up().sum(), axis=1)


def wea(direct, diffuse):
    rows = zip(DATES, direct, diffuse, strict=True)
    return HEAD + "".join(f"{month} {day} {hour}.500 {sun:.0f} {sky:.0f}\n" for (month, day, hour), sun, sky in rows)


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "year.wea").write_text(wea(DIRECT, DIFFUSE))
    (tmp_path / "grey.wea").write_text(wea(0 * DIRECT, DIFFUSE))
    return tmp_path


def calculated(run, folder, *arguments, weather="year.wea"):
    done = run("annual-metrics", "--weather", folder / weather, *arguments, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def saved(path, array):
    np.save(path, array)
    return path


def test_grey_skies_bring_their_light(run, folder):
    shares = (0.01, 0.03, 0.5)
    path = saved(folder / "room.npy", level(*shares))
    grid = calculated(run, folder, "--coefficients", path, "-o", folder / "out", weather="grey.wea")["grids"][0]
    lux = np.outer(shares, DIFFUSE)
    assert np.load(folder / "out" / "room_total.npy") == pytest.approx(lux, rel=1e-5)
    assert not (folder / "out" / "room_direct.npy").exists()
    used = lux[:, USED]
    for point, values in zip(grid["points"], used, strict=True):
        assert point["mean_lx"] == pytest.approx(values.mean(), rel=1e-5)
        assert point["cda_300"] == pytest.approx(np.minimum(values / 300, 1).mean(), rel=1e-5)
        # Away from the limits by more than rounding.
        assert np.abs(values[:, None] / (100, 300, 3000) - 1).min() > 1e-4
        assert point["da_300"] == pytest.approx((values >= 300).mean())
        assert point["udi_below_100"] == pytest.approx((values < 100).mean())
        assert point["udi_100_3000"] == pytest.approx(((values >= 100) & (values <= 3000)).mean())
        assert point["udi_above_3000"] == pytest.approx((values > 3000).mean())
        assert point["hours_direct_1000"] is None
    assert grid["name"] == "room" and grid["used_hours"] == 3650 and grid["ase_1000_250"] is None
    assert grid["sda_300_50"] == pytest.approx(((used >= 300).mean(1) >= 0.5).mean())
    assert [point["daylight_factor"] for point in grid["points"]] == pytest.approx([1, 3, 50], rel=1e-5)
    half = np.sort(DIFFUSE)[::-1][:4380]
    assert grid["en17037"]["median_diffuse_lx"] == pytest.approx(np.median(half))
    bright = np.argsort(-DIFFUSE, kind="stable")[:4380]
    expected = [(lux[:, bright] >= limit).mean(1) >= 0.5 for limit in (100, 300, 500, 750)]
    assert grid["en17037"]["hourly"]["area_100_300_500_750"] == pytest.approx([has.mean() for has in expected])
    with open(folder / "out" / "room_points.csv") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["mean_lx"]) for row in rows] == [point["mean_lx"] for point in grid["points"]]


def test_suns_stand_at_their_places(run, folder):
    sky, sun = (0.02, 0.02, 0.02), (0.1, 0.016, 0.0)
    files = {
        "--coefficients": saved(folder / "sky.npy", level(*sky)),
        "--sun-coefficients": saved(folder / "direct.npy", suns(*sun)),
        "--sun-total": saved(folder / "all.npy", suns(*sun)),
    }
    arguments = [word for pair in files.items() for word in pair]
    grid = calculated(run, folder, *arguments, "-o", folder / "out")["grids"][0]
    direct = np.outer(sun, np.where(sun_is_up(), DIRECT, 0))
    assert np.load(folder / "out" / "sky_direct.npy") == pytest.approx(direct, rel=1e-5)
    assert np.load(folder / "out" / "sky_total.npy") == pytest.approx(np.outer(sky, DIFFUSE) + direct, rel=1e-4, abs=0.1)
    hours = (direct[:, USED] >= 1000).sum(1)
    assert [point["hours_direct_1000"] for point in grid["points"]] == list(hours)
    assert grid["ase_1000_250"] == pytest.approx((hours > 250).mean()) and 0 < grid["ase_1000_250"] < 1


def test_columns_of_suns_are_radiances(run, folder):
    """Without them the sun stands at its place, unless it is asked for elsewhere."""
    room, direct = saved(folder / "room.npy", level(0.02)), saved(folder / "direct.npy", suns(0.1))
    assert calculated(run, folder, "--coefficients", room)["sun_position"] == "true"
    assert calculated(run, folder, "--coefficients", room, "--sun-position", "radiance")["sun_position"] == "radiance"
    assert calculated(run, folder, "--coefficients", room, "--sun-coefficients", direct)["sun_position"] == "radiance"
    words = ("--coefficients", room, "--sun-coefficients", direct, "--sun-position", "true")
    done = run("annual-metrics", "--weather", folder / "year.wea", *words)
    assert done.returncode == 1 and "sun-position: true was found, but columns of suns, which gendaymtx places; expected radiance" in done.stderr


def test_blinds_close_by_groups(run, folder):
    files = [saved(folder / f"{name}.npy", level(*[0.02] * 4)) for name in ("south", "west")]
    direct = [saved(folder / "south_sun.npy", suns(0.1, 0, 0, 0)), saved(folder / "west_sun.npy", suns(0, 0, 0, 0))]
    options = ("--groups", "--coefficients", *files, "--sun-coefficients", *direct, "-o", folder / "out")
    calculated(run, folder, *options)
    open_ = np.load(folder / "out" / "south_total.npy")
    grid = calculated(run, folder, *options, "--blinds", 0)["grids"][0]
    closed = np.load(folder / "out" / "south_total.npy")
    shut = sun_is_up() & (0.1 * DIRECT >= 1000)
    assert shut.sum() > 500
    assert closed == pytest.approx(np.where(shut, open_ / 2, open_), rel=1e-5)
    assert grid["ase_1000_250"] == 0.25


def test_matrices_of_radiance_are_those_of_numpy(run, folder):
    array = level(0.02, 0.04)
    text = "\n".join("\t".join(f"{value:.9g} {value:.9g} {value:.9g}" for value in row) for row in array)
    (folder / "room.mtx").write_text(f"#?RADIANCE\nrcontrib\nNCOMP=3\nNROWS=2\nNCOLS=146\nFORMAT=ascii\n\n{text}\n")
    head = b"#?RADIANCE\nNCOMP=3\nNROWS=2\nNCOLS=146\nBigEndian=0\nFORMAT=float\n\n"
    (folder / "binary.mtx").write_bytes(head + np.repeat(array[..., None], 3, axis=2).astype("<f4").tobytes())
    files = (saved(folder / "room.npy", array), folder / "room.mtx", folder / "binary.mtx")
    grids = calculated(run, folder, "--coefficients", *files)["grids"]
    assert [grid["name"] for grid in grids] == ["room_1", "room_2", "binary"]
    for grid in grids[1:]:
        assert grid["mean_lx"] == pytest.approx(grids[0]["mean_lx"], rel=1e-6)


def test_blocks_tell_standard_errors(run, folder):
    path = saved(folder / "room.npy", np.array([level(0.018), level(0.022)]))
    grid = calculated(run, folder, "--coefficients", path)["grids"][0]
    assert grid["standard_errors"]["points"][0]["mean_lx"] == pytest.approx(0.1 * grid["points"][0]["mean_lx"], rel=1e-4)
    text = run("annual-metrics", "--weather", folder / "year.wea", "--coefficients", path).stdout
    assert "sDA 300/50 %" in text and "±" in text and "not known without coefficients of the sun" in text


def test_errors_of_a_grid_are_those_of_the_jackknife(run, folder):
    """By the figures of the mean of all blocks but one, each calculated by itself."""
    blocks = np.array([level(0.01, 0.03, 0.02), level(0.02, 0.01, 0.022), level(0.015, 0.02, 0.024)])
    whole = calculated(run, folder, "--coefficients", saved(folder / "room.npy", blocks))["grids"][0]
    files = [saved(folder / f"without_{k}.npy", np.delete(blocks, k, 0).mean(0)) for k in range(3)]
    without = calculated(run, folder, "--coefficients", *files)["grids"]
    shares = lambda of: [of["en17037"][method]["area_100_300_500_750"] for method in ("hourly", "daylight_factor")]
    for figures in (lambda of: [of["da_300"], of["cda_300"], of["udi_100_3000"], of["mean_lx"]], shares):
        found = np.array([figures(grid) for grid in without])
        expected = np.sqrt(2 / 3 * ((found - found.mean(0)) ** 2).sum(0))
        assert np.array(figures(whole["standard_errors"])) == pytest.approx(expected, rel=1e-4, abs=1e-9) and expected.max() > 0
    assert whole["da_300"] == pytest.approx(np.mean([point["da_300"] for point in whole["points"]]))


@pytest.mark.parametrize("parts", [12, 4, 1])
@pytest.mark.parametrize("first", [1.0, 0.0, 0.5], ids=["ends", "starts", "middles"])
def test_hours_may_be_counted_by_their_ends(run, folder, parts, first):
    """Files of parts of an hour go from 1.000 to 24.917 where hours are told by their ends. It is light from 9 o'clock on: an hour off is seen."""
    rows = zip(DATES, DIRECT, DIFFUSE, strict=True)
    shift = 0.5 / parts if first == 0.5 else first
    times = np.arange(parts) / parts + shift
    text = [f"{month} {day} {hour + time:.3f} {sun:.0f} {sky:.0f}\n" for (month, day, hour), sun, sky in rows for time in times]
    (folder / "parts.wea").write_text(HEAD + "".join(text))
    coefficients = saved(folder / "room.npy", level(0.02, 0.03))
    asked = ("--coefficients", coefficients, "--schedule", "9-12")
    (found,), (hours,) = (calculated(run, folder, *asked, weather=name)["grids"] for name in ("parts.wea", "year.wea"))
    assert found["mean_lx"] == pytest.approx(hours["mean_lx"], rel=0.01)


BAD = [
    (("--schedule", "18-8"), "schedule: 18-8 was found"),
    (("--schedule", "noon"), "'noon' was found, expected hours such as 8-18, or a file"),
    (("--ground", "1.5"), "ground: 1.5 was found, expected 0 to 1"),
    (("--sky", "hosek-wilkie"), "hosek-wilkie knows clear skies alone"),
    (("-m", "2"), "room.npy: 146 columns, expected 578 of -m 2"),
    (("--sun-coefficients", "{short}"), "short.npy: 1 rows, expected 2"),
    (("--sun-total", "{room}"), "room.npy: 146 columns, expected"),
    (("--sun-coefficients", "{room}", "{room}"), "2 files were found, expected 1, one for each of --coefficients"),
    (("--sun-coefficients", "{room}", "--blinds", "2"), "blinds: 2 was found, expected 0 to 1"),
    (("--sun-coefficients", "{absent}"), "absent.npy"),
]


@pytest.mark.parametrize(("words", "expected"), BAD)
def test_what_does_not_fit_is_told(run, folder, words, expected):
    files = {"absent": folder / "absent.npy", "room": saved(folder / "room.npy", level(0.02, 0.03))}
    files["short"] = saved(folder / "short.npy", level(0.02))
    words = [word.format(**files) for word in words]
    done = run("annual-metrics", "--weather", folder / "year.wea", "--coefficients", files["room"], *words)
    assert done.returncode == 1 and done.stdout == ""
    assert expected in done.stderr and len(done.stderr.strip().split("\n")) == 1


WEATHER = [
    (lambda lines: lines[:100] + lines[101:], ":101: the record is of 4.1. 23.50 h, expected 4.1. 22.50 h"),
    (lambda lines: lines[:5000], ":5000: the file ends after 4994 records, expected 8760"),
    (lambda lines: [*lines[:20], "1 1 14.5 nan 0", *lines[21:]], ":21: the direct normal illuminance is 'nan'"),
    (lambda lines: [*lines[:20], "1 32 14.5 0 0", *lines[21:]], ":21: the day is '32'"),
]


@pytest.mark.parametrize(("change", "expected"), WEATHER)
def test_years_that_are_none(run, folder, change, expected):
    (folder / "bad.wea").write_text("\n".join(change((folder / "year.wea").read_text().split("\n"))))
    done = run("annual-metrics", "--weather", folder / "bad.wea", "--coefficients", saved(folder / "room.npy", level(0.02)))
    assert done.returncode == 1 and "bad.wea" in done.stderr and expected in done.stderr


@pytest.mark.parametrize("control", ["dimming", "switching"])
@pytest.mark.parametrize("sensor", ["least", "mean", "points"])
def test_electric_light_gives_what_daylight_lacks(run, folder, control, sensor):
    shares, target = np.array([0.01, 0.03]), 300.0
    path = saved(folder / "room.npy", level(*shares))
    lamps = ("--lighting-power", 8, "--lighting-target", target, "--lighting-control", control, "--lighting-sensor", sensor)
    rest = ("--lighting-least", 0.2, "--lighting-presence", 0.9, "--lighting-standby", 2.5)
    whole = calculated(run, folder, "--coefficients", path, *lamps, *rest, weather="grey.wea")
    # Each point has its share of the weather's light.
    daylight = shares[:, None] * DIFFUSE[USED]
    seen = {"least": daylight[:1], "mean": daylight.mean(0, keepdims=True), "points": daylight}[sensor]
    load = np.clip(1 - seen / target, 0.2, 1) if control == "dimming" else (seen < target).astype(float)
    lit = IS_LIGHT[USED]
    hours = load[:, lit].mean(0).sum() + np.sum(~lit)
    found = whole["grids"][0]["electric"]
    assert found["daylight_hours"] == lit.sum()
    assert found["full_load_hours"] == pytest.approx(hours, rel=2e-3)
    assert found["leni_kwh_m2"] == pytest.approx(8 * 0.9 * hours / 1000 + 2.5, rel=2e-3)
    assert found["leni_without_daylight_kwh_m2"] == pytest.approx(8 * 0.9 * USED.sum() / 1000 + 2.5)
    assert found["daylight_dependency"] == pytest.approx(load[:, lit].mean(), abs=2e-3)


def test_the_verdict_reads_the_energy(run, folder):
    path = saved(folder / "room.npy", np.stack([level(0.02), level(0.021)]))
    lines = run("annual-metrics", "--weather", folder / "grey.wea", "--coefficients", path, "--lighting-power", 8)
    assert "electric light: LENI " in lines.stdout and " ± " in lines.stdout
    (folder / "year.json").write_text(json.dumps(calculated(run, folder, "--coefficients", path, "--lighting-power", 8)))
    (folder / "required.toml").write_text('[[require]]\narea = "room"\nquantity = "leni_kwh_m2"\nat_most = 40\n')
    done = run("verdict", folder / "required.toml", folder / "year.json", "--json")
    assert [line["verdict"] for line in json.loads(done.stdout)["requirements"]] == ["met"], done.stderr


def test_lamps_that_cannot_be_are_told(run, folder):
    path = saved(folder / "room.npy", level(0.02))
    common = ("annual-metrics", "--weather", folder / "grey.wea", "--coefficients", path)
    assert "--lighting-power" in run(*common, "--lighting-target", 300).stderr
    done = run(*common, "--lighting-power", 8, "--lighting-presence", 1.5)
    assert done.returncode == 1 and "lighting-presence: 1.5 was found, expected 0 to 1" in done.stderr

"""Plots of `gonio annual -o` and `gonio annual-glare -o`, and the year in `gonio report`: held to the series and tables that stand beside them."""

import csv
import json
import re
import xml.etree.ElementTree as ET
from pathlib import Path

import numpy as np
import pytest
from test_report import Reader
from wea_years import HOUR, write_wea

pytest.importorskip("gonio")
pytest.importorskip("pxr")

SVG = "{http://www.w3.org/2000/svg}"
MODEL = Path(__file__).resolve().parents[2] / "examples/models/office.hbjson"
STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Floor" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(0, 0, 0), (3, 0, 0), (3, 2, 0), (0, 2, 0)]
}
def Mesh "Roof" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(0, 1, 1), (3, 1, 1), (3, 9, 1), (0, 9, 1)]
}
"""
LUX = [0, 100, 200, 300, 500, 750, 1000, 2000, 3000, 5000, 10000]


@pytest.fixture(scope="module")
def year(run, tmp_path_factory):
    """A year of a floor half under a roof: its folder, and what was printed."""
    folder = tmp_path_factory.mktemp("year")
    steps = np.arange(8760)
    light = (HOUR > 6) & (HOUR < 18)
    write_wea(folder / "year.wea", np.where(light, steps * 37 % 13 * 3000, 0), np.where(light, 200 + steps * 53 % 11 * 1500, 0))
    (folder / "stage.usda").write_text(STAGE)
    words = ("--weather", folder / "year.wea", "--grid", "/Floor", "--height", 0.1, "--spacing", 1, "--blinds", 0.5, "-p", 256, "-m", 1, "-q")
    done = run("annual", folder / "stage.usda", *words, "--json", "-o", folder / "out", timeout=120)
    assert done.returncode == 0, done.stderr
    return folder / "out", json.loads(done.stdout)


def table(folder):
    return list(csv.DictReader((folder / "Floor_points.csv").read_text().splitlines()))


def plot(path):
    root = ET.parse(path).getroot()
    return root, [element.text for element in root.iter(f"{SVG}text")]


def test_what_json_prints_is_kept(year):
    folder, printed = year
    assert json.loads((folder / "year.json").read_text()) == printed
    assert printed["step_hours"] == 1 and len(printed["sunrise_sunset_h"]) == 365
    rise, set_ = printed["sunrise_sunset_h"][171]
    # At 49.5° north the longest day has 16.3 hours with the disc's edge, the shortest 8.1.
    assert set_ - rise == pytest.approx(16.2, abs=0.2)
    rise, set_ = printed["sunrise_sunset_h"][354]
    assert set_ - rise == pytest.approx(8.0, abs=0.2)


def test_the_plan_has_the_points_values_where_they_lie(year):
    folder, printed = year
    points = table(folder)
    for figure, factor, decimals in [("da_300", 100, 0), ("udi_100_3000", 100, 0), ("daylight_factor", 1, 1), ("hours_direct_1000", 1, 0)]:
        root, texts = plot(folder / f"Floor_{figure}.svg")
        expected = [f"{factor * float(point[figure]):.{decimals}f}" for point in points]
        cells = [element for element in root.iter(f"{SVG}text") if element.get("class") is None]
        assert [cell.text for cell in cells] == expected
        # Row by row from below, 1 m apart, metres beside them.
        places = np.array([[float(cell.get("x")), float(cell.get("y"))] for cell in cells]).reshape(2, 3, 2)
        assert (np.diff(places[:, :, 0], axis=1) > 0).all() and (np.diff(places[:, :, 1], axis=0) < 0).all()
        assert np.diff(places[0, :, 0])[0] == pytest.approx(-np.diff(places[:, 0, 1])[0], abs=0.2)
        assert {"m", "3"} <= set(texts)
        # Straight light of the sun has no noise.
        assert any("standard error of a point" in text for text in texts) == (figure != "hours_direct_1000")
    mean, error = 100 * printed["grids"][0]["da_300"], 100 * printed["grids"][0]["standard_errors"]["da_300"]
    assert mean == pytest.approx(100 * np.mean([float(point["da_300"]) for point in points]))
    told = next(text for text in plot(folder / "Floor_da_300.svg")[1] if "mean of the points" in text)
    assert float(re.search(r"points ([\d.]+)", told)[1]) == pytest.approx(mean, abs=0.1 + error)


def test_the_carpet_has_every_hour_in_its_class(year):
    folder, printed = year
    means = np.load(folder / "Floor_total.npy").mean(0)
    root, texts = plot(folder / "Floor_year.svg")
    found = np.full(8760, -1)
    paths = [path for path in root.iter(f"{SVG}path") if path.get("class") is None]
    colours = [rect.get("fill") for rect in root.iter(f"{SVG}rect") if rect.get("class") is None]
    for path in paths:
        for day, hour, count in re.findall(r"M(\d+) (\d+)h1v(\d+)h-1z", path.get("d")):
            found[24 * int(day) + int(hour) :][: int(count)] = colours.index(path.get("fill"))
    expected = np.where(means > 0, np.digitize(means, LUX) - 1, -1)
    # Values on an edge may round to either side.
    near = np.abs(means[:, None] / np.maximum(LUX, 1) - 1).min(1) < 1e-5
    assert (found[~near] == expected[~near]).all() and (found >= 0).sum() > 3000
    curves = [path for path in root.iter(f"{SVG}path") if path.get("class") == "curve"]
    assert len(curves) == 2 and {"Jan", "Dec", "0", "24", "lx", "10000"} <= set(texts)
    assert len(printed["grids"][0]["closed_hours"]) == 1


def test_bands_are_the_points_shares(year):
    folder, _ = year
    points = sorted(table(folder), key=lambda point: float(point["mean_lx"]))
    root, texts = plot(folder / "Floor_bands.svg")
    names = ["udi_below_100", "udi_100_300", "udi_300_3000", "udi_above_3000"]
    paths = [path for path in root.iter(f"{SVG}path") if path.get("class") is None]
    heights = np.array([[float(height) for height in re.findall(r"v-([\d.]+)h", path.get("d"))] for path in paths])
    expected = np.array([[float(point[name]) for point in points] for name in names])
    assert heights / heights.sum(0) == pytest.approx(expected, abs=1e-4)
    assert "300–3000 lx" in texts and f"∅ {100 * expected[2].mean():.1f}\u00a0%" in texts


def test_plots_are_read_by_light_and_dark_and_need_nothing_else(year):
    folder, _ = year
    for path in folder.glob("*.svg"):
        text = path.read_text(encoding="utf-8")
        assert "prefers-color-scheme:dark" in text and "<title>" in text and 'role="img"' in text
        assert not any(outside in text.replace('xmlns="http://www.w3.org/2000/svg"', "") for outside in ["http", "url(", "href", "@import"])
    assert len(list(folder.glob("*.svg"))) == 6


def test_a_year_stands_in_reports(run, year, tmp_path):
    folder, printed = year
    stage = folder.parent / "stage.usda"
    for code, comma in (("en", "."), ("de", ",")):
        page = tmp_path / f"{code}.html"
        done = run("report", stage, "-o", page, "--no-pictures", "--language", code, "--annual", folder, "-q")
        assert done.returncode == 0, done.stderr
        text = page.read_text(encoding="utf-8")
        reader = Reader(text)
        grid = printed["grids"][0]
        figures = next(table for table in reader.tables if "sDA 300/50 %" in table[0])
        number = lambda cell: float(cell.replace(",", ".").split()[0])
        assert figures[1][:2] == ["Floor", "6"] and comma in figures[1][6]
        expected = [100 * grid[key] for key in ("sda_300_50", "ase_1000_250", "udi_100_3000", "da_300", "cda_300")]
        assert [number(cell) for cell in figures[1][2:7]] == pytest.approx(expected, abs=0.051)
        assert number(figures[1][7]) == pytest.approx(grid["median_daylight_factor"], rel=0.01) and "±" in figures[1][7]
        methods = next(table for table in reader.tables if table[0][-1] == "750 lx")
        shares = [number(cell) for cell in methods[1][3:]]
        assert shares == pytest.approx([100 * share for share in grid["en17037"]["hourly"]["area_100_300_500_750"]], abs=0.1)
        assert text.count('class="gonio-plot"') == 6
        assert f"{grid['closed_hours'][0]:.0f} h" in text and "year.wea" in text
    assert "keine Bescheinigung der Übereinstimmung" in text and "Tageslichtautonomie" in text


def test_errors_of_years_are_one_line(run, year, tmp_path):
    folder, printed = year
    stage = folder.parent / "stage.usda"
    for change, words in (
        (lambda kept: (kept / "year.json").unlink(), "there is no year.json; 'gonio annual -o' writes it"),
        (lambda kept: (kept / "year.json").write_text("{}"), "no year of 'gonio annual': missing field"),
        (lambda kept: (kept / "Floor_total.npy").unlink(), "Floor_total.npy"),
        (lambda kept: np.save(kept / "Floor_total.npy", np.ones((6, 8759), np.float32)), "8759 steps were found, expected the year's 8760"),
        (lambda kept: (kept / "year.json").write_text(json.dumps({**printed, "grids": [{"name": "x"}]})), "no grid of 'gonio annual'"),
    ):
        kept = tmp_path / "kept"
        kept.mkdir(exist_ok=True)
        for name in ("year.json", "Floor_total.npy"):
            (kept / name).write_bytes((folder / name).read_bytes())
        change(kept)
        done = run("report", stage, "-o", tmp_path / "page.html", "--annual", kept, "-q", check=False)
        assert done.returncode == 1 and words in done.stderr and len(done.stderr.splitlines()) == 1, done.stderr
        assert not (tmp_path / "page.html").exists()


def test_glare_is_drawn_by_its_classes(run, year, tmp_path):
    folder, _ = year
    eye = ("--eye", "1.5,0.5,0.5", "--facing", "0,-1,0", "-p", 64, "-m", 1, "-q", "-o", tmp_path / "out")
    done = run("annual-glare", folder.parent / "stage.usda", "--weather", folder.parent / "year.wea", *eye, timeout=120)
    assert done.returncode == 0, done.stderr
    values = np.load(tmp_path / "out" / "glare.npy")[0]
    root, texts = plot(tmp_path / "out" / "glare_1.svg")
    hours = sum(int(count) for path in root.iter(f"{SVG}path") for count in re.findall(r"h1v(\d+)h-1z", path.get("d")))
    assert hours == (values > 0).sum() and {"0.35", "0.4", "0.45", "DGP"} <= set(texts)
    assert any("is exceeded in 5 % of the used time" in text for text in texts)


def test_sensors_of_a_model_have_a_plan_in_any_order(run, tmp_path):
    model = json.loads(MODEL.read_text())
    (grid,) = model["properties"]["radiance"]["sensor_grids"]
    # As honeybee often has them: column by column.
    grid["sensors"].sort(key=lambda sensor: sensor["pos"])
    (tmp_path / "office.hbjson").write_text(json.dumps(model))
    light = (HOUR > 6) & (HOUR < 18)
    write_wea(tmp_path / "year.wea", np.where(light, 10_000, 0), np.where(light, 5_000, 0))
    words = ("--weather", tmp_path / "year.wea", "-p", 256, "-m", 1, "-q", "--json", "-o", tmp_path / "out")
    done = run("annual", tmp_path / "office.hbjson", *words, timeout=120)
    assert done.returncode == 0, done.stderr
    (found,) = json.loads(done.stdout)["grids"]
    assert (found["columns"], found["rows"]) == (10, 7)
    for cell, point in zip(found["cells"], found["points"], strict=True):
        x, y, _ = point["position_m"]
        assert [cell % 10, cell // 10] == pytest.approx([(x - 0.75) / 0.5, (y - 0.75) / 0.5], abs=1e-6)
    by_cell = dict(zip(found["cells"], found["points"], strict=True))
    root, _ = plot(tmp_path / "out" / "desks_daylight_factor.svg")
    shown = [element.text for element in root.iter(f"{SVG}text") if element.get("class") is None]
    assert shown == [f"{by_cell[cell]['daylight_factor']:.1f}" for cell in range(70)]

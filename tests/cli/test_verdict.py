"""`gonio verdict`: verdicts of small files made by hand, the sheet's page and PDF, and errors with their lines."""

import hashlib
import json
import os
import shutil

import pytest

pytest.importorskip("gonio")

BROWSER = next(filter(None, map(shutil.which, ["chromium", "chromium-browser", "google-chrome"])), None)

DESK = {
    "meters": [
        {"name": "/Office/Eye", "quantity": "ugr", "unit": "", "position_m": [1, 2, 1.2], "value": 18.2, "standard_error": 0.1},
        {"name": "/Office/Ear", "quantity": "cylindrical", "unit": "lx", "position_m": [1, 2, 1.2], "value": 160.0, "standard_error": 1.0},
    ],
    "grids": [
        {
            "name": "/Office/Desk",
            "quantity": "illuminance",
            "unit": "lx",
            "columns": 3,
            "rows": 2,
            "spacing_m": [0.5, 0.4],
            "points": 6,
            "average": {"value": 640.0, "standard_error": 4.0},
            "min": {"value": 500.0, "standard_error": 40.0},
            "max": {"value": 700.0, "standard_error": 8.0},
            "values": [500.0, 640.0, 660.0, 650.0, 690.0, 700.0],
        }
    ],
}
YEAR = {"weather": "a.epw", "grids": [{"name": "Desk", "sda_300_50": 0.62, "standard_errors": {"sda_300_50": 0.01}}]}

MEAN = """[[require]]
area = "Desk"
quantity = "mean"
at_least = {limit}
label = "Em"
maintenance_factor = 0.8
"""
OTHERS = """[[require]]
area = "eye"
quantity = "ugr"
at_most = 19

[[require]]
area = "Desk"
quantity = "sda_300_50"
at_least = 55
unit = "%"
"""


@pytest.fixture
def files(tmp_path):
    """Writes requirements and what was measured; gives their paths."""

    def write(requirements, *measured):
        paths = [tmp_path / "office.toml", *(tmp_path / f"{k}.json" for k in range(len(measured)))]
        paths[0].write_text(requirements)
        for path, found in zip(paths[1:], measured, strict=True):
            path.write_text(found if isinstance(found, str) else json.dumps(found))
        return paths

    return write


def judged(run, paths, status):
    done = run("verdict", *paths, "--json")
    assert done.returncode == status, done.stderr + done.stdout
    return json.loads(done.stdout)


# The mean is 0.8 · (640 ± 4) = 512 ± 3.2.
@pytest.mark.parametrize(
    ("limit", "verdict", "status"),
    [(500, "met", 0), (505.7, "within_error", 3), (512, "within_error", 3), (518.3, "within_error", 3), (519, "not_met", 1)],
)
def test_two_standard_errors_part_the_verdicts(run, files, limit, verdict, status):
    found = judged(run, files(MEAN.format(limit=limit) + OTHERS, DESK, YEAR), status)
    assert [line["verdict"] for line in found["requirements"]] == [verdict, "met", "met"]
    assert found["verdict"] == verdict
    reached = found["requirements"][0]["reached"]
    assert [reached["value"], reached["standard_error"], reached["margin"]] == pytest.approx([512, 3.2, 512 - limit])
    assert reached["interval"] == pytest.approx([505.6, 518.4])
    if verdict == "within_error" and limit != 512:
        assert reached["more_samples"] == pytest.approx((2 * 3.2 / (512 - limit)) ** 2)
    else:
        assert reached["more_samples"] is None
    assert found["requirements"][2]["reached"]["value"] == pytest.approx(62)


def test_sums_are_those_of_the_files(run, files):
    paths = files(MEAN.format(limit=500), DESK)
    found = judged(run, paths, 0)
    expected = [{"path": str(path), "sha256": hashlib.sha256(path.read_bytes()).hexdigest()} for path in paths]
    assert found["files"] == expected


def test_what_was_not_measured_is_told_with_what_there_is(run, files):
    paths = files(MEAN.format(limit=1).replace("Desk", "Deks") + OTHERS.replace("ugr", "urg"), DESK, YEAR)
    done = run("verdict", *paths)
    assert done.returncode == 1
    assert "office.toml:1: nothing measured is called 'Deks'. Did you mean 'Desk'?" in done.stdout or "Did you mean '/Office/Desk'?" in done.stdout
    assert "there is no 'urg' of this area. Did you mean 'ugr'?" in done.stdout
    assert "1 met, 2 not measured" in done.stdout


def test_noisy_least_points_are_told(run, files):
    done = run("verdict", *files(MEAN.format(limit=300).replace("mean", "minimum"), DESK))
    assert done.returncode == 0, done.stdout
    assert "The least point's own error is 8 % of its value" in done.stdout


def test_the_page_holds_everything_itself(run, files, tmp_path):
    sheet = tmp_path / "new" / "sheet.html"
    paths = files('title = "Büro <2>"\n' + MEAN.format(limit=510) + OTHERS, DESK, YEAR)
    done = run("verdict", *paths, "-o", sheet, "--language", "de", "--date", "1. März 2026")
    assert done.returncode == 3 and str(sheet) in done.stdout
    html = sheet.read_text()
    parts = ["Büro &lt;2&gt;", "512,0 ± 3,2\u00a0lx", "innerhalb des Fehlers", "1. März 2026", "keine Bescheinigung", "<svg viewBox", ">700</text>"]
    assert [part for part in parts if part not in html] == []
    assert not any(outside in html for outside in ["http:", "https:", " src=", "@import", "url("])


@pytest.mark.skipif(BROWSER is None, reason="no browser to print with")
def test_pdf_by_a_browser(run, files, tmp_path):
    sheet = tmp_path / "sheet.pdf"
    done = run("verdict", *files(MEAN.format(limit=500), DESK), "-o", sheet, timeout=120)
    assert done.returncode == 0, done.stderr
    assert sheet.read_bytes().startswith(b"%PDF")


def test_pdf_without_a_browser(run, files, tmp_path):
    sheet = tmp_path / "sheet.pdf"
    done = run("verdict", *files(MEAN.format(limit=500), DESK), "-o", sheet, env={**os.environ, "PATH": str(tmp_path)})
    assert done.returncode == 1 and not sheet.exists()
    assert "none of chromium, chromium-browser and google-chrome is on PATH" in done.stderr


@pytest.mark.parametrize(
    ("old", "new", "line"),
    [
        ("at_least", "at_lest", "office.toml:4: [[require]]: the key 'at_lest' is not known; did you mean 'at_least'?"),
        ("at_least = 500", "at_least = nan", "office.toml:4: [[require]]: at_least is NaN"),
        ('label = "Em"', "at_most = 600", "office.toml:5: [[require]]: at_most stands beside at_least"),
        ('label = "Em"', 'unit = "%"', "office.toml:1: unit is '%', but that of mean of illuminance is \"lx\""),
        ("[[require]]", "[[require", "office.toml:1: no TOML"),
    ],
)
def test_errors_have_their_lines(run, files, old, new, line):
    done = run("verdict", *files(MEAN.format(limit=500).replace(old, new), DESK))
    assert done.returncode == 1 and done.stdout == ""
    assert line in done.stderr, done.stderr


NOTHING = [("", "an empty file"), ("{", "0.json:1: no JSON"), ("[]", "no object of JSON"), ('{"dgp": 1}', "expected what")]


@pytest.mark.parametrize(("text", "told"), NOTHING)
def test_files_of_nothing_measured(run, files, text, told):
    done = run("verdict", *files(MEAN.format(limit=500), text))
    assert done.returncode == 1 and told in done.stderr and "gonio measure" in done.stderr


@pytest.mark.parametrize(
    ("key", "told"),
    [
        ("diagnostics", [{"severity": "warning", "origin": "/Lamp", "message": "is left out"}, {"severity": "info", "origin": "/A", "message": "so"}]),
        ("doubts", ["/Lamp: is left out"]),
        ("notes", ["/Lamp: is left out"]),
    ],
)
def test_what_measuring_told_is_on_the_sheet(run, files, key, told):
    found = judged(run, files(MEAN.format(limit=500), {**DESK, key: told}), 0)
    assert "/Lamp: is left out" in found["requirements"][0]["notes"] and "/A: so" not in found["requirements"][0]["notes"]

"""The furnished floor with two facades of slats: what docs/annual.md tells of it runs, and its facades add up."""

import json

import furnished_floor
import numpy as np
import pytest
from wea_years import HOUR, write_wea

pytestmark = [pytest.mark.validate, pytest.mark.timeout(900)]

GROUPS = [word for name in ("south", "west") for word in ("--group", f"{name}=/Office/{name.title()}")]
SLATS = [word for name in ("south", "west") for word in ("--closed-variant", f"{name}=/Office/{name.title()}{{blinds=closed}}")]


def test_a_floor_with_two_facades(run, tmp_path):
    (tmp_path / "floor.usda").write_text(furnished_floor.stage())
    write_wea(tmp_path / "year.wea", np.where(np.abs(HOUR - 12) < 3, 50000, 0), np.where(np.abs(HOUR - 12) < 6, 9000, 0))
    words = [
        tmp_path / "floor.usda",
        "--weather",
        tmp_path / "year.wea",
        "--grid",
        "/Office/Floor",
        "--height",
        0.76,
        "--spacing",
        1.5,
        "-p",
        512,
        "-q",
    ]
    totals = {}
    for name, options in (("plain", []), ("groups", GROUPS), ("slats", [*GROUPS, *SLATS])):
        done = run("annual", *words, *options, "--json", "-o", tmp_path / name, timeout=600)
        assert done.returncode == 0, done.stderr
        totals[name] = np.load(tmp_path / name / "Floor_total.npy")
    assert totals["groups"] == pytest.approx(totals["plain"], rel=1e-5, abs=1e-3)
    closed = json.loads(done.stdout)["grids"][0]["closed_hours"]
    assert min(closed) > 200 and 0.2 < totals["slats"].mean() / totals["plain"].mean() < 0.95

"""IFC models where stages are asked for: measured, lit by the overcast sky, what is none is told."""

import json
import tempfile
from pathlib import Path

import pytest

pytest.importorskip("ifcopenshell", reason="IFC models need ifcopenshell")

from ifc_models import Building  # noqa: E402


@pytest.fixture(scope="module")
def model(tmp_path_factory):
    """A floor under the open sky with a room's space on it."""
    building = Building()
    building.block("IfcSlab", "Slab", (0, 0, -0.2), (6, 4, 0))
    building.block("IfcSpace", "101", (0, 0, 0), (6, 4, 3), LongName="Office")
    path = tmp_path_factory.mktemp("ifc") / "model.ifc"
    building.save(path)
    return path


def test_rooms_are_measured(model, run):
    before = set(Path(tempfile.gettempdir()).glob("gonio-ifc-*"))
    done = run("measure", model, "--json", "-p", "256", timeout=120)
    assert done.returncode == 0, done.stderr
    (grid,) = json.loads(done.stdout)["grids"]
    # The CIE's overcast sky of 10,000 lx, nothing before it.
    assert grid["average"]["value"] == pytest.approx(10000, rel=0.02)
    assert "overcast sky of 10000 lx" in done.stderr
    # What was taken by default is told.
    assert "no style says how light" in done.stderr
    assert set(Path(tempfile.gettempdir()).glob("gonio-ifc-*")) == before


def test_it_is_rendered(model, run, tmp_path):
    done = run("render", model, "-o", tmp_path / "model.png", "-w", "64", "--spp", "4", "-q", timeout=120)
    assert done.returncode == 0 and (tmp_path / "model.png").stat().st_size > 500, done.stderr


def test_what_is_no_model_is_told(run, tmp_path):
    broken = tmp_path / "broken.ifc"
    broken.write_text("ISO-10303-21;\nHEADER;")
    done = run("info", broken)
    assert done.returncode == 1
    assert done.stderr.count("broken.ifc") == 1 and "cut off" in done.stderr
    assert run("info", tmp_path / "none.ifc").returncode == 1


def test_layers_over_it_are_refused(model, run, tmp_path):
    done = run("dim", model, "-o", tmp_path / "dimmed.usda", "--target", "Office_101:mean>=500", timeout=120)
    assert done.returncode == 1


PLAN = """[[room]]
name = "Office"
surface = "Office_101"
height = 3
[[task]]
name = "Desk"
outline = [[2, 1, 0.75], [3.6, 1, 0.75], [3.6, 1.8, 0.75], [2, 1.8, 0.75]]
"""
REQUIRED = """title = "Office 101"
[[require]]
area = "Desk"
quantity = "mean"
of = "task"
at_least = 50
unit = "lx"
[[require]]
area = "Office"
quantity = "u0"
of = "walls"
at_least = 0.1
"""


def test_a_room_of_the_model_to_a_verdict_sheet(run, tmp_path):
    building = Building()
    building.block("IfcSlab", "Slab", (0, 0, -0.2), (6, 4, 0))
    building.block("IfcSpace", "101", (0, 0, 0), (6, 4, 3), LongName="Office")
    white, at = building.colour((1, 1, 1)), building.point((0, 0, 0))
    bulb = building.model.create_entity("IfcLightSourcePositional", None, white, None, None, at, 1.0, 1.0, 0.0, 0.0)
    lamp = building.fixture("Bulb", (3, 2, 2.5), bulb)
    building.properties(lamp, "Pset_LampTypeCommon", ContributedLuminousFlux=8000.0)
    building.save(tmp_path / "model.ifc")
    (tmp_path / "rooms.toml").write_text(PLAN)
    (tmp_path / "required.toml").write_text(REQUIRED)
    done = run("zones", tmp_path / "model.ifc", "--plan", tmp_path / "rooms.toml", "--spp", "64", "--json", timeout=120)
    assert done.returncode == 0, done.stderr
    found = json.loads(done.stdout)
    assert found["tasks"][0]["room"] == "Office" and len(found["rooms"][0]["each_wall"]) == 4
    # The bulb's direct light on the desk, and what the floor sends up to no ceiling.
    candela = 8000 / (4 * 3.14159265)
    lit = [candela * 1.745 / ((x - 3) ** 2 + (y - 2) ** 2 + 1.745**2) ** 1.5 for x, y, _ in (p["position_m"] for p in found["tasks"][0]["task"]["points"])]
    assert found["tasks"][0]["task"]["average_lx"] == pytest.approx(sum(lit) / len(lit), rel=0.01)
    (tmp_path / "rooms.json").write_text(done.stdout)
    judged = run("verdict", tmp_path / "required.toml", tmp_path / "rooms.json", "-o", tmp_path / "sheet.html")
    assert judged.returncode == 0, judged.stdout + judged.stderr
    page = (tmp_path / "sheet.html").read_text()
    # The desk's plan in false colour; all walls together have none.
    assert page.count('role="img" shape-rendering="crispEdges"') == 1 and "surface" not in judged.stderr

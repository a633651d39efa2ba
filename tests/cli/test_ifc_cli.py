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

"""`gonio bsdf`: figures, drawings, conversions and fits of files that the test writes."""

import json
import math
import xml.etree.ElementTree as ET

import pytest
from measured_files import MATT, ggx, matt_text, merl_bytes


@pytest.fixture
def matt(tmp_path):
    """A Lambertian surface of 50 %, 30 % and 10 %."""
    path = tmp_path / "matt.gbsdf"
    path.write_text(matt_text((0.5, 0.3, 0.1)))
    return path


@pytest.fixture(scope="module")
def metal(tmp_path_factory):
    """A metal in MERL's format."""
    path = tmp_path_factory.mktemp("metal") / "metal.binary"
    path.write_bytes(merl_bytes((30, 30, 60), ggx)[0])
    return path


def facts(run, *arguments):
    done = run("bsdf", *arguments, "--json")
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)


def test_figures(run, matt):
    found = facts(run, matt)
    assert (found["format"], found["kind"], found["isotropic"], found["channels"]) == ("gbsdf", "tables", True, "linear RGB")
    assert found["parts"][0]["axes"][0] == {"name": "theta_i", "mode": "linear", "count": 2, "first_deg": 0.0, "last_deg": 90.0}
    assert [row["theta_deg"] for row in found["albedo"]] == [0, 15, 30, 45, 60, 75, 85]
    for row in found["albedo"]:
        assert row["reflected"]["rgb"] == pytest.approx([0.5, 0.3, 0.1], abs=1e-3)
        assert row["transmitted"]["luminance"] == 0
    assert found["reciprocity"]["mean_difference"] < 1e-6
    assert found["problems"] == []


def test_text(run, metal):
    text = run("bsdf", metal).stdout
    for part in (
        "MERL: tables, isotropic, linear RGB",
        "reflection-front: half-difference, reciprocal",
        "theta_h: 30 angles",
        "reflected of light from the front",
    ):
        assert part in text


def test_what_is_wrong_is_told(run, tmp_path):
    path = tmp_path / "bright.gbsdf"
    path.write_text(MATT.format(values="1 1 1 " * 3 + "nan nan nan"))
    problems = " ".join(facts(run, path)["problems"])
    assert "more light leaves than arrives" in problems and "1 of 4 cells" in problems


def test_drawings(run, metal, tmp_path):
    lobes, colours = tmp_path / "lobes.svg", tmp_path / "map.svg"
    assert run("bsdf", metal, "--lobes", lobes, "--map", colours).returncode == 0
    for path in (lobes, colours):
        assert ET.parse(path).getroot().tag.endswith("svg")
        assert "metal.binary" in path.read_text() and "1/sr" in path.read_text()
    assert sorted(path.name for path in tmp_path.iterdir()) == ["lobes.svg", "map.svg"]


def test_tables_are_converted_as_they_are(run, metal, tmp_path):
    out = tmp_path / "metal.gbsdf"
    assert facts(run, metal, "-o", out)["conversion"] == {"resampled": False}
    again, before = facts(run, out), facts(run, metal)
    assert again["parts"][0]["axes"] == before["parts"][0]["axes"]
    shares = [[row["reflected"]["luminance"] for row in found["albedo"]] for found in (again, before)]
    # Angles have the digits of a text.
    assert shares[0] == pytest.approx(shares[1], rel=1e-9)


def test_other_data_is_evaluated_on_a_grid(run, metal, tmp_path):
    out = tmp_path / "metal.gbsdf"
    report = facts(run, metal, "-o", out, "--grid", 46, 72, "--text")["conversion"]
    assert (report["theta"], report["phi"]) == (46, 72) and report["mean_difference"] < 0.03
    assert out.read_text().startswith("gbsdf 1\ntitle metal.binary\n")
    assert facts(run, out)["parts"][0]["coordinates"] == "isotropic"


def test_a_fit_is_a_usd_material(run, metal, tmp_path):
    from pxr import Usd, UsdShade

    out = tmp_path / "metal.usda"
    fit = facts(run, metal, "--material", out)["fit"]
    assert fit["base_metalness"] == 1.0
    assert fit["specular_roughness"] == pytest.approx(math.sqrt(0.3), abs=0.02)
    assert fit["residual"] < 0.05
    for row in fit["albedo"]:
        assert row["fitted"] == pytest.approx(row["measured"], abs=0.05)
    stage = Usd.Stage.Open(str(out))
    shader = UsdShade.Material(stage.GetDefaultPrim()).ComputeSurfaceSource("mtlx")[0]
    assert shader.GetIdAttr().Get() == "ND_open_pbr_surface_surfaceshader"
    assert shader.GetInput("specular_roughness").Get() == pytest.approx(fit["specular_roughness"], abs=1e-4)
    assert list(shader.GetInput("base_color").Get()) == pytest.approx(fit["base_color"], abs=1e-4)
    assert "fit to OpenPBR: base_color" in run("bsdf", metal, "--fit").stdout


def test_real_files_are_read_whole(run, shared):
    klems = facts(run, shared("bsdf", "klems_aniso_high.xml"))
    assert klems["format"] == "BSDF XML" and len(klems["parts"]) >= 4
    assert all(part["patches"] == [145, 145] and all(0 < total < 1 for total in part["totals"]) for part in klems["parts"])
    white = facts(run, shared("bsdf", "spectralon_lowres.pbsdf"))
    assert white["format"] == "pBRDF" and white["wavelengths_nm"] == [450, 500, 550, 600, 650]


def test_errors_are_one_line_with_place(run, matt, tmp_path):
    broken = tmp_path / "broken.gbsdf"
    broken.write_text(matt.read_text().replace("axis theta_o linear 2\n0 90", "axis theta_o linear 2\n90 0"))
    cut = tmp_path / "cut.bsdf"
    cut.write_bytes(b"tensor_file\0\1\0\xff\xff\xff\xff")
    for arguments, expected in [
        ((broken,), "broken.gbsdf:8: theta_o: axis value 0"),
        ((cut,), "cut.bsdf: byte "),
        ((tmp_path / "none.bsdf",), "none.bsdf"),
        ((matt, "--lobes", tmp_path / "lobes.jpg"), "the ending is 'jpg', expected svg or png"),
        ((matt, "-o", tmp_path / "out.txt"), "the ending is 'txt', expected gbsdf"),
        ((matt, "-o", tmp_path / "out.gbsdf", "--grid", 720, 720), "expected 268435456 at most"),
    ]:
        failed = run("bsdf", *arguments)
        assert failed.returncode == 1
        assert expected in failed.stderr
        assert len(failed.stderr.strip().split("\n")) == 1
    assert sorted(entry.name for entry in tmp_path.iterdir()) == ["broken.gbsdf", "cut.bsdf", "matt.gbsdf"]

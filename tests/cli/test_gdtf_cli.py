"""GDTF files on the command line: what a stage fixture has, its light as an estimate, spectra, and what is wrong."""

import json
import zipfile

import gonio
import pytest

POINTS = "".join(f'<MeasurementPoint WaveLength="{nm}" Energy="{1 + (nm - 380) / 400}"/>' for nm in range(380, 781, 20))
DESCRIPTION = f"""<?xml version="1.0" encoding="UTF-8"?>
<GDTF DataVersion="1.2"><FixtureType Name="Head 20" Manufacturer="ACME">
<PhysicalDescriptions><Emitters><Emitter Name="White" Color="0.44,0.40,100"><Measurement Physical="100">{POINTS}</Measurement></Emitter>
</Emitters></PhysicalDescriptions>
<Geometries><Geometry Name="Base"><Beam Name="Beam" LuminousFlux="12000" ColorTemperature="3200" BeamAngle="20" FieldAngle="40"
BeamRadius="0.025" BeamType="Fresnel" PowerConsumption="350" EmitterSpectrum="White"/></Geometry>
<Geometry Name="Bar"><GeometryReference Geometry="Base"/><GeometryReference Geometry="Base"/></Geometry></Geometries>
<DMXModes><DMXMode Name="Standard" Geometry="Base"/><DMXMode Name="Bar" Geometry="Bar"/></DMXModes></FixtureType></GDTF>"""
ESTIMATE = "GDTF holds no measured light distribution: this is an estimate"


def write(path, description=DESCRIPTION):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as archive:
        archive.writestr("description.xml", description)
    return path


@pytest.fixture(scope="module")
def head(tmp_path_factory):
    return write(tmp_path_factory.mktemp("gdtf") / "head.gdtf")


@pytest.mark.parametrize("command", ["info", "photometry"])
def test_modes_are_listed(run, head, command):
    text = run(command, head).stdout
    for part in (
        "manufacturer: ACME",
        "fixture: Head 20",
        "file: GDTF 1.2, 2 modes, 1 emitters",
        "mode 1: Standard: 12000.0 lm, 350 W, 34.3 lm/W, about ",
        "    beam Beam: Fresnel, 12000 lm, beam angle 20°, field angle 40°, 3200 K, 350 W, radius 0.025 m, spectrum of White",
        "    2 × beam Beam: Fresnel",
        ESTIMATE,
        "emitter White: x 0.4400, y 0.4000, spectrum of 21 points",
    ):
        assert part in text, part
    found = json.loads(run(command, head, "--json").stdout)
    assert [mode["flux_lm"] for mode in found["modes"]] == pytest.approx([12000, 24000])
    assert found["modes"][0]["beams"][0]["type"] == "Fresnel" and len(found["emitters"][0]["spectrum"]) == 21


@pytest.mark.parametrize(("how", "flux"), [(("--variant", "standard"), 12000), (("--variant", "2"), 24000), ("#Bar", 24000)])
def test_a_mode_is_a_luminaire(run, head, how, flux):
    done = run("photometry", f"{head}{how}" if isinstance(how, str) else head, *(() if isinstance(how, str) else how), "--json")
    found = json.loads(done.stdout)
    assert found["flux_lm"] == pytest.approx(flux)
    assert found["beam_angle_deg"] == pytest.approx([20, 20]) and found["field_angle_deg"] == pytest.approx([40, 40])
    assert any(ESTIMATE in warning for warning in found["warnings"])


def test_a_mode_is_converted(run, head, tmp_path):
    for ending in ("ies", "ldt"):
        file = tmp_path / f"head.{ending}"
        assert run("photometry", head, "--variant", "1", "--convert", file).returncode == 0
        assert json.loads(run("photometry", file, "--json").stdout)["flux_lm"] == pytest.approx(12000, rel=1e-4)


def test_the_emitters_spectra(run, head):
    found = json.loads(run("spectrum", head, "--json").stdout)
    assert (found["points"], found["first_nm"], found["last_nm"]) == (21, 380, 780)


def test_a_stage_is_lit_by_a_fixture(run, head, tmp_path):
    stage = tmp_path / "stage.usda"
    stage.write_text(f"""#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def SphereLight "Head"
{{
    asset gonio:photometry:file = @{head}@
    string gonio:photometry:variant = "Bar"
}}
""")
    done = run("measure", stage, "--at", "0,0,-5", "--normal", "0,0,1", "--json")
    assert done.stderr.count(ESTIMATE) == 1
    peak = json.loads(run("photometry", head, "--variant", "Bar", "--json").stdout)["peak_cd"]
    assert json.loads(done.stdout)["meters"][0]["value"] == pytest.approx(peak / 25, rel=5e-3)


def test_python_reads_it(head):
    lamp, warnings = gonio.read_goniogram(head.read_bytes(), f"{head}#Bar")
    assert any(ESTIMATE in warning for warning in warnings) and lamp
    figures = gonio.goniogram_figures(head.read_bytes(), "head.gdtf")
    assert figures["flux_lm"] == pytest.approx(12000) and figures["beam_angle_deg"] == pytest.approx([20, 20])


@pytest.mark.parametrize(
    ("description", "message"),
    [
        ("<GDTF>\n</GDT>", "description.xml: line 2: not XML"),
        ("<Fixture/>", "description.xml: line 1: <Fixture> was found, expected <GDTF>"),
        ("<GDTF><FixtureType/></GDTF>", "the fixture has no mode, and so no beam that can be chosen"),
    ],
)
def test_what_is_wrong_is_told_with_its_place(run, tmp_path, description, message):
    file = write(tmp_path / "wrong.gdtf", description)
    found = run("photometry", file, "--polar", tmp_path / "polar.svg")
    assert found.returncode == 1 and message in found.stderr, found.stderr


def test_names_that_are_none(run, head, tmp_path):
    assert "no mode 'wide' was found among 2: 'Standard', 'Bar'" in run("photometry", head, "--variant", "wide").stderr
    empty = tmp_path / "no.gdtf"
    with zipfile.ZipFile(empty, "w") as archive:
        archive.writestr("other.txt", "x")
    done = run("info", empty)
    assert done.returncode == 1
    assert "no description.xml is in the archive, expected one in a GDTF file; it holds 'other.txt'" in done.stderr

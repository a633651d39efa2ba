"""`gonio goniometer -o lamp.gldf`: a luminaire of a stage becomes a product, and a luminaire again."""

import io
import json
import zipfile
from xml.etree import ElementTree

import gonio
import numpy as np
import pytest

STAGE = """#usda 1.0
(
    metersPerUnit = 0.01
    upAxis = "Z"
)
def Xform "World"
{{
    double3 xformOp:translate = (300, 20, 50)
    float xformOp:rotateZ = 30
    uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateZ"]
    def Xform "Lamp"
    {{
        def DiskLight "Face"
        {{
            float inputs:radius = 10
            double gonio:photometry:quantity = 1000.4
            token gonio:photometry:unit = "lm"
            double3 xformOp:translate = (0, 0, -1)
            uniform token[] xformOpOrder = ["xformOp:translate"]
            {light}
        }}
        {body}
    }}
    def Mesh "Floor"
    {{
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        point3f[] points = [(-900, -900, -90), (900, -900, -90), (900, 900, -90), (-900, 900, -90)]
    }}
}}
"""
PLATE = """def Mesh "Plate"
        {
            uniform token subdivisionScheme = "none"
            int[] faceVertexCounts = [4]
            int[] faceVertexIndices = [0, 1, 2, 3]
            point3f[] points = [(-12, -12, 0), (12, -12, 0), (12, 12, 0), (-12, 12, 0)]
            double3 xformOp:scale = (1, -1, 1)
            uniform token[] xformOpOrder = ["xformOp:scale"]
        }"""
SPECTRUM = 'string gonio:spectrum = "LED-B3"'
QUICK = ("--rays", "1M", "--error", "0", "--g-step", "5", "--c-step", "30")


@pytest.fixture
def measured(run, tmp_path):
    """Measures the lamp into a file."""

    def measure(*options, light=SPECTRUM, body=PLATE, name="lamp.gldf"):
        stage, file = tmp_path / "lamp.usda", tmp_path / name
        stage.write_text(STAGE.format(light=light, body=body))
        return file, run("goniometer", stage, "--luminaire", "/World/Lamp", *QUICK, "-o", file, *options)

    return measure


def contents(file):
    with zipfile.ZipFile(file) as archive:
        return {name: archive.read(name) for name in archive.namelist()}


def test_the_product_has_the_measured_light(run, measured, tmp_path):
    ldt = tmp_path / "lamp.ldt"
    file, done = measured("--watts", "12.5", "--manufacturer", "ACME", "--name", "Plate 1", "--date", "2026-03-31", "-o", ldt)
    assert done.returncode == 0 and f"written: {file}" in done.stdout and "gldf" not in done.stderr, done.stderr
    assert list(contents(file)) == ["product.xml", "ldc/luminaire.ldt", "geo/luminaire.l3d", "spectrum/lamp.txt"]
    found, plain = (json.loads(run("photometry", path, *variant, "--json").stdout) for path, variant in ((file, ("--variant", "1")), (ldt, ())))
    # The product's whole lumens are those that were counted; the table's own differ by its steps.
    assert found["flux_lm"] == pytest.approx(1000, rel=1e-6) and plain["flux_lm"] == pytest.approx(1000, rel=5e-3)
    assert found["peak_cd"] / found["flux_lm"] == pytest.approx(plain["peak_cd"] / plain["flux_lm"], rel=1e-6)
    for name in ("beam_angle_deg", "field_angle_deg"):
        assert found[name] == pytest.approx(plain[name], rel=1e-6), name
    assert found["opening"] == plain["opening"]
    assert (found["watts"], found["warnings"]) == (12.5, [])
    listed = json.loads(run("info", file, "--json").stdout)
    assert listed == json.loads(run("photometry", file, "--json").stdout)
    light = listed["variants"][0]["emitters"][0]["lights"][0]
    assert (listed["manufacturer"], listed["name"], light["rated_flux_lm"]) == ("ACME", {"en": "Plate 1"}, 1000)
    product = ElementTree.fromstring(contents(file)["product.xml"])
    assert product.findtext("Header/GldfCreationTimeCode") == "2026-03-31T00:00:00Z"
    figures = json.loads(run("spectrum", "LED-B3", "--json").stdout)
    assert (light["cct_k"], light["ra"]) == (round(figures["cct"]), round(figures["ra"]))
    again = json.loads(run("spectrum", file, "--json").stdout)
    for name in ("cct", "duv", "ra", "rf", "rg"):
        assert again[name] == pytest.approx(figures[name], rel=1e-6), name


def test_the_model_is_in_the_luminaires_own_axes(measured):
    file, _ = measured()
    with zipfile.ZipFile(io.BytesIO(contents(file)["geo/luminaire.l3d"])) as archive:
        structure = ElementTree.fromstring(archive.read("structure.xml"))
        lines = archive.read("part1-Plate/part1-Plate.obj").decode().splitlines()
    points = np.array([line.split()[1:] for line in lines if line.startswith("v ")], float)
    assert points == pytest.approx(np.array([(-0.12, 0.12, 0), (0.12, 0.12, 0), (0.12, -0.12, 0), (-0.12, -0.12, 0)]), abs=1e-7)
    # The mirror turns the corners' order, so that the plate looks up as before.
    for line in (line for line in lines if line.startswith("f ")):
        a, b, c = points[[int(corner) - 1 for corner in line.split()[1:]]]
        assert np.cross(b - a, c - a)[2] > 0
    place = structure.find(".//LightEmittingObject/Position").attrib
    assert [float(place[axis]) for axis in "xyz"] == pytest.approx([0, 0, -0.01], abs=2e-3)
    assert float(structure.find(".//Circle").attrib["diameter"]) == pytest.approx(0.2, rel=0.03)


def test_the_same_bytes_again(measured):
    files = [contents(measured(name=name)[0]) for name in ("a.gldf", "b.gldf")]
    assert files[0] == files[1]


def test_what_the_file_cannot_hold_is_told_once(measured):
    file, done = measured(light="", body="")
    assert done.returncode == 0 and list(contents(file)) == ["product.xml", "ldc/luminaire.ldt"]
    assert done.stderr.count("no meshes: no model is written") == 1
    assert done.stderr.count("0 W stands there for one that is not known") == 1
    lamps = 'def SphereLight "Other"\n{\n float inputs:radius = 1\n string gonio:spectrum = "LED-B1"\n}\n'
    _, done = measured("--watts", "5", body=f"{PLATE}\n{lamps}")
    assert done.stderr.count("the lamps have 2 spectra: none is written") == 1


@pytest.mark.parametrize(
    ("options", "message"),
    [
        (("--date", "2026-02-29"), "expected a day as 2026-03-31"),
        (("--date", "spring"), "expected a day as 2026-03-31"),
        (("-o", "lamp.l3d"), "expected ldt or ies or xml or gldf"),
    ],
)
def test_options_that_are_wrong(measured, options, message):
    file, done = measured(*options)
    assert done.returncode != 0 and message in done.stderr, done.stderr
    assert not file.exists()


def test_a_stage_is_lit_by_it(run, measured, tmp_path):
    file, _ = measured()
    room = tmp_path / "room.usda"
    room.write_text(f"""#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def SphereLight "Lamp"
{{
    asset gonio:photometry:file = @{file.name}@
}}
""")
    found = json.loads(run("measure", room, "--at", "0,0,-2", "--normal", "0,0,1", "--json").stdout)
    peak = json.loads(run("photometry", file, "--variant", "1", "--json").stdout)["peak_cd"]
    assert found["meters"][0]["value"] == pytest.approx(peak / 4, rel=0.02)


def test_from_python(measured, tmp_path):
    file, _ = measured()
    reading = gonio.goniometer(str(tmp_path / "lamp.usda"), "/World/Lamp", rays=1_000_000, error=0, g_step=5, c_step=30)
    told = reading.write(tmp_path / "python.gldf")
    assert [message for _, message in told if "0 W stands" in message] and len(told) == 1
    assert contents(tmp_path / "python.gldf") == contents(file)
    assert reading.write(tmp_path / "python.ldt") == []
    with pytest.raises(gonio.SettingError, match="expected a day as 2026-03-31"):
        reading.write(tmp_path / "bad.gldf", date="today")
    with pytest.raises(gonio.SettingError, match="expected ldt, ies, xml or gldf"):
        reading.write(tmp_path / "bad.l3d")
    assert not list(tmp_path.glob("bad*"))

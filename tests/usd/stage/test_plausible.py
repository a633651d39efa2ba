"""Inputs that cannot be meant as they stand: what is mended and told, and what is refused."""

import json
import math

import numpy as np
import pictures
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

HEAD = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'
FLOOR = """def Mesh "Floor" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0)]
    uniform token subdivisionScheme = "none"
    %s
}
"""
LAMP = """def SphereLight "Lamp" {
    asset gonio:photometry:file = @lamp.ies@
    %s
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
COSINE = "1000 966 866 707 500 259 0"


def luminaire(path, head="1 4000 1 7 1 1 2 0.1 0.1 0", candela=COSINE):
    lines = ["IESNA:LM-63-2002", "[TEST] t", "[MANUFAC] m", "TILT=NONE", head, "1 1 10", "0 15 30 45 60 75 90", "0", candela]
    path.write_text("\n".join(lines) + "\n")


@pytest.fixture
def stage(tmp_path):
    def write(lamp="", floor="", more=""):
        path = tmp_path / "stage.usda"
        path.write_text(HEAD + FLOOR % floor + LAMP % lamp + more)
        return path

    return write


def at(run, stage, *arguments, point="0,0,0"):
    """The illuminance at a point, and what was told."""
    done = run("measure", stage, "--at", point, "--json", "--spp", 1024, "--integrator", "direct", *arguments)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)["meters"][0]["value"], done.stderr


@pytest.mark.parametrize("head", ["1 4000 1 7 1 1 2 600 600 80", "1 4000 1 7 1 1 1 600 600 80"])
def test_an_opening_of_600_metres_is_one_of_60_centimetres(run, stage, tmp_path, head):
    luminaire(tmp_path / "lamp.ies", "1 4000 1 7 1 1 2 0.6 0.6 0.08")
    right, _ = at(run, stage())
    luminaire(tmp_path / "lamp.ies", head)
    found, told = at(run, stage())
    assert found == pytest.approx(right, rel=0.01) and found > 200
    assert "lamp.ies:5: the opening is" in told and "taken as millimetres" in told


def test_an_opening_that_is_larger_than_the_scene_is_told(run, stage, tmp_path):
    luminaire(tmp_path / "lamp.ies", "1 4000 1 7 1 1 2 12 12 0")
    _, told = at(run, stage())
    assert "/Lamp: the luminaire's opening is 12.00 m long in a scene 8.49 m across" in told
    luminaire(tmp_path / "lamp.ies")
    # A stage in metres that says it is in centimetres.
    path = stage()
    path.write_text(path.read_text().replace("metersPerUnit = 1\n", "metersPerUnit = 0.01\n"))
    _, told = at(run, path)
    assert "0.10 m long in a scene 0.08 m across" in told


def test_decimal_commas_keep_the_light(run, stage, tmp_path):
    luminaire(tmp_path / "lamp.ies", candela="1000,5 966,1 866,0 707,1 500,0 259,0 0,0")
    found, told = at(run, stage())
    assert found == pytest.approx(1000.5 / 4, rel=0.01)
    assert "lamp.ies:9: '1000,5' was found: decimal commas are read as points" in told
    luminaire(tmp_path / "lamp.ies", candela="1000,5 966,1 866,0 707,1 500,0 259")
    refused = run("measure", stage(), "--at", "0,0,0", "--quiet")
    assert refused.returncode == 1 and "lamp.ies:9: '1000,5' was found" in refused.stderr


def test_a_luminaire_whose_file_is_missing_is_an_error(run, stage, tmp_path):
    for text in (None, "", "no luminaire"):
        if text is not None:
            (tmp_path / "lamp.ies").write_text(text)
        commands = (("measure", "--at", "0,0,0"), ("report", "-o", tmp_path / "a.html"), ("render", "-o", tmp_path / "a.png"))
        for command, *arguments in commands:
            refused = run(command, stage(), *arguments, "--quiet")
            assert refused.returncode == 1 and "lamp.ies" in refused.stderr and "--lenient" in refused.stderr
            assert len(refused.stderr.splitlines()) == 1
    assert sorted(path.name for path in tmp_path.iterdir()) == ["lamp.ies", "stage.usda"]


def test_what_stands_in_for_a_missing_file(run, stage):
    # Nobody knows how strong the light is.
    found, told = at(run, stage(), "--lenient")
    assert found == 0 and "the light stays dark" in told
    # 100 lm from a small sphere: 100 / 4π cd, 2 m above.
    small = 'float inputs:radius = 0.01\n    double gonio:photometry:quantity = 100\n    token gonio:photometry:unit = "lm"'
    found, told = at(run, stage(small), "--lenient")
    assert found == pytest.approx(100 / (4 * math.pi) / 4, rel=0.01) and "its quantity leaves its own shape evenly" in told
    assert run("info", stage()).returncode == 0


def test_a_missing_shaping_file_is_an_error(run, tmp_path):
    path = tmp_path / "stage.usda"
    light = 'def SphereLight "L" (prepend apiSchemas = ["ShapingAPI"]) {\n    asset inputs:shaping:ies:file = @lamp.ies@\n}\n'
    path.write_text(HEAD + FLOOR % "" + light)
    assert run("measure", path, "--at", "0,0,0", "--quiet").returncode == 1
    done = run("measure", path, "--at", "0,0,0", "--lenient")
    assert done.returncode == 0 and "shines as without a distribution" in done.stderr


def test_a_point_is_measured_alone(run, stage, tmp_path):
    luminaire(tmp_path / "lamp.ies")
    meter = 'def Xform "Meter" {\n    token gonio:meter:quantity = "illuminance"\n}\n'
    path = stage(floor="double gonio:grid:spacing = 0.5", more=meter)

    def found(*arguments):
        found = json.loads(run("measure", path, "--json", "--quiet", "--spp", 16, *arguments).stdout)
        return [meter["name"] for meter in found["meters"]], [grid["name"] for grid in found["grids"]]

    assert found() == (["/Meter"], ["/Floor"])
    assert found("--at", "0,0,1") == (["0,0,1"], [])
    assert found("--at", "0,0,1", "--at", "1,0,1") == (["0,0,1", "1,0,1"], [])
    assert found("--at", "0,0,1", "--grid", "/Floor", "--spacing", 1) == (["0,0,1"], ["/Floor"])


def test_weather_of_elsewhere_is_told(run, stage, tmp_path):
    luminaire(tmp_path / "lamp.ies")
    weather = tmp_path / "berlin.wea"
    head = "place Berlin\nlatitude 52.47\nlongitude -13.40\ntime_zone -15\nsite_elevation 0\nweather_data_file_units 1\n"
    weather.write_text(head + "6 21 11.5 500 200\n6 21 12.5 500 200\n")
    sun = ("--sun", "48.21,16.37,2025-06-21T13:00+02:00", "--weather", weather)
    _, told = at(run, stage(), *sun)
    assert "the weather is that of Berlin at 52.47, 13.40, 518 km from 48.21, 16.37" in told
    strict = run("measure", stage(), "--at", "0,0,0", "--strict", "--quiet", *sun)
    assert strict.returncode == 1 and "Berlin" in strict.stderr
    _, told = at(run, stage(), "--sun", "52.5,13.4,2025-06-21T13:00+02:00", "--weather", weather)
    assert "Berlin" not in told


DOME = 'def DomeLight "Sky" {\n    asset inputs:texture:file = @sky.hdr@\n    token inputs:texture:format = "latlong"\n}\n'


def picture(path, header="", width=64, height=32, pixel=(128, 128, 128, 129), kind="rgbe"):
    """A Radiance picture of one value: 128 · 2^(129 − 136) is 1."""
    text = f"#?RADIANCE\n{header}FORMAT=32-bit_rle_{kind}\n\n-Y {height} +X {width}\n"
    path.write_bytes(text.encode() + bytes(pixel) * (width * height))


def test_a_dome_shows_what_was_before_the_exposure(run, tmp_path):
    path = tmp_path / "sky.usda"
    path.write_text(HEAD + FLOOR % "" + DOME)
    for header, factor in (("", 1), ("EXPOSURE=2\n", 2), ("EXPOSURE=4\nEXPOSURE=0.5\n", 2), ("COLORCORR=2 2 2\n", 2)):
        picture(tmp_path / "sky.hdr", header)
        found, _ = at(run, path, point="0,0,0.01")
        assert found == pytest.approx(math.pi / factor, rel=0.01), header


REC709 = [(0.64, 0.33), (0.30, 0.60), (0.15, 0.06)], (0.3127, 0.3290)
BRADFORD = np.array([[0.8951, 0.2664, -0.1614], [-0.7502, 1.7135, 0.0367], [0.0389, -0.0685, 1.0296]])


def xyz_of(x, y):
    return np.array([x / y, 1, (1 - x - y) / y])


def to_xyz(primaries, white):
    columns = np.array([xyz_of(*xy) for xy in primaries]).T
    return columns * np.linalg.solve(columns, xyz_of(*white))


def shown(xyz, white):
    """Linear Rec.709 of a colour beside a white, in double precision; red is below zero where green or blue lies outside the gamut."""
    scale = (BRADFORD @ xyz_of(*REC709[1])) / (BRADFORD @ xyz_of(*white))
    return np.linalg.solve(to_xyz(*REC709), np.linalg.solve(BRADFORD, scale * (BRADFORD @ xyz)))


def test_a_dome_shows_the_colours_of_its_space(run, tmp_path):
    (tmp_path / "sky.usda").write_text(HEAD + FLOOR % "" + DOME)
    even, wide = (1 / 3, 1 / 3), ([(0.708, 0.292), (0.17, 0.797), (0.131, 0.046)], (0.3127, 0.3290))
    stated = "PRIMARIES= 0.708 0.292 0.17 0.797 0.131 0.046 0.3127 0.329\n"
    for header, kind, bytes_, expected in (
        ("", "xyze", (64, 128, 32), shown([0.5, 1, 0.25], even)),
        ("", "xyze", (128, 128, 128), [1, 1, 1]),
        ("EXPOSURE=2\n", "xyze", (128, 64, 32), shown([0.5, 0.25, 0.125], even)),
        (stated, "rgbe", (128, 32, 64), shown(to_xyz(*wide) @ [1, 0.25, 0.5], wide[1])),
        (stated, "rgbe", (0, 128, 0), shown(to_xyz(*wide) @ [0, 1, 0], wide[1])),
    ):
        picture(tmp_path / "sky.hdr", header, pixel=(*bytes_, 129), kind=kind)
        assert run("render", tmp_path / "sky.usda", "-o", tmp_path / "sky.exr", "-w", 32, "--spp", 4).returncode == 0
        assert pictures.read(tmp_path / "sky.exr").rgb[0, 0] == pytest.approx(expected, abs=2e-6), (header, bytes_)
    assert shown([0.5, 1, 0.25], even) == pytest.approx([-0.21318, 1.46794, 0.10498], abs=1e-5)


def test_glare_and_false_colour_of_radiance_pictures(run, tmp_path):
    path = tmp_path / "eye.hdr"

    def eye(*arguments):
        done = run("glare", path, "--json", *arguments)
        return json.loads(done.stdout)["eye_illuminance_lx"] if done.returncode == 0 else done.stderr

    # Half a world of 179 cd/m² lights the eye with π times that.
    picture(path, width=200, height=200)
    assert "does not say how it was taken" in eye()
    assert eye("--projection", "equidistant") == pytest.approx(math.pi * 179, rel=0.01)
    picture(path, "EXPOSURE=2\nVIEW= -vta -vh 180 -vv 180\n", width=200, height=200)
    assert eye() == pytest.approx(math.pi * 179 / 2, rel=0.01)
    # Less than a hemisphere does not tell the light at the eye.
    for narrow in ("-vta -vh 120 -vv 120", "-vtv -vh 45 -vv 45"):
        picture(path, f"VIEW= {narrow}\n", width=200, height=200)
        assert eye() is None and eye("--illuminance", 321) == 321
    picture(path, "VIEW= -vts -vh 180 -vv 180\n", width=200, height=200)
    assert "-vts" in eye() and "expected -vtv, -vta or -vth" in eye()
    picture(path, "VIEW= -vtl -vh 4 -vv 4\n", width=200, height=200)
    assert "parallel rays" in eye()
    assert eye("--projection", "equidistant", "--fov", 180) == pytest.approx(math.pi * 179, rel=0.01)
    picture(path, "VIEW= -vth -vh 180 -vv 180\n", width=200, height=200)
    assert eye() == pytest.approx(math.pi * 179, rel=0.02)
    drawn = tmp_path / "false.png"
    assert run("falsecolor", path, "-o", drawn, "--max", 200).returncode == 0 and drawn.read_bytes().startswith(b"\x89PNG")
    assert run("falsecolor", path, "-o", drawn, "--lines").returncode == 0
    missing = run("falsecolor", path, "-o", drawn, "--quantity", "illuminance")
    assert missing.returncode == 1 and "R, G, B, Luminance" in missing.stderr


BLIND = """<WindowElement><Optical><Layer>
<DataDefinition><IncidentDataStructure>Columns</IncidentDataStructure>
<AngleBasis><AngleBasisName>one</AngleBasisName><AngleBasisBlock><nPhis>1</nPhis>
<ThetaBounds><LowerTheta>0</LowerTheta><UpperTheta>90</UpperTheta></ThetaBounds></AngleBasisBlock></AngleBasis></DataDefinition>
%s</Layer></Optical></WindowElement>
"""
BLOCK = """<WavelengthData><Wavelength>%s</Wavelength><WavelengthDataBlock><WavelengthDataDirection>%s</WavelengthDataDirection>
<ColumnAngleBasis>one</ColumnAngleBasis><RowAngleBasis>one</RowAngleBasis><ScatteringData>%s</ScatteringData></WavelengthDataBlock></WavelengthData>
"""


MATERIAL = """def Material "M" {
    token outputs:gonio:surface.connect = </M/S.outputs:surface>
    def Shader "S" {
        uniform token info:id = "gonio:MeasuredBSDF"
        asset inputs:file = @blind.xml@
        token outputs:surface
    }
}
"""


def test_text_before_a_document_is_left_out(run, tmp_path):
    path = tmp_path / "blind.xml"
    text = BLIND % (BLOCK % ("Visible", "Reflection Back", 0.1))
    for before in ("", "genBSDF 2.1: 4 processes\nwarning - no exterior\n", '\ufeffdone.\n<?xml version="1.0" encoding="UTF-8"?>\n'):
        path.write_text(before + text)
        found = json.loads(run("bsdf", path, "--json").stdout)
        assert found["format"] == "BSDF XML" and found["albedo"][0]["reflected"]["luminance"] == pytest.approx(0.1 * math.pi, rel=1e-3)
    path.write_text("one\ntwo\n<?xml version='1.0'?>\n" + text.replace("0.1<", "x<"))
    broken = run("bsdf", path)
    assert broken.returncode == 1 and "blind.xml:9:" in broken.stderr


def test_the_suns_numbers_are_no_light(run, tmp_path):
    path = tmp_path / "blind.xml"
    visible, solar = BLOCK % ("Visible", "Reflection Back", 0.1), BLOCK % ("Solar", "Transmission Front", 0.2)
    path.write_text(BLIND % (visible + solar))
    found = json.loads(run("bsdf", path, "--json").stdout)
    assert all(row["transmitted"]["luminance"] == 0 for row in found["albedo"])
    assert any("transmission-back: there is Solar alone" in problem for problem in found["problems"])
    stage = tmp_path / "stage.usda"
    bound = "rel material:binding = </M>"
    stage.write_text(HEAD + FLOOR % bound + MATERIAL)
    done = run("measure", stage, "--at", "0,0,1", "--spp", 1)
    assert done.returncode == 0 and "there is Solar alone" in done.stderr


def test_a_fitted_material_shows_the_measurement_itself(run, tmp_path):
    from pxr import Usd, UsdShade

    (tmp_path / "paint.gbsdf").write_text(
        "gbsdf 1\ntable reflection-front isotropic\nchannels rgb\naxis theta_i linear 2\n0 90\naxis theta_o linear 2\n0 90\n"
        "axis delta_phi nearest 1\n0\nvalues text\n" + "0.15 0.1 0.05\n" * 4 + "end\n"
    )
    layer = tmp_path / "paint.usda"
    assert run("bsdf", tmp_path / "paint.gbsdf", "--material", layer).returncode == 0
    opened = Usd.Stage.Open(str(layer))
    measured = UsdShade.Material(opened.GetDefaultPrim()).ComputeSurfaceSource("gonio")[0]
    assert measured.GetIdAttr().Get() == "gonio:MeasuredBSDF"
    assert measured.GetInput("file").Get().path == "./paint.gbsdf"
    room = tmp_path / "room.usda"
    room.write_text(HEAD.replace("(\n", "(\n    subLayers = [@paint.usda@]\n", 1) + FLOOR % "rel material:binding = </Fitted>")
    scene = gonio.load_usd(str(room))
    assert not any("grey" in str(line) for line in scene.diagnostics)
    assert scene.to_dict()["materials"][0]["closures"][0]["model"] == "Measured"


def test_python_goes_on_and_tells(tmp_path, stage):
    scene = gonio.load_usd(str(stage()))
    assert any("lamp.ies" in str(line) and "stays dark" in str(line) for line in scene.diagnostics)
    assert np.asarray(gonio.load_usd(str(stage())).to_dict()["lights"]).size == 1

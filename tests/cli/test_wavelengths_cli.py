"""`gonio measure` of the light's colour, `gonio render --by-wavelength`, `gonio sensor`, and what `gonio falsecolor` shows of them."""

import json

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")
OpenEXR = pytest.importorskip("OpenEXR")

STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Floor" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
    rel material:binding = </Wall>
}
def Material "Wall" {
    token outputs:surface.connect = </Wall/Surface.outputs:surface>
    def Shader "Surface" {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = (0.5, 0.5, 0.5)
        color3f inputs:specularColor = (0, 0, 0)
        int inputs:useSpecularWorkflow = 1
        token outputs:surface
    }
}
def SphereLight "Lamp" {
    float inputs:radius = 0.05
    float inputs:intensity = 100000
    custom string gonio:spectrum = "%s"
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def Camera "Camera" {
    float focalLength = 50
    double3 xformOp:translate = (0, 0, 6)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


@pytest.fixture
def stage(tmp_path):
    def write(spectrum="LED-B3"):
        path = tmp_path / "room.usda"
        path.write_text(STAGE % spectrum)
        return path

    return write


def channels(path):
    with OpenEXR.File(str(path), separate_channels=True) as file:
        return {name: np.array(channel.pixels) for name, channel in file.channels().items()}


def test_colour_at_a_point_and_on_a_grid(run, stage, tmp_path):
    path, picture = stage(), tmp_path / "plane.png"
    found = run("measure", path, "--at", "0.5,0,0", "--grid", "/Floor", "--spacing", "2", "--quantity", "cct", "-p", "256", "-o", picture, "--quiet")
    lines = found.stdout.splitlines()
    assert "cct 4102.5" in lines[0] and " K ± " in lines[0] and "Ra 84.8" in lines[0] and "Duv -0.0007" in lines[0]
    assert not any("U0" in line for line in lines) and any("average: 4102.5" in line for line in lines)
    assert picture.stat().st_size > 1000
    as_json = json.loads(run("measure", path, "--at", "0.5,0,0", "--quantity", "ra", "-p", "256", "--json", "--quiet").stdout)["meters"][0]
    colour, lamp = as_json["colour"], json.loads(run("spectrum", "LED-B3", "--json").stdout)
    for name in ("cct", "duv", "ra", "rf", "rg", "melanopic_der", "x", "y"):
        assert colour[name] == pytest.approx(lamp[name], rel=1e-4), name
    assert as_json["value"] == colour["ra"] and as_json["unit"] == ""
    assert len(colour["wavelengths_nm"]) == len(colour["irradiance_w_m2_nm"]) == lamp["points"]
    assert set(colour["standard_errors"]) == {"cct", "duv", "ra", "rf", "rg", "illuminance_lx", "melanopic_edi_lx"}


def test_a_report_has_them(run, stage, tmp_path):
    path, page = stage(), tmp_path / "report.html"
    path.write_text(path.read_text().replace('def Mesh "Floor" {', 'def Mesh "Floor" {\n    custom bool gonio:grid = 1\n    custom string gonio:grid:quantity = "rf"\n'))
    run("report", path, "-o", page, "--quiet", "--point-spp", "128", "-p", "1")
    assert "rf" in page.read_text()


def test_a_picture_by_wavelength(run, stage, tmp_path):
    picture, page = tmp_path / "room.exr", tmp_path / "cct.png"
    found = run("render", stage(), "-w", "32", "-p", "4", "--by-wavelength", picture, "--band", "20", "--half")
    assert str(picture) in found.stdout and "without --half" in found.stderr
    of = channels(picture)
    assert sum(name.startswith("S0.") for name in of) == 20 and {"R", "G", "B", "A"} <= set(of)
    assert [path.name for path in tmp_path.glob("*.exr")] == ["room.exr"]
    run("falsecolor", picture, "--quantity", "cct", "-o", page)
    run("falsecolor", picture, "--quantity", "melanopic", "-o", tmp_path / "melanopic.png")
    assert page.stat().st_size > 500
    # Beside an ordinary picture, which is another file.
    run("render", stage(), "-w", "32", "-p", "4", "--by-wavelength", tmp_path / "again.hsr", "--band", "20", "-o", tmp_path / "colour.exr", "--quiet")
    assert (tmp_path / "again.hsr").stat().st_size > 32 * 20 and "S0.390,000000nm" not in channels(tmp_path / "colour.exr")


def test_groups_by_wavelength_are_relit(run, stage, tmp_path):
    """A room with another lamp is the room that was rendered with it."""
    files = {name: tmp_path / f"{name}.exr" for name in ("led", "tungsten", "relit", "again")}
    path = stage("LED-B3")
    path.write_text(path.read_text().replace("custom string", 'custom string gonio:lightGroup = "Ceiling"\n    custom string'))
    render = ("-w", "32", "-p", "4", "--band", "10", "--light-groups", "--aov", "color,luminance,illuminance", "--quiet")
    run("render", path, *render, "--by-wavelength", files["led"])
    path.write_text(path.read_text().replace('"LED-B3"', '"A"'))
    run("render", path, *render, "--by-wavelength", files["tungsten"])
    found = run("relight", files["led"], "--spectrum", "Ceiling=A", "-o", files["relit"])
    assert str(files["relit"]) in found.stdout and found.stderr == ""
    relit, expected = channels(files["relit"]), channels(files["tungsten"])
    for name in ("R", "G", "B", "Luminance", "S0.605,000000nm", "lightgroup:Ceiling.S0.455,000000nm", "lightgroup:Ceiling.G"):
        np.testing.assert_allclose(relit[name], expected[name], rtol=2e-3, atol=1e-4 * expected[name].max(), err_msg=name)
    assert not any(name.startswith("Illuminance") for name in relit)
    # What was relit can be relit again.
    run("relight", files["relit"], "--spectrum", "Ceiling=LED-B3", "--group", "Ceiling=2", "-o", files["again"])
    np.testing.assert_allclose(channels(files["again"])["G"], 2 * channels(files["led"])["G"], rtol=1e-4)
    assert "--spectrum NAME=2700K" in run("relight", files["led"], "--group", "Ceiling=1,2700", "-o", files["again"]).stderr
    assert "expected one of Ceiling, other" in run("relight", files["led"], "--spectrum", "Kitchen=A", "-o", files["again"]).stderr
    plain = tmp_path / "plain.exr"
    run("render", path, "-w", "8", "-p", "1", "--light-groups", "-o", plain, "--quiet")
    assert "--by-wavelength" in run("relight", plain, "--spectrum", "Ceiling=A", "-o", files["again"]).stderr


def test_colour_rendering_on_surfaces(run, stage, tmp_path):
    picture, page = tmp_path / "room.exr", tmp_path / "ra.png"
    run("render", stage(), "-w", "32", "-p", "4", "--by-wavelength", picture, "--band", "10", "--aov", "illuminance", "--quiet")
    for quantity in ("ra", "rf", "rg", "melanopic-edi"):
        page.unlink(missing_ok=True)
        found = run("falsecolor", picture, "--quantity", quantity, "-o", page)
        assert page.stat().st_size > 500, quantity
        assert found.stdout.split() == [str(page)], quantity
    without = tmp_path / "without.exr"
    run("render", stage(), "-w", "8", "-p", "1", "--by-wavelength", without, "--band", "10", "--quiet")
    assert "--aov illuminance" in run("falsecolor", without, "--quantity", "ra", "-o", page).stderr


def test_a_sensor_of_the_eyes_own_curves(run, stage, tmp_path):
    """A sensor whose curve is V(λ) sees luminance, whatever lamp: white balance cancels, as one channel has one scale."""
    picture, out, curves = tmp_path / "room.exr", tmp_path / "photo.exr", tmp_path / "curves.csv"
    run("render", stage("FL11"), "-w", "32", "-p", "4", "--by-wavelength", picture, "--band", "5", "--quiet")
    nm = np.arange(380.0, 781.0)
    photopic = np.exp(-0.5 * ((nm - 556.3) / 42.5) ** 2)
    curves.write_text("nm,V,flat\n" + "\n".join(f"{a:.0f},{b:.6f},1" for a, b in zip(nm, photopic, strict=True)))
    run("sensor", picture, curves, "-o", out, "--white", "FL11", "--quiet")
    of, original = channels(out), channels(picture)
    assert set(of) == {"V", "flat"}
    luminance = 0.2126 * original["R"] + 0.7152 * original["G"] + 0.0722 * original["B"]
    # A grey wall under the very lamp: all channels are its luminance.
    np.testing.assert_allclose(of["V"], luminance, rtol=0.02, atol=1e-3 * luminance.max())
    np.testing.assert_allclose(of["flat"], luminance, rtol=0.02, atol=1e-3 * luminance.max())
    raw = tmp_path / "raw.exr"
    run("sensor", picture, curves, "-o", raw, "--white", "none", "--quiet")
    bands = np.stack([pixels for name, pixels in sorted(original.items()) if name.startswith("S0.")], -1)
    np.testing.assert_allclose(channels(raw)["flat"], 5.0 * bands.sum(axis=-1), rtol=1e-4)


@pytest.mark.parametrize("observer", ["cie-1931", "cie-2015", "CIE-2015-10"])
def test_observers_of_the_cie(run, stage, tmp_path, observer):
    """A grey wall has its lamp's chromaticity for each observer, and is white where the lamp is."""
    picture, raw, seen = tmp_path / "room.exr", tmp_path / "raw.exr", tmp_path / "seen.exr"
    run("render", stage("FL11"), "-w", "16", "-p", "2", "--by-wavelength", picture, "--band", "5", "--quiet")
    run("sensor", picture, observer, "-o", raw, "--white", "none", "--quiet")
    of = channels(raw)
    assert set(of) == {"X", "Y", "Z"}
    xyz = np.stack([of[name][6, 8] for name in "XYZ"])
    expected = json.loads(run("spectrum", "FL11", "--json").stdout)["chromaticities"][observer.lower()]
    np.testing.assert_allclose(xyz[:2] / xyz.sum(), expected, atol=5e-4)
    run("sensor", picture, observer, "-o", seen, "--white", "FL11", "--quiet")
    of = channels(seen)
    assert set(of) == {"X", "Y", "Z", "R", "G", "B", "A"}
    for name in "RBXZ":
        np.testing.assert_allclose(of[name], of["Y"], rtol=0.02, err_msg=name)


@pytest.mark.parametrize(
    ("text", "what"),
    [
        ("nm,R\n400,1\n410,x\n", "'x' is no number"),
        ("nm,R\n400,1\n390,1\n", "beyond the wavelength before"),
        ("nm,R\n400,1\n410,1\n", "expected 5 at least"),
        ("nm,R\n0.4,1\n0.5,1\n", "no wavelength"),
        ("nm,R\n400,1,2\n410,1\n", "expected 2"),
        ("nm,R,R\n" + "".join(f"{nm},1,1\n" for nm in range(400, 480, 10)), "a name of its own"),
        ("", "expected 5 at least"),
    ],
)
def test_broken_curves_are_told(run, tmp_path, text, what):
    curves = tmp_path / "curves.csv"
    curves.write_text(text)
    found = run("sensor", tmp_path / "room.exr", curves, "-o", tmp_path / "photo.exr")
    assert what in found.stderr and "curves.csv" in found.stderr


def test_pictures_of_colour_are_no_pictures_by_wavelength(run, stage, tmp_path):
    picture, curves = tmp_path / "room.exr", tmp_path / "curves.csv"
    run("render", stage(), "-w", "8", "-p", "1", "-o", picture, "--quiet")
    curves.write_text("".join(f"{nm},1\n" for nm in range(400, 480, 10)))
    found = run("sensor", picture, curves, "-o", tmp_path / "photo.exr")
    assert "--by-wavelength" in found.stderr
    found = run("falsecolor", picture, "--quantity", "melanopic", "-o", tmp_path / "m.png")
    assert "--by-wavelength" in found.stderr
    found = run("render", stage(), "-w", "8", "-p", "1", "--by-wavelength", tmp_path / "room.png")
    assert "expected exr or hsr" in found.stderr
    found = run("render", stage(), "-w", "8", "-p", "1", "--by-wavelength", tmp_path / "r.exr", "--band", "7")
    assert "5, 10 or 20" in found.stderr

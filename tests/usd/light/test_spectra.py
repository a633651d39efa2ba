"""`gonio:spectrum` on lights and `gonio:spectral` on render settings."""

import gonio
import numpy as np
import pytest

STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
    renderSettingsPrimPath = "/Render"
)
def Mesh "Floor" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)]
    color3f[] primvars:displayColor = [(0.5, 0.5, 0.5)]
}
def DomeLight "Sky" {
    float inputs:intensity = 100
    %s
}
def Camera "Camera" {
    double3 xformOp:translate = (0, 0, 4)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def RenderSettings "Render" {
    rel camera = </Camera>
    bool gonio:spectral = %d
}
"""


def load(tmp_path, spectrum: str, spectral: bool = True) -> gonio.Scene:
    path = tmp_path / "stage.usda"
    path.write_text(STAGE % (spectrum, spectral), encoding="utf-8")
    return gonio.load_usd(path)


def test_files_names_and_pairs(tmp_path):
    a = gonio.illuminant("A")
    pairs = ", ".join(f"({nm}, {power})" for nm, power in zip(a["wavelengths_nm"], a["power"], strict=True))
    (tmp_path / "a.csv").write_text("\n".join(f"{nm},{power}" for nm, power in zip(a["wavelengths_nm"], a["power"], strict=True)), encoding="utf-8")
    shown = []
    for spectrum in ('string gonio:spectrum = "A"', "asset gonio:spectrum = @./a.csv@", f"float2[] gonio:spectrum = [{pairs}]"):
        scene = load(tmp_path, spectrum)
        scene.set(width=8, height=8, samples=64)
        with gonio.Render(scene) as rendering:
            rendering.wait()
            shown.append(np.asarray(rendering.film()["color"])[..., :3].mean(axis=(0, 1)))
    assert shown[1] == pytest.approx(shown[0], rel=2e-3) and shown[2] == pytest.approx(shown[0], rel=2e-3)
    red, _, blue = shown[0]
    assert red > 3 * blue


def test_settings_ask_for_wavelengths(tmp_path):
    assert load(tmp_path, "", spectral=True).to_dict()["settings"]["spectral"] is True
    assert load(tmp_path, "", spectral=False).to_dict()["settings"]["spectral"] is False


@pytest.mark.parametrize("wrong", ['string gonio:spectrum = "LED-B77"', "asset gonio:spectrum = @./missing.csv@"])
def test_what_is_no_spectrum_is_told(tmp_path, wrong):
    try:
        told = load(tmp_path, wrong).diagnostics
    except gonio.Error as error:
        told = [str(error)]
    assert any("/Sky" in str(message) and ("LED-B77" in str(message) or "missing.csv" in str(message)) for message in told)


NM = range(380, 781, 5)


@pytest.mark.parametrize(
    ("pairs", "message"),
    [
        ([(nm, 1) for nm in NM if not 500 < nm < 560], "nothing between 500 and 560 nm"),
        ([(nm, 1) for nm in reversed(NM)], "775 nm after 780 nm"),
        ([(nm / 1000, 1) for nm in NM], "look like micrometres"),
        ([(nm, 1) for nm in NM[:3]], "3 points"),
        ([], "0 points"),
        ([(nm, "nan" if nm == 400 else 1) for nm in NM], "power NaN at 400 nm"),
        ([(nm, "inf" if nm == 400 else 1) for nm in NM], "power inf at 400 nm"),
        ([(nm, -1 if nm == 400 else 1) for nm in NM], "power -1 at 400 nm"),
        ([(nm, 0) for nm in NM], "no power above zero"),
        ([(nm + 500, 1) for nm in NM], "no visible light"),
    ],
)
def test_pairs_that_are_no_spectrum_leave_the_light_its_colour(tmp_path, pairs, message):
    scene = load(tmp_path, "float2[] gonio:spectrum = [" + ", ".join(f"({nm}, {power})" for nm, power in pairs) + "]")
    scene.set(width=8, height=8, samples=4)
    with gonio.Render(scene) as rendering:
        rendering.wait()
        told = [*scene.diagnostics, *rendering.diagnostics]
        shown = np.asarray(rendering.film()["color"])[..., :3].mean(axis=(0, 1))
    assert len(told) == 1 and "/Sky" in str(told[0]) and message in str(told[0])
    assert shown == pytest.approx([50.0] * 3, rel=0.01)


@pytest.mark.parametrize(
    ("name", "text", "message"),
    [
        ("lamp.csv", "0.38,1\n0.48,1\n0.58,1\n0.68,1\n0.78,1\n", "lamp.csv:1: "),
        ("lamp.csv", "380,1\n480,1\n", "lamp.csv:1: 2 points"),
        ("lamp.spdx", '<!DOCTYPE l [<!ENTITY a "b">]><IESTM2714>&a;</IESTM2714>', "lamp.spdx:1: not XML"),
    ],
)
def test_assets_that_are_no_spectrum_are_told_with_their_line(tmp_path, name, text, message):
    (tmp_path / name).write_text(text, encoding="utf-8")
    (told,) = load(tmp_path, f"asset gonio:spectrum = @./{name}@").diagnostics
    assert "/Sky" in str(told) and message in str(told) and "keeps its colour" in str(told)


@pytest.mark.parametrize("wrong", ["float[] gonio:spectrum = [380, 1]", "int gonio:spectrum = 5", "color3f gonio:spectrum = (1, 1, 1)"])
def test_other_types_are_told(tmp_path, wrong):
    (told,) = load(tmp_path, wrong).diagnostics
    assert "/Sky.gonio:spectrum" in str(told) and "expected an array of float vectors" in str(told)


PANEL = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Panel" (
    prepend apiSchemas = ["MaterialBindingAPI"%s]
) {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 2), (-1, 1, 2), (1, 1, 2), (1, -1, 2)]
    rel material:binding = </Glow>
    %s
}
def Material "Glow" {
    token outputs:surface.connect = </Glow/Surface.outputs:surface>
    %s
    def Shader "Surface" {
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:emissiveColor = (%g, %g, %g)
        token outputs:surface
    }
}
"""


@pytest.mark.parametrize(
    ("api", "on_mesh", "on_material", "glow"),
    [
        ("", "", 'string gonio:spectrum = "FL11"', 1.0),
        (', "MeshLightAPI"', 'float inputs:intensity = 1\n    string gonio:spectrum = "FL11"', "", 0.0),
        (', "MeshLightAPI"', 'float inputs:intensity = 1\n    string gonio:spectrum = "FL11"', 'string gonio:spectrum = "HP1"', 0.0),
    ],
    ids=["material", "mesh light", "the mesh light's own"],
)
def test_meshes_shine_by_spectra(tmp_path, api, on_mesh, on_material, glow):
    path = tmp_path / "panel.usda"
    path.write_text(PANEL % (api, on_mesh, on_material, glow, glow, glow), encoding="utf-8")
    scene = gonio.load_usd(path)
    scene.add_meter((0, 0, 0), facing=(0, 0, 1), quantity="cct")
    found = gonio.measure(scene, samples=1024).meters[0].colour
    lamp = gonio.illuminant("FL11")
    expected = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    assert found["cct"] == pytest.approx(expected["cct"], abs=1)
    assert found["melanopic_edi_lx"] / found["illuminance_lx"] == pytest.approx(expected["melanopic_der"], abs=0.002)


def test_a_material_of_no_spectrum_is_told(tmp_path):
    path = tmp_path / "panel.usda"
    path.write_text(PANEL % ("", "", 'string gonio:spectrum = "LED-B77"', 1.0, 1.0, 1.0), encoding="utf-8")
    told = gonio.load_usd(path).diagnostics
    assert any("/Glow" in str(message) and "LED-B77" in str(message) for message in told)

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

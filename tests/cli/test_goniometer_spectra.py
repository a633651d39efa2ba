"""Colour over angle on the goniophotometer: a lamp of lines before a coloured plate, beside sums over its wavelengths."""

import csv

import gonio
import numpy as np
import pytest

STAGE = """#usda 1.0
(
    upAxis = "Z"
    metersPerUnit = 1
)
def Xform "Lamp"
{{
    def SphereLight "Bulb"
    {{
        float inputs:radius = 0.02
        float inputs:intensity = 10000
        string gonio:spectrum = "FL11"
        double3 xformOp:translate = (0, 0, 0.05)
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
    def Mesh "Plate" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        point3f[] points = [(-0.3, -0.3, 0.15), (0.3, -0.3, 0.15), (0.3, 0.3, 0.15), (-0.3, 0.3, 0.15)]
        int[] faceVertexCounts = [4]
        int[] faceVertexIndices = [0, 1, 2, 3]
        uniform token subdivisionScheme = "none"
        uniform bool doubleSided = 1
        rel material:binding = </Red>
    }}
}}
def Material "Red"
{{
    token outputs:surface.connect = </Red/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = {colour}
        float inputs:roughness = 1
        int inputs:useSpecularWorkflow = 1
        color3f inputs:specularColor = (0, 0, 0)
        token outputs:surface
    }}
}}
"""
RED = (0.6, 0.1, 0.05)


def below(run, folder, colour, *options):
    """Tristimulus values of the directions within 45° of straight down, together, and all rows."""
    (folder / "lamp.usda").write_text(STAGE.format(colour=colour))
    done = run("goniometer", folder / "lamp.usda", "-l", "/Lamp", "-q", "--rays", 4_000_000, "--error", 0, "--csv", folder / "lamp.csv", *options)
    assert done.returncode == 0, done.stderr
    rows = list(csv.DictReader((folder / "lamp.csv").read_text().splitlines()))
    near = [row for row in rows if float(row["gamma_deg"]) <= 45.0]
    return np.array([[float(row[f"{part}_cd"]) for part in "XYZ"] for row in near]).sum(0), rows


def tristimulus(power, luminance):
    lamp = gonio.illuminant("FL11")
    found = gonio.spectrum_figures(lamp["wavelengths_nm"], power)
    x, y = found["x"], found["y"]
    return luminance * np.array([x / y, 1.0, (1.0 - x - y) / y])


def test_a_plate_colours_light_wavelength_by_wavelength(run, tmp_path):
    """What a black plate leaves is the bulb's own light; what a red one adds has the lamp's lines by its reflectance."""
    lamp = gonio.illuminant("FL11")
    power = np.array(lamp["power"])
    reflectance = np.array([np.ravel(gonio.colour_reflectance(RED, [nm]))[0] for nm in lamp["wavelengths_nm"]])
    own, _ = below(run, tmp_path, (0, 0, 0), "--spectral")
    found, rows = below(run, tmp_path, RED, "--spectral")
    expected = tristimulus(power, own[1]) + tristimulus(power * reflectance, found[1] - own[1])
    assert found[:2] / found.sum() == pytest.approx(expected[:2] / expected.sum(), abs=1e-3)
    plain, _ = below(run, tmp_path, RED)
    assert abs(plain[0] / plain.sum() - expected[0] / expected.sum()) > 0.003
    for row in rows[:5]:
        x, y = float(row["x"]), float(row["y"])
        below_line = -2 * x + 12 * y + 3
        assert (float(row["u_prime"]), float(row["v_prime"])) == pytest.approx((4 * x / below_line, 9 * y / below_line), abs=2e-5)
        assert 2500 < float(row["colour_temperature_k"]) < 3600 and abs(float(row["duv"])) < 0.05

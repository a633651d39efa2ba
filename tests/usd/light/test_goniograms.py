"""Light distributions of UsdLux's ShapingAPI: what is read, how it is scaled and normalised, and the light that arrives."""

import math
import pathlib

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

STAGE = '#usda 1.0\n(\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n'
LIGHT = """def SphereLight "L" (prepend apiSchemas = ["ShapingAPI"])
{{
    float inputs:radius = 0.05
    float inputs:intensity = 1
    asset inputs:shaping:ies:file = @{file}@
    {body}
    double3 xformOp:translate = (0, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""


def write_ies(path: pathlib.Path, vertical: list[float], horizontal: list[float], candela: list[list[float]]) -> None:
    """A file of LM-63-2002, type C, a point."""
    lines = ["IESNA:LM-63-2002", "TILT=NONE", f"1 -1 1 {len(vertical)} {len(horizontal)} 1 2 0 0 0", "1 1 10"]
    rows = [vertical, horizontal, *candela]
    path.write_text("\n".join(lines + [" ".join(str(x) for x in row) for row in rows]) + "\n")


def stage(tmp_path: pathlib.Path, body: str = "", more: str = "") -> pathlib.Path:
    path = tmp_path / "stage.usda"
    path.write_text(STAGE + LIGHT.format(file="lamp.ies", body=body) + more)
    return path


def goniogram(tmp_path: pathlib.Path, body: str = "") -> dict:
    return gonio.load_usd(str(stage(tmp_path, body))).to_dict()["lights"][0]["goniogram"]


def test_angles_and_factors_are_those_of_the_file(tmp_path):
    write_ies(tmp_path / "lamp.ies", [0, 40, 90], [0, 90, 180], [[30, 20, 10], [31, 21, 11], [32, 22, 12]])
    found = goniogram(tmp_path)
    assert found["photometric_type"] == "C"
    assert found["vertical_deg"] == [0, 40, 90]
    assert found["horizontal_deg"] == [0, 90, 180, 270, 360]
    expected = [30, 20, 10, 31, 21, 11, 32, 22, 12, 31, 21, 11, 30, 20, 10]
    assert found["factors"] == pytest.approx(expected, rel=1e-6)


@pytest.mark.parametrize(("scale", "expected"), [(0.5, [0, 20, 45]), (2.0, [0, 80, 180]), (-0.5, [90, 110, 135])])
def test_angle_scale_moves_polar_angles(tmp_path, scale, expected):
    write_ies(tmp_path / "lamp.ies", [0, 40, 90], [0], [[3, 2, 1]])
    assert goniogram(tmp_path, f"float inputs:shaping:ies:angleScale = {scale}")["vertical_deg"] == pytest.approx(expected)


@pytest.mark.parametrize(("last", "solid_angle"), [(90, 2 * math.pi), (180, 4 * math.pi)])
def test_normalized_factors_are_one_in_the_mean(tmp_path, last, solid_angle):
    vertical = np.linspace(0, last, 19)
    candela = 5 + 100 * np.cos(np.radians(vertical)) ** 2
    write_ies(tmp_path / "lamp.ies", list(vertical), [0], [list(candela)])
    found = goniogram(tmp_path, "bool inputs:shaping:ies:normalize = true")
    angles = np.radians(np.linspace(0, last, 20001))
    factors = np.interp(angles, np.radians(found["vertical_deg"]), found["factors"][: len(vertical)])
    mean = np.trapezoid(factors * np.sin(angles), angles) * 2 * math.pi / solid_angle
    assert mean == pytest.approx(1, rel=1e-4)


def test_lux_under_the_light(tmp_path):
    # Straight below and 35 degrees off, towards C0 (the light's +x) and away from it.
    planes = [[8, 8, middle, 0] for middle in (6, 4, 2, 4, 6)]
    write_ies(tmp_path / "lamp.ies", [0, 20, 45, 90], [0, 90, 180, 270, 360], planes)
    floor = """def Mesh "Floor"
{
    point3f[] points = [(-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
}
def Camera "Camera"
{
    token projection = "orthographic"
    float horizontalAperture = 60
    float verticalAperture = 60
    double3 xformOp:translate = (0, 0, 1.5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
    scene = gonio.load_usd(str(stage(tmp_path, more=floor)))
    scene.set(width=61, height=61, samples=256, integrator="direct", passes=["illuminance"])
    with gonio.Render(scene) as rendering:
        rendering.wait()
        lux = np.asarray(rendering.film()["illuminance"])[:, :, 0]
    metres = 6 / 61
    luminous_area = math.pi * 0.05**2
    for x, factor in [(0, 8), (1.4, 6), (-1.4, 2)]:
        column = round(30 + x / metres)
        away = (column - 30) * metres
        angle = math.degrees(math.atan2(abs(away), 2))
        intensity = np.interp(angle, [0, 20, 45, 90], [8, 8, factor, 0]) * luminous_area
        expected = intensity * math.cos(math.radians(angle)) ** 3 / 4
        # A 5 cm sphere 2 m away is a point within 0.1 %; 256 samples leave less than 1 % of noise.
        assert lux[29:32, column].mean() == pytest.approx(expected, rel=0.02), x


@pytest.mark.parametrize("text", ["", "TILT=NONE\n1 -1 1 3", "\x00\x01binary"])
def test_files_that_cannot_be_read_leave_the_light_uniform(tmp_path, text):
    (tmp_path / "lamp.ies").write_text(text)
    assert goniogram(tmp_path) is None


def test_a_missing_file_is_told(tmp_path):
    scene = gonio.load_usd(str(stage(tmp_path)))
    assert any("lamp.ies" in str(line) and "does not exist" in str(line) for line in scene.diagnostics)


def test_each_missing_file_is_told(tmp_path):
    other = LIGHT.replace('"L"', '"M"').format(file="other.ies", body="")
    scene = gonio.load_usd(str(stage(tmp_path, more=other)))
    told = " ".join(str(line) for line in scene.diagnostics)
    assert "'lamp.ies'" in told and "'other.ies'" in told

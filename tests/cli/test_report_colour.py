"""The colour section of `gonio report`: figures of lamps in an empty room, melanopic light of eyes, and what is missing."""

import re

import pytest
from test_report import Reader

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Floor" {
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
}
def Mesh "Table" {
    uniform token purpose = "guide"
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, -1, 0.75), (1, -1, 0.75), (1, 1, 0.75), (-1, 1, 0.75)]
    token gonio:grid:quantity = "ra"
    double gonio:grid:spacing = 1
}
def Xform "Desk" {
    token gonio:meter:quantity = "illuminance"
    double3 xformOp:translate = (0, 0, 0.75)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def SphereLight "Lamp" {
    float inputs:radius = 0.05
    float inputs:intensity = 20000
    SPECTRUM
    double3 xformOp:translate = (0.2, 0, 3)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def page(run, tmp_path, *arguments, spectrum='string gonio:spectrum = "LED-B3"', stage=STAGE):
    path, output = tmp_path / "room.usda", tmp_path / "room.html"
    path.write_text(stage.replace("SPECTRUM", spectrum))
    ended = run("report", path, "-o", output, "--no-pictures", "--point-spp", 256, "--max-bounces", 0, *arguments, timeout=120)
    assert ended.returncode == 0, ended.stderr
    text = output.read_text(encoding="utf-8")
    return text, Reader(text)


def test_figures_are_those_of_the_lamp(run, tmp_path):
    text, reader = page(run, tmp_path, "--grid", "/Floor", "--spacing", 2)
    lamp = gonio.illuminant("LED-B3")
    expected = gonio.spectrum_figures(lamp["wavelengths_nm"], lamp["power"])
    names, *rows = reader.table("place")
    assert names == ["place", "CCT, K", "Duv", "Ra", "R9", "Rf", "Rg", "mel. DER", "mel. EDI, lx"]
    assert [row[0].split(" at ")[0] for row in rows] == ["middle of /Table", "/Desk", "middle of /Floor"]
    wanted = [expected["cct"], expected["duv"], expected["ra"], expected["r"][8], expected["rf"], expected["rg"], expected["melanopic_der"]]
    for row in rows:
        values = [float(cell.split()[0]) for cell in row[1:]]
        for value, figure, off in zip(values, wanted, (1, 1e-4, 0.1, 0.2, 0.1, 0.1, 1e-3), strict=False):
            assert value == pytest.approx(figure, abs=off)
    # I = π r² L, straight above the desk but for 0.2 m.
    lux = 20000 * 3.14159265 * 0.05**2 * 2.25 / (2.25**2 + 0.04) ** 1.5
    assert float(rows[1][-1].split()[0]) == pytest.approx(expected["melanopic_der"] * lux, rel=0.01)
    assert text.count("TM-30 colour vectors") == 3 and "/Table: melanopic EDI lx" in text
    # It reads well on phones and on dark screens.
    assert 'name="viewport"' in text and "prefers-color-scheme: dark" in text


def test_eyes_over_the_surfaces_of_the_command_line(run, tmp_path):
    _, reader = page(run, tmp_path, "--grid", "/Floor", "--spacing", 2, "--height", 0.75, "--eyes", "standing", "--directions", 2)
    rows = reader.table("grid")
    grids = {row[0]: row[1] for row in rows[1:]}
    assert grids == {"/Floor": "illuminance", "/Table": "colour rendering Ra", "/Floor, eyes at 1.6 m": "melanopic EDI"}
    eyes = next(table for table in reader.tables if "least eye" in table[0])
    assert [row[2] for row in eyes[1:]] == ["2 directions", "0.00, 1.00, 0.00", "0.00, -1.00, 0.00"]


def test_lamps_without_a_spectrum(run, tmp_path):
    quantity = 'token gonio:grid:quantity = "ra"'
    text, _ = page(run, tmp_path, spectrum="", stage=STAGE.replace(quantity, ""))
    assert "Colour of the light" not in text
    second = STAGE.replace(quantity, "") + 'def SphereLight "Bare" {\n    float inputs:intensity = 100\n}\n'
    text, reader = page(run, tmp_path, stage=second)
    assert re.search(r"no figures of colour beside them: /Bare.*spectrum", text)
    assert not any(table[0][0] == "place" for table in reader.tables)


def test_a_lamp_of_a_colour_alone_has_no_rendering(run, tmp_path):
    plain = STAGE.replace('gonio:grid:quantity = "ra"', 'gonio:grid:quantity = "cct"')
    text, reader = page(run, tmp_path, spectrum="color3f inputs:color = (1, 0.8, 0.6)", stage=plain)
    _, row = reader.table("place")
    assert row[0].startswith("middle of /Table") and float(row[1].split()[0]) > 2000
    assert row[3:] == ["–"] * 6
    assert "TM-30 colour vectors" not in text

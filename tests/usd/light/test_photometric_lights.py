"""Lights of `gonio:photometry` attributes: quantities, luminaires' files, dimming, and the light that arrives."""

import math
import pathlib

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

STAGE = """#usda 1.0
(
    metersPerUnit = {metres}
    upAxis = "Z"
)
def Mesh "Floor"
{{
    point3f[] points = [(-5, -5, 0), (5, -5, 0), (5, 5, 0), (-5, 5, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    double3 xformOp:scale = ({scale}, {scale}, {scale})
    uniform token[] xformOpOrder = ["xformOp:scale"]
}}
def Camera "Camera"
{{
    token projection = "orthographic"
    float horizontalAperture = 0.1
    float verticalAperture = 0.1
    float2 clippingRange = (0.01, 100000)
    double3 xformOp:translate = (0, 0, {eye})
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
def {kind} "L"
{{
    {body}
    double3 xformOp:translate = (0, 0, {height})
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""


def write_ies(path: pathlib.Path, size: str = "0 0 0", intensity: float = 100.0, lumens: float = -1) -> None:
    """An even luminaire of LM-63-2002, type C, over the whole sphere."""
    rows = " ".join([str(intensity)] * 3)
    path.write_text(f"IESNA:LM-63-2002\nTILT=NONE\n1 {lumens} 1 3 1 1 2 {size}\n1 1 10\n0 90 180\n0\n{rows}\n")


def load(tmp_path: pathlib.Path, kind: str, body: str, metres: float = 1.0, distance: float = 1.0):
    path = tmp_path / "stage.usda"
    unit = 1.0 / metres
    text = STAGE.format(kind=kind, body=body, metres=metres, scale=unit, height=distance * unit, eye=0.5 * distance * unit)
    path.write_text(text)
    return gonio.load_usd(str(path))


def lux(scene, samples: int = 64) -> float:
    """Illuminance of the floor straight under the light."""
    scene.set(width=16, height=16, samples=samples, integrator="direct", passes=["illuminance"])
    with gonio.Render(scene) as rendering:
        rendering.wait()
        return float(np.asarray(rendering.film()["illuminance"]).mean())


POINT = "float inputs:radius = 0.001"
SMALL = "float inputs:width = 0.01\n    float inputs:height = 0.01"
LUMENS = 'double gonio:photometry:quantity = 100\n    token gonio:photometry:unit = "lm"'


@pytest.mark.parametrize(("kind", "size", "expected"), [("SphereLight", POINT, 7.958), ("RectLight", SMALL, 31.83)])
@pytest.mark.parametrize("metres", [1.0, 0.01])
def test_a_hundred_lumens_at_one_metre(tmp_path, kind, size, expected, metres):
    scene = load(tmp_path, kind, f"{size}\n    {LUMENS}", metres)
    assert lux(scene) == pytest.approx(expected, rel=2e-3)
    assert not scene.diagnostics


@pytest.mark.parametrize(
    ("unit", "quantity", "expected"),
    [("cd", 50.0, 50.0), ("W", 1.0, 177.83 / math.pi), ("lx", 20.0, 80.0), ("nit", 1e6, 100.0)],
)
def test_units(tmp_path, unit, quantity, expected):
    body = f'{SMALL}\n    double gonio:photometry:quantity = {quantity}\n    token gonio:photometry:unit = "{unit}"'
    assert lux(load(tmp_path, "RectLight", body + "\n    double gonio:photometry:distance = 2")) == pytest.approx(expected, rel=2e-3)


def test_colour_and_temperature_leave_the_quantity_alone(tmp_path):
    colour = "color3f inputs:color = (1, 0.2, 0.1)\n    bool inputs:enableColorTemperature = true\n    float inputs:colorTemperature = 2700"
    scene = load(tmp_path, "SphereLight", f"{POINT}\n    {LUMENS}\n    {colour}\n    float inputs:intensity = 55")
    assert lux(scene) == pytest.approx(7.958, rel=2e-3)


def test_dimming_and_maintenance(tmp_path):
    body = f"{POINT}\n    {LUMENS}\n    float gonio:photometry:dimming = 0.5\n    float gonio:photometry:maintenanceFactor = 0.8"
    assert lux(load(tmp_path, "SphereLight", body)) == pytest.approx(0.4 * 7.958, rel=2e-3)


@pytest.mark.parametrize("opening", ["file", "point", "light"])
@pytest.mark.parametrize("metres", [1.0, 0.01])
def test_a_luminaires_candela(tmp_path, opening, metres):
    write_ies(tmp_path / "lamp.ies", "-0.1 -0.1 0.2")
    size = f"float inputs:radius = {0.05 / metres}"
    body = f'{size}\n    asset gonio:photometry:file = @lamp.ies@\n    token gonio:photometry:opening = "{opening}"'
    scene = load(tmp_path, "SphereLight", body, metres, distance=4.0)
    light = scene.to_dict()["lights"][0]
    forms = {"file": "VerticalCylinder", "light": "Ellipsoid"}
    assert light["shape"] == "Point" if opening == "point" else light["shape"]["Opening"]["shape"] == forms[opening]
    # A body of 0.2 m at 4 m: its lower face is nearer by a fortieth.
    assert lux(scene, 256) == pytest.approx(100.0 / 16.0, rel=2e-3 if opening == "point" else 0.06)


def test_the_lamps_flux_is_exchanged(tmp_path):
    write_ies(tmp_path / "lamp.ies", lumens=2000)
    body = f"{POINT}\n    asset gonio:photometry:file = @lamp.ies@\n    double gonio:photometry:quantity = 500"
    scene = load(tmp_path, "SphereLight", body + '\n    token gonio:photometry:unit = "lampLm"')
    assert lux(scene) == pytest.approx(25.0, rel=2e-3)


def write_ldt(path: pathlib.Path) -> None:
    """An even luminaire of 1000/4π cd/klm with two alternative lamp sets, 1000 and 3000 lm."""
    head = "ACME;1;1;1;0;3;90;report;Globe;G-1;globe.ldt;today;0;0;50;0;0;0;0;0;0;50;100;1;0;2"
    values = [*head.split(";"), *"1;LED;1000;3000 K;90;10;2;LED;3000;4000 K;80;24".split(";"), *["0.5"] * 10, 0, 0, 90, 180]
    path.write_bytes("\r\n".join(str(value) for value in [*values, *[1000 / (4 * math.pi)] * 3]).encode("latin-1"))


@pytest.mark.parametrize(("body", "expected"), [("", 1000), ("int gonio:photometry:lampSet = 2", 3000), ("int gonio:photometry:lampSet = 1", 1000)])
def test_lamp_sets_are_chosen(tmp_path, body, expected):
    write_ldt(tmp_path / "globe.ldt")
    scene = load(tmp_path, "SphereLight", f"asset gonio:photometry:file = @globe.ldt@\n    {body}")
    assert lux(scene) == pytest.approx(expected / (4 * math.pi), rel=2e-3)


@pytest.mark.parametrize("number", [0, 3, -1])
def test_lamp_sets_that_are_not_there_are_told(tmp_path, number):
    write_ldt(tmp_path / "globe.ldt")
    scene = load(tmp_path, "SphereLight", f"asset gonio:photometry:file = @globe.ldt@\n    int gonio:photometry:lampSet = {number}")
    assert "the file has 2" in str(scene.diagnostics)
    assert lux(scene) == pytest.approx(1000 / (4 * math.pi), rel=2e-3)


def test_a_tilt_takes_the_files_factors(tmp_path):
    write_ies(tmp_path / "lamp.ies")
    text = (tmp_path / "lamp.ies").read_text()
    (tmp_path / "tilting.ies").write_text(text.replace("TILT=NONE", "TILT=INCLUDE\n1\n3\n0 45 90\n1 0.9 0.5"))
    hung = lambda file, tilt: load(  # noqa: E731
        tmp_path, "SphereLight", f"asset gonio:photometry:file = @{file}@\n    double gonio:photometry:tilt = {tilt}"
    )
    assert lux(hung("tilting.ies", 0)) == pytest.approx(100.0, rel=2e-3)
    assert lux(hung("tilting.ies", -67.5)) == pytest.approx(70.0, rel=2e-3)
    (tmp_path / "naming.ies").write_text(text.replace("TILT=NONE", "TILT=lamp.tlt"))
    (tmp_path / "lamp.tlt").write_text("1\n3\n0 45 90\n1 0.9 0.5\n")
    assert lux(hung("naming.ies", -67.5)) == pytest.approx(70.0, rel=2e-3)
    upright = hung("lamp.ies", 20)
    assert "no tilt factors" in str(upright.diagnostics)
    assert lux(upright) == pytest.approx(100.0, rel=2e-3)


def test_rotation_turns_c0(tmp_path):
    write_ies(tmp_path / "lamp.ies", "0.1 1.2 0")
    body = "asset gonio:photometry:file = @lamp.ies@\n    double gonio:photometry:rotation = 90"
    columns = load(tmp_path, "SphereLight", body).to_dict()["lights"][0]["transform"]["columns"]
    assert columns[0] == pytest.approx([0, 1, 0], abs=1e-12)
    assert columns[1] == pytest.approx([-1, 0, 0], abs=1e-12)


@pytest.mark.parametrize(
    ("kind", "body", "expected"),
    [
        ("DistantLight", 'double gonio:photometry:quantity = 5000\n    token gonio:photometry:unit = "lx"', 5000.0),
        ("DomeLight", 'double gonio:photometry:quantity = 5000\n    token gonio:photometry:unit = "lx"', 5000.0),
        ("DomeLight", 'double gonio:photometry:quantity = 1000\n    token gonio:photometry:unit = "nit"', 1000.0 * math.pi),
    ],
)
def test_lights_at_infinity(tmp_path, kind, body, expected):
    assert lux(load(tmp_path, kind, body), 256) == pytest.approx(expected, rel=5e-3)


def test_what_makes_no_sense_is_told(tmp_path):
    told = lambda kind, body: " ".join(str(line) for line in load(tmp_path, kind, body).diagnostics)  # noqa: E731
    assert "unit is 'furlong'" in told("SphereLight", 'double gonio:photometry:quantity = 5\n    token gonio:photometry:unit = "furlong"')
    assert "dimming is -1" in told("SphereLight", f"{LUMENS}\n    float gonio:photometry:dimming = -1")
    write_ies(tmp_path / "lamp.ies")
    gap = 'asset gonio:photometry:file = @lamp.ies@\n    token gonio:photometry:opening = "gap"'
    assert "opening is 'gap'" in told("SphereLight", gap)


def mesh_light(tmp_path, attributes):
    text = f"""#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Panel" (prepend apiSchemas = ["MeshLightAPI"])
{{
    point3f[] points = [(-0.01, -0.01, 0), (-0.01, 0.01, 0), (0.01, 0.01, 0), (0.01, -0.01, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    {attributes}
}}
"""
    path = tmp_path / "mesh.usda"
    path.write_text(text)
    return gonio.load_usd(str(path))


def test_mesh_lights(tmp_path):
    scene = mesh_light(tmp_path, LUMENS).to_dict()
    glow = [m for m in scene["materials"] if "emission_color" in str(m)]
    values = dict(glow[-1]["closures"][0]["parameters"])["emission_color"]["Constant"]
    assert values[:3] == pytest.approx([100.0 / (math.pi * 0.0004)] * 3, rel=1e-4)


def test_mesh_lights_without_a_quantity_are_dimmed(tmp_path):
    factors = "float gonio:photometry:dimming = 0.5\n    float gonio:photometry:maintenanceFactor = 0.8"
    scene = mesh_light(tmp_path, f"float inputs:intensity = 100\n    {factors}").to_dict()
    glow = [m for m in scene["materials"] if "emission_color" in str(m)]
    values = dict(glow[-1]["closures"][0]["parameters"])["emission_color"]["Constant"]
    assert values[:3] == pytest.approx([40.0] * 3, rel=1e-6)


def test_files_of_what_has_no_use_for_them_are_told(tmp_path):
    write_ies(tmp_path / "lamp.ies")
    file = "asset gonio:photometry:file = @lamp.ies@"
    assert "gonio:photometry:file of mesh lights" in str(mesh_light(tmp_path, file).diagnostics)
    assert "gonio:photometry:file of lights at infinity" in str(load(tmp_path, "DomeLight", file).diagnostics)


def test_what_makes_no_sense_of_mesh_lights_is_told(tmp_path):
    told = lambda attributes: " ".join(str(line) for line in mesh_light(tmp_path, attributes).diagnostics)  # noqa: E731
    assert "dimming is -1" in told(f"{LUMENS}\n    float gonio:photometry:dimming = -1")
    assert "maintenanceFactor is NaN" in told(f"{LUMENS}\n    float gonio:photometry:maintenanceFactor = nan")
    assert "keeps its intensity" in told("double gonio:photometry:quantity = -100")

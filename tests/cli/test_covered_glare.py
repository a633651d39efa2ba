"""UGR of luminaires that the eye sees through glass or covers of the scene alone: no figure, and no zero, which would be a good mark."""

import json
import math

import pytest

gonio = pytest.importorskip("gonio")

HEAD = """#usda 1.0
(
    upAxis = "Z"
    metersPerUnit = 1
)
def Mesh "Floor"
{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-5, -5, 0), (5, -5, 0), (5, 5, 0), (-5, 5, 0)]
}
def DomeLight "Sky"
{
    float inputs:intensity = 20
}
def SphereLight "Lamp"
{
    float inputs:radius = 0.05
    float inputs:intensity = 100000
    double3 xformOp:translate = (0, 0, 2.5)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
COVER = """def Mesh "Cover" (prepend apiSchemas = ["MaterialBindingAPI"])
{
    uniform token subdivisionScheme = "none"
    int[] faceVertexCounts = [4, 4, 4, 4, 4, 4]
    int[] faceVertexIndices = [0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4, 1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7]
    point3f[] points = [(-.2, -.2, 2.3), (.2, -.2, 2.3), (.2, .2, 2.3), (-.2, .2, 2.3), (-.2, -.2, 2.7), (.2, -.2, 2.7), (.2, .2, 2.7), (-.2, .2, 2.7)]
    rel material:binding = </Cover/Stuff>
    def Material "Stuff"
    {
        token outputs:mtlx:surface.connect = </Cover/Stuff/S.outputs:out>
        def Shader "S"
        {
            uniform token info:id = "ND_open_pbr_surface_surfaceshader"
            float inputs:specular_roughness = 0
            INPUTS
            token outputs:out
        }
    }
}
"""
GLASS = "float inputs:transmission_weight = 1"
PANE = GLASS + "\n            bool inputs:geometry_thin_walled = 1"
OPAL = "float inputs:subsurface_weight = 1\n            bool inputs:geometry_thin_walled = 1"
OPAQUE = "float inputs:base_weight = 0.5"


def rated(run, tmp_path, inputs=""):
    (tmp_path / "stage.usda").write_text(HEAD + (COVER.replace("INPUTS", inputs) if inputs else ""))
    where = ("--at", "0,-3,1.6", "--facing", "0,1,0", "--quantity", "ugr", "--spp", 64)
    return run("measure", tmp_path / "stage.usda", *where, "--json")


@pytest.mark.parametrize("inputs", [GLASS, OPAL], ids=["glass", "opal"])
def test_covers_are_told_and_not_rated(run, tmp_path, inputs):
    done = rated(run, tmp_path, inputs)
    (meter,) = json.loads(done.stdout)["meters"]
    assert meter["value"] is None and meter["ugr_coverage"]["behind_covers"] == 1 and meter["ugr_coverage"]["sources"] == 0
    assert "seen through glass or covers of the scene alone" in done.stderr


@pytest.mark.parametrize("inputs", ["", PANE, OPAQUE], ids=["bare", "thin pane", "opaque"])
def test_what_is_seen_is_rated_and_what_is_hidden_is_not(run, tmp_path, inputs):
    done = rated(run, tmp_path, inputs)
    (meter,) = json.loads(done.stdout)["meters"]
    assert meter["ugr_coverage"]["behind_covers"] == 0 and "covers" not in done.stderr
    assert meter["value"] == 0.0 if inputs == OPAQUE else meter["value"] > 30


def test_grids_and_python_tell_it_too(run, tmp_path):
    (tmp_path / "stage.usda").write_text(HEAD + COVER.replace("INPUTS", GLASS))
    scene = gonio.load_usd(str(tmp_path / "stage.usda"))
    scene.add_meter((0, -3, 1.6), facing=(0, 1, 0), quantity="ugr")
    (meter,) = gonio.measure(scene, samples=16).meters
    assert math.isnan(meter.value) and meter.coverage.covered == 1 and "not rated" in meter.coverage.note


SUBSET = """    def GeomSubset "NAME" (prepend apiSchemas = ["MaterialBindingAPI"])
    {
        uniform token elementType = "face"
        uniform token familyName = "materialBind"
        int[] indices = [FACES]
        rel material:binding = </Cover/MATERIAL>
    }
"""


def test_the_wall_of_a_window_hides_what_is_behind_it(run, tmp_path):
    """One mesh of opaque faces before the eye and of thin panes behind them."""
    cover = COVER.replace("INPUTS", PANE)
    wall = cover[cover.index("    def Material") : cover.rindex("}\n")].replace('"Stuff"', '"Wall"').replace("Cover/Stuff", "Cover/Wall").replace(PANE, OPAQUE)
    parts = "".join(
        SUBSET.replace("NAME", name).replace("FACES", faces).replace("MATERIAL", material)
        for name, faces, material in (("Front", "0, 2", "Wall"), ("Back", "1, 3, 4, 5", "Stuff"))
    )
    (tmp_path / "stage.usda").write_text(HEAD + cover[: cover.rindex("}\n")] + wall + parts + "}\n")
    where = ("--at", "0,-3,1.6", "--facing", "0,1,0", "--quantity", "ugr", "--spp", 64)
    (meter,) = json.loads(run("measure", tmp_path / "stage.usda", *where, "--json").stdout)["meters"]
    assert meter["value"] == 0 and meter["ugr_coverage"]["behind_covers"] == 0

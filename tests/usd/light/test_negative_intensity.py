"""Lights of negative intensity take light away, as those of a positive one bring it."""

import numpy as np
import pytest

gonio = pytest.importorskip("gonio")
pytest.importorskip("pxr")

STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Floor"
{{
    point3f[] points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
}}
def Mesh "Panel" (prepend apiSchemas = ["MeshLightAPI"])
{{
    point3f[] points = [(-0.2, -0.2, 1), (-0.2, 0.2, 1), (0.2, 0.2, 1), (0.2, -0.2, 1)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    float inputs:intensity = {0}
}}
def SphereLight "Lamp"
{{
    float inputs:intensity = {0}
    float inputs:radius = 0.2
    double3 xformOp:translate = (1, 0, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
def RectLight "Window"
{{
    float inputs:intensity = {0}
    double3 xformOp:translate = (-1, 0, 2)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
def DistantLight "Sun"
{{
    float inputs:intensity = {0}
}}
def DomeLight "Sky"
{{
    float inputs:intensity = {0}
}}
def Camera "Camera"
{{
    double3 xformOp:translate = (0, 0, 8)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
"""


def picture(tmp_path, intensity):
    path = tmp_path / f"{intensity}.usda"
    path.write_text(STAGE.format(intensity))
    scene = gonio.load_usd(path)
    scene.set(width=16, height=16, samples=8, passes=["color"])
    with gonio.Render(scene) as render:
        assert render.wait()
        assert not render.diagnostics
        return np.asarray(render.film()["color"])[..., :3]


def test_the_picture_is_the_opposite(tmp_path):
    bright, dark = (picture(tmp_path, intensity) for intensity in (3, -3))
    assert bright.max() > 1.0 and np.array_equal(dark, -bright)

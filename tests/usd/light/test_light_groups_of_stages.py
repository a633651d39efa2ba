"""Light groups of stages, from rendering to relighting, on the command line."""

import numpy as np
import pytest

openexr = pytest.importorskip("OpenEXR")
pytest.importorskip("pxr")

STAGE = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Z"
)
def Mesh "Floor"
{
    point3f[] points = [(-2, -2, 0), (2, -2, 0), (2, 2, 0), (-2, 2, 0)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
}
def Mesh "Panel" (prepend apiSchemas = ["MeshLightAPI"])
{
    point3f[] points = [(-0.2, -0.2, 1), (-0.2, 0.2, 1), (0.2, 0.2, 1), (0.2, -0.2, 1)]
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    float inputs:intensity = 20
    token gonio:lightGroup = "Panels"
}
def SphereLight "Lamp"
{
    double gonio:photometry:quantity = 100
    token gonio:lightGroup = "Lamps"
    double3 xformOp:translate = (1, 0, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
def DomeLight "Sky"
{
}
def Camera "Camera"
{
    double3 xformOp:translate = (0, 0, 8)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""


def read(path):
    return {name: channel.pixels.astype(float) for name, channel in openexr.File(str(path), separate_channels=True).channels().items()}


def test_render_and_relight(tmp_path, run):
    (tmp_path / "stage.usda").write_text(STAGE)
    arguments = ["render", tmp_path / "stage.usda", "-o", tmp_path / "in.exr", "--light-groups", "--spp", "16", "-w", "64"]
    done = run(*arguments, timeout=120)
    assert done.returncode == 0, done.stderr
    found = read(tmp_path / "in.exr")
    groups = ("Panels", "Lamps", "other")
    for colour in "RGB":
        parts = [found[f"lightgroup:{name}.{colour}"] for name in groups]
        assert all(part.max() > 0 for part in parts)
        assert np.abs(sum(parts) - found[colour]).max() <= 1e-5 * found[colour].max()
    done = run("relight", tmp_path / "in.exr", "--group", "Panels=0", "--group", "Lamps=2.5", "-o", tmp_path / "out.exr")
    assert done.returncode == 0, done.stderr
    relit = read(tmp_path / "out.exr")
    for colour in "RGB":
        expected = 2.5 * found[f"lightgroup:Lamps.{colour}"] + found[f"lightgroup:other.{colour}"]
        assert np.allclose(relit[colour], expected, rtol=2e-3, atol=1e-4)


def test_what_has_no_groups_is_told(tmp_path, run):
    (tmp_path / "stage.usda").write_text(STAGE)
    assert run("render", tmp_path / "stage.usda", "-o", tmp_path / "in.exr", "--spp", "1", "-w", "16", timeout=120).returncode == 0
    done = run("relight", tmp_path / "in.exr", "-o", tmp_path / "out.exr")
    assert done.returncode == 1 and "no light groups" in done.stderr
    done = run("relight", tmp_path / "in.exr", "--group", "Lamps", "-o", tmp_path / "out.exr")
    assert done.returncode == 1 and "NAME=FACTOR" in done.stderr

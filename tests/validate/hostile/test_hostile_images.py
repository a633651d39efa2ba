"""Hostile images as textures, as domes and read tile by tile: a picture or one line within 6 GB of addresses, never a crash or a wait."""

import pytest
from bounds import judged, limited
from images import IMAGES

pytestmark = [pytest.mark.validate, pytest.mark.timeout(5500)]

# Of the clock; `bounds` limits the time of the processor.
SECONDS = 1800
# A dome's file may be told by its first bytes, so one that takes seconds to make is tried once.
BOMBS = ("bomb_16k.png", "iccp_bomb.png", "ztxt_bomb.png")
HEAD = """#usda 1.0
(
    metersPerUnit = 1
    upAxis = "Y"
)
def Camera "Cam"
{
    double3 xformOp:translate = (0, 1, 6)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}
"""
DOME = """
def DomeLight "Dome"
{{
    asset inputs:texture:file = @{file}@
}}
"""
WALL = """
def SphereLight "Lamp"
{{
    float inputs:intensity = 400
    double3 xformOp:translate = (1, 3, 1)
    uniform token[] xformOpOrder = ["xformOp:translate"]
}}
def Mesh "Wall" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    point3f[] points = [(-1, 0, 0), (1, 0, 0), (1, 2, 0), (-1, 2, 0)]
    texCoord2f[] primvars:st = [(0, 0), (1, 0), (1, 1), (0, 1)] (interpolation = "vertex")
    uniform token subdivisionScheme = "none"
    rel material:binding = </M>
}}
def Material "M"
{{
    token outputs:surface.connect = </M/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor.connect = </M/T.outputs:rgb>
        token outputs:surface
    }}
    def Shader "T"
    {{
        uniform token info:id = "UsdUVTexture"
        asset inputs:file = @{file}@
        float3 outputs:rgb
    }}
}}
"""


@pytest.mark.parametrize("name", IMAGES)
def test_hostile_images(run, tmp_path, name):
    (tmp_path / name).write_bytes(IMAGES[name]())
    stage = tmp_path / "stage.usda"
    ways = [(WALL, ()), (DOME, ()), (WALL, ("--texture-memory", "1M", "--texture-cache", tmp_path / "cache"))]
    for use, options in ways[:1] if name in BOMBS else ways:
        stage.write_text(HEAD + use.format(file=name))
        size = ("--res", 16, 16, "--spp", 1, "-j", 1)
        judged(run("render", stage, "-o", tmp_path / "a.exr", *size, *options, timeout=SECONDS, preexec_fn=limited))

"""An office of 3.6 × 8.2 × 2.8 m with a window to the south, and its year's calendar."""

from collections.abc import Sequence

MONTHS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
# The head of a WEA file.
PLACE = "place Here\nlatitude 49.52\nlongitude -8.55\ntime_zone -15\nsite_elevation 96\nweather_data_file_units {units}\n"
# Reflectances.
MATTE = {"floor": 0.2, "wall": 0.5, "ceiling": 0.7}
Polygon = tuple[str, Sequence[tuple[float, float, float]]]
ROOM: list[Polygon] = [
    ("floor", [(0, 0, 0), (3.6, 0, 0), (3.6, 8.2, 0), (0, 8.2, 0)]),
    ("ceiling", [(0, 0, 2.8), (0, 8.2, 2.8), (3.6, 8.2, 2.8), (3.6, 0, 2.8)]),
    ("wall", [(0, 0, 0), (0, 8.2, 0), (0, 8.2, 2.8), (0, 0, 2.8)]),
    ("wall", [(3.6, 0, 0), (3.6, 0, 2.8), (3.6, 8.2, 2.8), (3.6, 8.2, 0)]),
    ("wall", [(0, 8.2, 0), (3.6, 8.2, 0), (3.6, 8.2, 2.8), (0, 8.2, 2.8)]),
    ("wall", [(0, 0, 0), (0, 0, 0.9), (3.6, 0, 0.9), (3.6, 0, 0)]),
    ("wall", [(0, 0, 2.35), (0, 0, 2.8), (3.6, 0, 2.8), (3.6, 0, 2.35)]),
    ("wall", [(0, 0, 0.9), (0, 0, 2.35), (0.2, 0, 2.35), (0.2, 0, 0.9)]),
    ("wall", [(3.4, 0, 0.9), (3.4, 0, 2.35), (3.6, 0, 2.35), (3.6, 0, 0.9)]),
]
# Where the sun comes in: from west to east and from sill to lintel.
WINDOW = ((0.2, 3.4), (0.9, 2.35))
HEAD = '#usda 1.0\n(\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n'
MATERIAL = """def Material "{name}_made"
{{
    token outputs:surface.connect = </{name}_made/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "UsdPreviewSurface"
        color3f inputs:diffuseColor = ({value}, {value}, {value})
        int inputs:useSpecularWorkflow = 1
        color3f inputs:specularColor = (0, 0, 0)
        float inputs:roughness = 1
        token outputs:surface
    }}
}}
"""
MESH = """def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    point3f[] points = {points}
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    uniform bool doubleSided = 1
    rel material:binding = </{kind}_made>
}}
"""


def mesh(name: str, kind: str, points: Sequence[tuple[float, float, float]]) -> str:
    """A polygon as a prim of USD."""
    return MESH.format(name=name, points=points, kind=kind)


def layer(polygons: Sequence[Polygon]) -> str:
    """Polygons and the matte materials as a layer of USD."""
    out = HEAD + "".join(MATERIAL.format(name=name, value=value) for name, value in MATTE.items())
    for number, (kind, points) in enumerate(polygons):
        out += mesh("Floor" if kind == "floor" else f"Part{number}", kind, points)
    return out

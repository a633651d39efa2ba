"""The rooms as a USD stage, for `gonio measure`."""

import shutil
from pathlib import Path

import two_rooms

HEAD = '#usda 1.0\n(\n    defaultPrim = "World"\n    metersPerUnit = 1\n    upAxis = "Z"\n)\n\ndef Xform "World"\n{\n'
MESH = """    def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        uniform bool doubleSided = 1
        uniform token subdivisionScheme = "none"
        int[] faceVertexCounts = {counts}
        int[] faceVertexIndices = {indices}
        point3f[] points = [{points}]
        rel material:binding = </World/{name}Material>
    }}
    def Material "{name}Material"
    {{
        token outputs:surface.connect = </World/{name}Material/Surface.outputs:surface>
        def Shader "Surface"
        {{
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = ({reflectance}, {reflectance}, {reflectance})
            int inputs:useSpecularWorkflow = 1
            color3f inputs:specularColor = (0, 0, 0)
            float inputs:ior = 1
            token outputs:surface
        }}
    }}
"""
LUMINAIRE = """    def RectLight "luminaire{number}"
    {{
        asset gonio:photometry:file = @{file}@
        double3 xformOp:translate = {place}
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
"""
GRID = """    def Xform "{name}"
    {{
        token gonio:grid:quantity = "illuminance"
        double2 gonio:grid:size = {size}
        double gonio:grid:spacing = {spacing}
        double3 xformOp:translate = {centre}
        uniform token[] xformOpOrder = ["xformOp:translate"]
    }}
"""


def mesh(material: str, reflectance: float) -> str:
    """All rectangles of a material, and the material."""
    quads = [each.corners() for each in two_rooms.rectangles() if each.material == material]
    corners = ", ".join("({:.9g}, {:.9g}, {:.9g})".format(*corner) for quad in quads for corner in quad)
    counts, indices = [4] * len(quads), list(range(4 * len(quads)))
    return MESH.format(name=material, counts=counts, indices=indices, points=corners, reflectance=reflectance)


def write(folder: Path) -> Path:
    """Writes the stage with its luminaire beside it."""
    shutil.copyfile(two_rooms.LUMINAIRE, folder / two_rooms.LUMINAIRE.name)
    parts = [mesh(*each) for each in two_rooms.REFLECTANCE.items()]
    for number, place in enumerate(two_rooms.LUMINAIRES):
        parts.append(LUMINAIRE.format(number=number, file=two_rooms.LUMINAIRE.name, place=place))
    parts += [GRID.format(name=grid.name, size=grid.size, spacing=grid.spacing, centre=grid.centre) for grid in two_rooms.GRIDS]
    stage = folder / "two_rooms.usda"
    stage.write_text(HEAD + "".join(parts) + "}\n")
    return stage

"""Writes downlight.usda: an LED in an aluminium reflector behind an opal cover, and a room that it hangs in.

`gonio goniometer downlight.usda --luminaire /World/Downlight -o downlight.ldt` measures the luminaire alone.
"""

from math import cos, pi, sin
from pathlib import Path

SIDES = 48
LED, MOUTH, DEPTH = 0.015, 0.08, 0.09

HEAD = """#usda 1.0
(
    defaultPrim = "World"
    metersPerUnit = 1
    upAxis = "Z"
)

def Xform "World"
{
"""
MATERIAL = """
    def Material "{name}"
    {{
        token outputs:mtlx:surface.connect = </World/{name}/Surface.outputs:out>
        def Shader "Surface"
        {{
            uniform token info:id = "ND_open_pbr_surface_surfaceshader"
{inputs}
            token outputs:out
        }}
    }}
"""
LIGHT = """
        def DiskLight "Led"
        {{
            float inputs:radius = {radius}
            bool inputs:enableColorTemperature = 1
            float inputs:colorTemperature = 4000
            double gonio:photometry:quantity = 1000
            token gonio:photometry:unit = "lm"
            double3 xformOp:translate = (0, 0, {height})
            uniform token[] xformOpOrder = ["xformOp:translate"]
        }}
"""
MESH = """
        def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
        {{
            int[] faceVertexCounts = {counts}
            int[] faceVertexIndices = {indices}
            point3f[] points = {points}
{normals}            uniform token subdivisionScheme = "none"
            rel material:binding = </World/{material}>
        }}
"""


def vectors(rows):
    """Points or normals as USD has them."""
    return "[" + ", ".join("({:.6f}, {:.6f}, {:.6f})".format(*row) for row in rows) + "]"


def turned(radius, height, number):
    """A point of a circle."""
    angle = 2 * pi * (number % SIDES) / SIDES
    return (radius * cos(angle), radius * sin(angle), height)


def revolved(name, material, profile):
    """A smooth surface of revolution through rings: radius, height, and the normal as radius and height."""
    points, normals, faces = [], [], []
    for radius, height, (outwards, up) in profile:
        points += [turned(radius, height, number) for number in range(SIDES)]
        normals += [turned(outwards, up, number) for number in range(SIDES)]
    for ring in range(len(profile) - 1):
        for number in range(SIDES):
            corners = [(ring, number), (ring, number + 1), (ring + 1, number + 1), (ring + 1, number)]
            faces.append([r * SIDES + n % SIDES for r, n in corners])
    return mesh(name, material, points, faces, normals)


def mesh(name, material, points, faces, normals=()):
    """A mesh of polygons, smooth if points have normals."""
    counts, indices = [len(face) for face in faces], [index for face in faces for index in face]
    smooth = f'            normal3f[] normals = {vectors(normals)} (\n                interpolation = "vertex"\n            )\n' if normals else ""
    return MESH.format(name=name, material=material, counts=counts, indices=indices, points=vectors(points), normals=smooth)


def reflector():
    """A paraboloid about the LED, which looks down and in."""
    # r² = 4 f (h0 − z): through the LED's rim and the mouth.
    four_f = (MOUTH**2 - LED**2) / DEPTH
    profile = []
    for step in range(17):
        radius = LED + (MOUTH - LED) * step / 16
        height = DEPTH - (radius**2 - LED**2) / four_f
        slope = -2 * radius / four_f
        length = (1 + slope * slope) ** 0.5
        profile.append((radius, height, (slope / length, -1 / length)))
    return revolved("Reflector", "Aluminium", profile[::-1])


def cover():
    """A sheet of opal glass over the mouth."""
    ring = [turned(MOUTH, 0.0, number) for number in range(SIDES)]
    return mesh("Cover", "Opal", ring, [list(range(SIDES))[::-1]])


def housing():
    """A black can with a lid, open at the mouth."""
    radius, top = MOUTH + 0.002, DEPTH + 0.01
    side = [(radius, 0.0, (1.0, 0.0)), (radius, top, (1.0, 0.0))]
    ring = [turned(radius, top, number) for number in range(SIDES)]
    lid = mesh("Lid", "Black", ring, [list(range(SIDES))])
    return revolved("Housing", "Black", side) + lid


def material(name, **inputs):
    """An OpenPBR surface."""
    kinds = {tuple: "color3f", bool: "bool", float: "float"}
    lines = [f"            {kinds[type(value)]} inputs:{key} = {int(value) if value is True else value}" for key, value in inputs.items()]
    return MATERIAL.format(name=name, inputs="\n".join(lines))


def room():
    """A floor 2.4 m below, which is no part of the luminaire."""
    square = [(-3, -3, -2.4), (3, -3, -2.4), (3, 3, -2.4), (-3, 3, -2.4)]
    return mesh("Floor", "Black", square, [[0, 1, 2, 3]])


def stage():
    """The whole file."""
    text = HEAD + '    def Xform "Downlight"\n    {' + LIGHT.format(radius=LED - 0.001, height=round(DEPTH - 0.001, 6))
    text += reflector() + cover() + housing() + "    }\n" + '    def Xform "Room"\n    {' + room() + "    }\n"
    text += material("Aluminium", base_metalness=1.0, base_color=(0.88, 0.88, 0.88), specular_roughness=0.1)
    glass = {"transmission_weight": 1.0, "transmission_color": (0.95, 0.95, 0.95), "geometry_thin_walled": True}
    text += material("Opal", specular_roughness=0.4, **glass)
    text += material("Black", base_color=(0.02, 0.02, 0.02), specular_weight=0.0)
    return text + "}\n"


if __name__ == "__main__":
    (Path(__file__).parent / "downlight.usda").write_text(stage())

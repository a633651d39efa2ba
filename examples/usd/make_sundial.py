"""Writes sundial.usda: a horizontal sundial for Vienna, under the sun and the sky of a summer's day.

The hour lines are those of solar time, and the sky comes from `gonio:daylight` attributes: the shadow tells the time.
"""

from math import atan2, cos, degrees, radians, sin, tan
from pathlib import Path

LATITUDE, LONGITUDE = 48.21, 16.37
PLATE, STYLE = 1.0, 0.85

HEAD = """#usda 1.0
(
    defaultPrim = "World"
    endTimeCode = 12
    metersPerUnit = 1
    startTimeCode = 0
    timeCodesPerSecond = 4
    upAxis = "Z"
)

def Xform "World"
{
    # Solar noon is at 11:57 on this clock; code 0 is 6:00, each code an hour.
    def Xform "Daylight"
    {
        double gonio:daylight:latitude = 48.21
        double gonio:daylight:longitude = 16.37
        string gonio:daylight:time = "2025-06-21T15:00:00+01:00"
        double gonio:daylight:hour.timeSamples = { 0: 6, 12: 18 }
        double gonio:daylight:ground = 0.2
    }

    def Camera "Camera"
    {
        float focalLength = 35
        float horizontalAperture = 24
        float verticalAperture = 18
        float exposure = -15
        double3 xformOp:translate = (1, -2.6, 3)
        double3 xformOp:rotateXYZ = (42, 0, 22)
        uniform token[] xformOpOrder = ["xformOp:translate", "xformOp:rotateXYZ"]
    }
"""
MATERIAL = """
    def Material "{name}"
    {{
        token outputs:surface.connect = </World/{name}/Surface.outputs:surface>
        def Shader "Surface"
        {{
            uniform token info:id = "UsdPreviewSurface"
            color3f inputs:diffuseColor = {colour}
            float inputs:metallic = {metallic}
            float inputs:roughness = {roughness}
            token outputs:surface
        }}
    }}
"""
MESH = """
    def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
    {{
        int[] faceVertexCounts = {counts}
        int[] faceVertexIndices = {indices}
        point3f[] points = {points}
        uniform token subdivisionScheme = "none"
        rel material:binding = </World/{material}>
    }}
"""


def mesh(name, material, points, faces):
    """A mesh of polygons."""
    text = "[" + ", ".join("({:.5f}, {:.5f}, {:.5f})".format(*point) for point in points) + "]"
    return MESH.format(name=name, material=material, points=text, counts=[len(f) for f in faces], indices=[i for f in faces for i in f])


def prism(name, material, outline, low, high):
    """A vertical prism over an outline (x, y), anticlockwise."""
    count = len(outline)
    points = [(*p, low) for p in outline] + [(*p, high) for p in outline]
    sides = [[i, (i + 1) % count, count + (i + 1) % count, count + i] for i in range(count)]
    return mesh(name, material, points, [list(range(count))[::-1], list(range(count, 2 * count)), *sides])


def bar(angle, inner, outer, width):
    """A bar's outline from one radius to another, at an angle clockwise from north."""
    along, aside = (sin(angle), cos(angle)), (cos(angle) * width / 2, -sin(angle) * width / 2)
    corners = ((inner, -1), (inner, 1), (outer, 1), (outer, -1))
    outline = [(along[0] * r + aside[0] * s, along[1] * r + aside[1] * s) for r, s in corners]
    return outline[::-1]


def style():
    """The triangle whose upper edge points to the pole, in the plane of the meridian."""
    half, foot = 0.012, 0.05
    tip = (STYLE * cos(radians(LATITUDE)), STYLE * sin(radians(LATITUDE)))
    points = [(x, y, foot + z) for x in (-half, half) for y, z in ((0, 0), (tip[0], 0), tip)]
    return mesh("Style", "Brass", points, [[0, 2, 1], [3, 4, 5], [0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]])


def main() -> None:
    circle = [(PLATE * cos(radians(a)), PLATE * sin(radians(a))) for a in range(0, 360, 3)]
    parts = [HEAD]
    parts.append(MATERIAL.format(name="Stone", colour=(0.55, 0.53, 0.5), metallic=0, roughness=0.9))
    parts.append(MATERIAL.format(name="Lawn", colour=(0.1, 0.16, 0.05), metallic=0, roughness=1))
    parts.append(MATERIAL.format(name="Brass", colour=(0.75, 0.55, 0.2), metallic=1, roughness=0.35))
    parts.append(MATERIAL.format(name="Slate", colour=(0.05, 0.05, 0.06), metallic=0, roughness=0.7))
    parts.append(mesh("Ground", "Lawn", [(-40, -40, 0), (40, -40, 0), (40, 40, 0), (-40, 40, 0)], [[0, 1, 2, 3]]))
    parts.append(prism("Plate", "Stone", circle, 0.0, 0.05))
    for hour in range(5, 20):
        turn = radians(15.0 * (hour - 12))
        angle = atan2(sin(radians(LATITUDE)) * tan(turn), 1.0) + (0.0 if cos(turn) > 1e-9 else radians(180.0))
        angle = radians(90.0) * (1 if hour == 18 else -1) if hour in (6, 18) else angle
        length = 0.35 if hour % 3 else 0.5
        parts.append(prism(f"Hour{hour:02d}", "Slate", bar(angle, 0.95 - length, 0.95, 0.018), 0.0501, 0.053))
        print(f"{hour:2d} h at {degrees(angle) % 360:.1f}°")
    parts.append(style())
    parts.append("}\n")
    Path(__file__).with_name("sundial.usda").write_text("".join(parts))


if __name__ == "__main__":
    main()

"""An office with a window to the south, and years of weather by a rule."""

import math

MONTHS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
PLACE = "place Here\nlatitude 49.52\nlongitude -8.55\ntime_zone -15\nsite_elevation 96\nweather_data_file_units {units}\n"
EPW_HEAD = """LOCATION,Here,-,-,-,0,49.52,8.55,1.0,96.0
DESIGN CONDITIONS,0
TYPICAL/EXTREME PERIODS,0
GROUND TEMPERATURES,0
HOLIDAYS/DAYLIGHT SAVINGS,{leap},0,0,0
COMMENTS 1,-
COMMENTS 2,-
DATA PERIODS,1,1,Data,Sunday, 1/ 1,12/31
"""
MATTE = {"floor": 0.2, "wall": 0.5, "ceiling": 0.7}
# A room of 3.6 × 8.2 × 2.8 m.
ROOM = [
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
# Slats behind the window that let no light from above the horizon straight through: a variant.
SLATS = [[(0, 0.19, z), (3.6, 0.19, z), (3.6, 0.04, z - 0.16), (0, 0.04, z - 0.16)] for z in (0.95 + 0.14 * number for number in range(12))]
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
BLINDS = """def Xform "Blinds" (
    variants = {{
        string position = "open"
    }}
    prepend variantSets = "position"
)
{{
    variantSet "position" = {{
        "open" {{
        }}
        "closed" {{
{slats}
        }}
    }}
}}
"""
CLOSED = "/Blinds{position=closed}"


def stage() -> str:
    """The office as a layer of USD; its blinds are open."""
    out = '#usda 1.0\n(\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n'
    out += "".join(MATERIAL.format(name=name, value=value) for name, value in MATTE.items())
    for number, (kind, points) in enumerate(ROOM):
        out += MESH.format(name="Floor" if kind == "floor" else f"Part{number}", points=points, kind=kind)
    slats = "".join(MESH.format(name=f"Slat{number}", points=points, kind="ceiling") for number, points in enumerate(SLATS))
    return out + BLINDS.format(slats=slats)


def hours(is_leap_year: bool = False) -> list[tuple[int, int, int]]:
    """Month, day and hour at which each interval begins."""
    lengths = [length + (is_leap_year and month == 2) for month, length in enumerate(MONTHS, 1)]
    return [(month, day, hour) for month, length in enumerate(lengths, 1) for day in range(1, length + 1) for hour in range(24)]


def light(number: int, hour: int) -> tuple[int, int]:
    """Direct normal and diffuse horizontal irradiance, W/m²: clear and grey days; in winter the sky has light before the sun is up."""
    height = math.sin(math.pi * (hour - 5) / 15)
    return round(number // 24 * 37 % 9 * 110 * height) * (9 <= hour <= 15), round((20 + number * 53 % 7 * 35) * height) * (6 <= hour <= 19)


def epw(is_leap_year: bool = False) -> str:
    """The year as an EPW file."""
    lines = []
    for number, (month, day, hour) in enumerate(hours(is_leap_year)):
        direct, diffuse = light(number, hour)
        dew_point = 5 + number % 11
        fields = [2024 if is_leap_year else 2023, month, day, hour + 1, 0, "?", 15, dew_point, 60, 101325, 0, 0, 300]
        fields += [0, direct, diffuse, 999999, 999999, 999999, 9999, 0, 0, 5, 5, 9999, 99999, 9, 999999999, 10, 0.1, 0, 88, 0.2, 0, 0]
        lines.append(",".join(str(field) for field in fields))
    return EPW_HEAD.format(leap="Yes" if is_leap_year else "No") + "\n".join(lines) + "\n"


def wea(direct: list[float], diffuse: list[float]) -> str:
    """A year in lx as a WEA file."""
    rows = zip(hours(), direct, diffuse, strict=True)
    return PLACE.format(units=3) + "".join(f"{month} {day} {hour}.500 {sun} {sky}\n" for (month, day, hour), sun, sky in rows)

"""An office of 3.6 × 8.2 × 2.8 m with a window to the south, and a made year of weather, for gonio and for Radiance."""

MONTHS = (31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31)
HEAD = "place Here\nlatitude 49.52\nlongitude -8.55\ntime_zone -15\nsite_elevation 96\nweather_data_file_units 1\n"
# Reflectances, and polygons of a room of 3.6 × 8.2 × 2.8 m with a window to the south.
MATTE = {"floor": 0.2, "wall": 0.5, "ceiling": 0.7}
# Radiance's transmissivity of a pane of index 1.52.
TRANSMISSIVITY = 0.763
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
    ("pane", [(0.2, 0, 0.9), (0.2, 0, 2.35), (3.4, 0, 2.35), (3.4, 0, 0.9)]),
]
SKY = """#@rfluxmtx h=u u=Y
void glow ground 0 0 4 1 1 1 0
ground source below 0 0 4 0 0 -1 180
#@rfluxmtx h=r2 u=Y
void glow sky 0 0 4 1 1 1 0
sky source above 0 0 4 0 0 1 180
"""


def weather() -> str:
    """Clear and grey hours by a rule, W/m²."""
    lines = []
    for number, (month, day, hour) in enumerate((m, d, h) for m, days in enumerate(MONTHS, 1) for d in range(1, days + 1) for h in range(24)):
        light = 7 <= hour <= 17
        lines.append(f"{month} {day} {hour}.500 {number // 24 * 37 % 9 * 90 * light} {(80 + number * 53 % 7 * 25) * light}\n")
    return HEAD + "".join(lines)


def stage() -> str:
    out = '#usda 1.0\n(\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n'
    for name, value in MATTE.items():
        out += f'''def Material "{name}_made"
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
'''
    colour = (TRANSMISSIVITY,) * 3
    out += f'''def Material "pane_made"
{{
    token outputs:mtlx:surface.connect = </pane_made/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
        float inputs:base_weight = 0
        float inputs:transmission_weight = 1
        color3f inputs:transmission_color = {colour}
        float inputs:specular_ior = 1.52
        float inputs:specular_roughness = 0
        bool inputs:geometry_thin_walled = 1
        token outputs:surface
    }}
}}
'''
    for number, (kind, points) in enumerate(ROOM):
        name = "Floor" if kind == "floor" else f"Part{number}"
        out += f'''def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    point3f[] points = {points}
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    uniform bool doubleSided = 1
    rel material:binding = </{kind}_made>
}}
'''
    return out


def room() -> str:
    out = "".join(f"void plastic {name} 0 0 5 {value} {value} {value} 0 0\n" for name, value in MATTE.items())
    out += f"void glass pane 0 0 3 {TRANSMISSIVITY} {TRANSMISSIVITY} {TRANSMISSIVITY}\n"
    for number, (kind, points) in enumerate(ROOM):
        out += f"{kind} polygon part{number} 0 0 12 " + " ".join(f"{x}" for point in points for x in point) + "\n"
    return out

"""An office of 3.6 × 8.2 × 2.8 m with a window to the south, and a made year of weather, for gonio and for Radiance."""

import office_room

# Radiance's transmissivity of a pane of index 1.52.
TRANSMISSIVITY = 0.763
POLYGONS: list[office_room.Polygon] = [*office_room.ROOM, ("pane", [(0.2, 0, 0.9), (0.2, 0, 2.35), (3.4, 0, 2.35), (3.4, 0, 0.9)])]
PANE = f"""def Material "pane_made"
{{
    token outputs:mtlx:surface.connect = </pane_made/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
        float inputs:base_weight = 0
        float inputs:transmission_weight = 1
        color3f inputs:transmission_color = {(TRANSMISSIVITY,) * 3}
        float inputs:specular_ior = 1.52
        float inputs:specular_roughness = 0
        bool inputs:geometry_thin_walled = 1
        token outputs:surface
    }}
}}
"""
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
    hours = ((m, d, h) for m, days in enumerate(office_room.MONTHS, 1) for d in range(1, days + 1) for h in range(24))
    for number, (month, day, hour) in enumerate(hours):
        light = 7 <= hour <= 17
        lines.append(f"{month} {day} {hour}.500 {number // 24 * 37 % 9 * 90 * light} {(80 + number * 53 % 7 * 25) * light}\n")
    return office_room.PLACE.format(units=1) + "".join(lines)


def stage() -> str:
    """The office as a layer of USD."""
    return office_room.layer(POLYGONS) + PANE


def room() -> str:
    out = "".join(f"void plastic {name} 0 0 5 {value} {value} {value} 0 0\n" for name, value in office_room.MATTE.items())
    out += f"void glass pane 0 0 3 {TRANSMISSIVITY} {TRANSMISSIVITY} {TRANSMISSIVITY}\n"
    for number, (kind, points) in enumerate(POLYGONS):
        out += f"{kind} polygon part{number} 0 0 12 " + " ".join(f"{x}" for point in points for x in point) + "\n"
    return out

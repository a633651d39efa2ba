"""A room with windows to the south and the west, each with a screen or a board before it by a variant: a stage for years of daylight."""

# Metres: width (x), depth (y), height; windows' sides along the wall, sill and lintel.
WIDE, DEEP, HIGH = 4.0, 5.0, 3.0
SILL, LINTEL = 0.9, 2.6

HEAD = '#usda 1.0\n(\n    defaultPrim = "Room"\n    upAxis = "Z"\n    metersPerUnit = 1\n)\n'
_SHADER = """def Material "{name}"
{{
    token outputs:mtlx:surface.connect = </{name}/S.outputs:surface>
    def Shader "S"
    {{
        uniform token info:id = "ND_open_pbr_surface_surfaceshader"
{inputs}
        token outputs:surface
    }}
}}
"""


def _material(name, **inputs):
    kinds = {float: "float", bool: "bool", tuple: "color3f"}
    lines = [
        f"        {kinds[type(value)]} inputs:{key} = {int(value) if isinstance(value, bool) else value}" for key, value in inputs.items()
    ]
    return _SHADER.format(name=name, inputs="\n".join(lines))


def _matte(name, grey, **inputs):
    return _material(name, base_color=(grey,) * 3, specular_weight=0.0, **inputs)


MATERIALS = "".join(
    [
        _matte("Wall", 0.6),
        _matte("Soil", 0.2),
        _matte("Fabric", 0.5, geometry_opacity=0.9),
        _material(
            "Pane",
            base_weight=0.0,
            transmission_weight=1.0,
            transmission_color=(0.75,) * 3,
            specular_roughness=0.0,
            geometry_thin_walled=True,
        ),
    ]
)


def quad(name, corners, material, indent=""):
    """A mesh of one face."""
    text = f"""def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    point3f[] points = {[tuple(map(float, corner)) for corner in corners]}
    int[] faceVertexCounts = [4]
    int[] faceVertexIndices = [0, 1, 2, 3]
    uniform token subdivisionScheme = "none"
    rel material:binding = </{material}>
}}
"""
    return "".join(f"{indent}{line}\n" for line in text.splitlines())


def wall_with_window(name, place, length, window, material="Wall"):
    """Four faces around a window; `place` takes metres along the wall and up to a point."""
    first, last = window
    pieces = [(0, first, 0, HIGH), (last, length, 0, HIGH), (first, last, 0, SILL), (first, last, LINTEL, HIGH)]
    return "".join(
        quad(f"{name}{number}", [place(a, low), place(b, low), place(b, high), place(a, high)], material)
        for number, (a, b, low, high) in enumerate(pieces)
    )


def facade(name, place, window):
    """A pane, a screen inside of it where the variant `blinds` is `closed`, a larger board outside where it is `shut`; `place` takes metres inwards too."""
    first, last = window

    def across(deep, over=0.0):
        (left, right), (low, high) = (first - over, last + over), (SILL - over, LINTEL + over)
        return [place(left, low, deep), place(right, low, deep), place(right, high, deep), place(left, high, deep)]

    return f"""def Xform "{name}" (
    variants = {{ string blinds = "open" }}
    prepend variantSets = "blinds"
)
{{
{quad("Glass", across(0.0), "Pane", "    ")}
    variantSet "blinds" = {{
        "closed" {{
{quad("Screen", across(0.05), "Fabric", "            ")}
        }}
        "open" {{
        }}
        "shut" {{
{quad("Board", across(-0.02, 0.3), "Soil", "            ")}
        }}
    }}
}}
"""


def stage(more=""):
    """The room as a stage: floor /Room/Floor, facades /Room/South and /Room/West."""
    south = lambda along, up, deep=0.0: (along, deep, up)
    west = lambda along, up, deep=0.0: (deep, along, up)
    windows = {"South": (0.5, WIDE - 0.5), "West": (1.0, 4.0)}
    inside = [
        quad("Floor", [(0, 0, 0), (WIDE, 0, 0), (WIDE, DEEP, 0), (0, DEEP, 0)], "Wall"),
        quad("Ceiling", [(0, 0, HIGH), (0, DEEP, HIGH), (WIDE, DEEP, HIGH), (WIDE, 0, HIGH)], "Wall"),
        quad("East", [(WIDE, 0, 0), (WIDE, DEEP, 0), (WIDE, DEEP, HIGH), (WIDE, 0, HIGH)], "Wall"),
        quad("North", [(0, DEEP, 0), (WIDE, DEEP, 0), (WIDE, DEEP, HIGH), (0, DEEP, HIGH)], "Wall"),
        wall_with_window("SouthWall", south, WIDE, windows["South"]),
        wall_with_window("WestWall", west, DEEP, windows["West"]),
        facade("South", south, windows["South"]),
        facade("West", west, windows["West"]),
        more,
    ]
    room = "".join(f"    {line}\n" for line in "".join(inside).splitlines())
    ground = quad("Ground", [(-30, -30, -0.1), (30, -30, -0.1), (30, 30, -0.1), (-30, 30, -0.1)], "Soil")
    return f'{HEAD}{MATERIALS}{ground}def Xform "Room"\n{{\n{room}}}\n'

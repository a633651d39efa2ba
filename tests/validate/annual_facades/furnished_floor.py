"""Writes an office floor of 20 × 12 m with desks and two facades of blinds as a stage: `python furnished_floor.py floor.usda`.

Windows to the south and the west have slats outside, drawn in by the variant `blinds` of /Office/South and /Office/West:

    gonio annual floor.usda --weather place.epw --grid /Office/Floor --height 0.76 --spacing 0.48 -o out \\
        --group south=/Office/South --group west=/Office/West \\
        --closed-variant 'south=/Office/South{blinds=closed}' --closed-variant 'west=/Office/West{blinds=closed}'
"""

import math
import sys
from pathlib import Path

import facade_room as room

# Metres.
WIDE, DEEP, HIGH = 20.0, 12.0, 3.0
SILL, LINTEL, BAY = 0.8, 2.7, 2.0
SLAT, PITCH, TILT_DEG = 0.08, 0.072, 45
DESK = (1.6, 0.8, 0.72)


def mesh(name, boxes_or_quads, material):
    """A mesh of faces of four corners each."""
    points = [corner for quad in boxes_or_quads for corner in quad]
    count = len(boxes_or_quads)
    return f"""def Mesh "{name}" (prepend apiSchemas = ["MaterialBindingAPI"])
{{
    point3f[] points = {[tuple(round(float(x), 4) for x in point) for point in points]}
    int[] faceVertexCounts = {[4] * count}
    int[] faceVertexIndices = {list(range(4 * count))}
    uniform token subdivisionScheme = "none"
    rel material:binding = </{material}>
}}
"""


def box(low, high):
    """The six faces of a box."""
    corner = lambda *which: tuple(high[axis] if bit else low[axis] for axis, bit in enumerate(which))
    faces = []
    for axis in range(3):
        for side in (0, 1):
            turn = [(0, 0), (1, 0), (1, 1), (0, 1)]
            faces.append([corner(*(pair[:axis] + (side,) + pair[axis:])) for pair in turn])
    return faces


def desks():
    """Rows of desks with a panel between two, and a chair each."""
    wide, deep, high = DESK
    faces = []
    for column in range(8):
        for row in range(4):
            x, y = 1.6 + column * 2.2, 1.2 + row * 2.8
            faces += box((x, y, high - 0.03), (x + wide, y + deep, high)) + box((x, y, 0), (x + 0.03, y + deep, high - 0.03))
            faces += box((x + wide - 0.03, y, 0), (x + wide, y + deep, high - 0.03)) + box(
                (x, y + deep, 0.4), (x + wide, y + deep + 0.03, 1.15)
            )
            faces += box((x + 0.55, y - 0.6, 0.4), (x + 1.05, y - 0.15, 0.46)) + box((x + 0.55, y - 0.62, 0.46), (x + 1.05, y - 0.58, 0.95))
    return mesh("Desks", faces, "Wall")


def slats(place, window):
    """Slats outside of a window, tilted."""
    first, last = window
    out, up = (0.5 * SLAT * turn(math.radians(TILT_DEG)) for turn in (math.cos, math.sin))
    heights = [SILL + PITCH * (number + 0.5) for number in range(int((LINTEL - SILL) / PITCH))]
    quads = [(-0.1 - out, height - up, -0.1 + out, height + up) for height in heights]
    return [
        [place(first, low, outer), place(last, low, outer), place(last, high, inner), place(first, high, inner)]
        for outer, low, inner, high in quads
    ]


def facade(name, place, length):
    """Panes in bays, walls about them, slats in the variant `closed`."""
    windows = [(BAY * bay + 0.1, BAY * (bay + 1) - 0.1) for bay in range(int(length / BAY))]
    pane = lambda a, b: [place(a, SILL), place(b, SILL), place(b, LINTEL), place(a, LINTEL)]
    solid = [(0, length, 0, SILL), (0, length, LINTEL, HIGH)]
    edges = [0, *(edge for window in windows for edge in window), length]
    solid += [(a, b, SILL, LINTEL) for a, b in zip(edges[::2], edges[1::2], strict=True)]
    wall = [[place(a, low), place(b, low), place(b, high), place(a, high)] for a, b, low, high in solid]
    blinds = [slat for window in windows for slat in slats(place, window)]
    return f"""{mesh(name + "Wall", wall, "Wall")}def Xform "{name}" (
    variants = {{ string blinds = "open" }}
    prepend variantSets = "blinds"
)
{{
{mesh("Glass", [pane(*window) for window in windows], "Pane")}
    variantSet "blinds" = {{
        "closed" {{
{mesh("Slats", blinds, "Wall")}
        }}
        "open" {{
        }}
    }}
}}
"""


def stage():
    """The floor as a stage."""
    inside = [
        mesh("Floor", [[(0, 0, 0), (WIDE, 0, 0), (WIDE, DEEP, 0), (0, DEEP, 0)]], "Soil"),
        mesh("Ceiling", [[(0, 0, HIGH), (0, DEEP, HIGH), (WIDE, DEEP, HIGH), (WIDE, 0, HIGH)]], "Wall"),
        mesh("East", [[(WIDE, 0, 0), (WIDE, DEEP, 0), (WIDE, DEEP, HIGH), (WIDE, 0, HIGH)]], "Wall"),
        mesh("North", [[(0, DEEP, 0), (WIDE, DEEP, 0), (WIDE, DEEP, HIGH), (0, DEEP, HIGH)]], "Wall"),
        facade("South", lambda along, up, deep=0.0: (along, deep, up), WIDE),
        facade("West", lambda along, up, deep=0.0: (deep, along, up), DEEP),
        desks(),
    ]
    ground = room.quad("Ground", [(-60, -60, -0.1), (60, -60, -0.1), (60, 60, -0.1), (-60, 60, -0.1)], "Soil")
    return f'{room.HEAD.replace("Room", "Office")}{room.MATERIALS}{ground}def Xform "Office"\n{{\n{"".join(inside)}}}\n'


if __name__ == "__main__":
    Path(sys.argv[1]).write_text(stage())

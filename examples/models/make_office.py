"""Writes office.hbjson: a honeybee model of a room of 6 by 4.5 m with two windows to the south, four luminaires and a grid of sensors on the work plane."""

import json
import math
import pathlib

WIDTH, DEPTH, HEIGHT = 6.0, 4.5, 2.9
# The windows: from, to, sill, lintel.
WINDOWS = ((0.6, 2.7, 0.9, 2.5), (3.3, 5.4, 0.9, 2.5))
PLANE, MARGIN, SPACING = 0.75, 0.5, 0.5
LUMENS, WATTS, POWER = 4000, 30, 2.5


def panel() -> str:
    """The IES file of a light panel of 0.6 by 0.6 m that is shielded against glare: its intensity falls as a power of the cosine."""
    angles = range(0, 91, 5)
    peak = LUMENS * (POWER + 1) / math.tau
    candelas = " ".join(f"{peak * math.cos(math.radians(angle)) ** POWER:.1f}" for angle in angles)
    head = f"1 -1 1 {len(angles)} 1 1 2 0.6 0.6 0\n1 1 {WATTS}\n"
    return "IESNA:LM-63-2002\n[LUMINAIRE] Panel 600\nTILT=NONE\n" + head + " ".join(map(str, angles)) + "\n0\n" + candelas + "\n"


def face(name: str, kind: str, boundary: list, apertures: list | None = None) -> dict:
    """A face of the room, seen from outside."""
    geometry = {"type": "Face3D", "boundary": boundary}
    made = {"type": "Face", "identifier": name, "face_type": kind, "geometry": geometry, "boundary_condition": {"type": "Outdoors"}, "properties": {}}
    return made | ({"apertures": apertures} if apertures else {})


def window(number: int, left: float, right: float, sill: float, lintel: float) -> dict:
    """A window of the south wall."""
    geometry = {"type": "Face3D", "boundary": [[left, 0, sill], [right, 0, sill], [right, 0, lintel], [left, 0, lintel]]}
    return {"type": "Aperture", "identifier": f"window{number}", "geometry": geometry, "boundary_condition": {"type": "Outdoors"}, "properties": {}}


def room() -> dict:
    """The room with its windows."""
    w, d, h = WIDTH, DEPTH, HEIGHT
    faces = [
        face("floor", "Floor", [[0, 0, 0], [0, d, 0], [w, d, 0], [w, 0, 0]]),
        face("ceiling", "RoofCeiling", [[0, 0, h], [w, 0, h], [w, d, h], [0, d, h]]),
        face("south", "Wall", [[0, 0, 0], [w, 0, 0], [w, 0, h], [0, 0, h]], [window(number, *of) for number, of in enumerate(WINDOWS, 1)]),
        face("north", "Wall", [[w, d, 0], [0, d, 0], [0, d, h], [w, d, h]]),
        face("west", "Wall", [[0, d, 0], [0, 0, 0], [0, 0, h], [0, d, h]]),
        face("east", "Wall", [[w, 0, 0], [w, d, 0], [w, d, h], [w, 0, h]]),
    ]
    return {"type": "Room", "identifier": "office", "faces": faces, "properties": {}}


def sensors() -> list:
    """Points on the work plane, even within its margin."""
    counts = [round((side - 2 * MARGIN) / SPACING) for side in (WIDTH, DEPTH)]
    steps = [(side - 2 * MARGIN) / count for side, count in zip((WIDTH, DEPTH), counts, strict=True)]
    places = [[MARGIN + step * (number + 0.5) for number in range(count)] for step, count in zip(steps, counts, strict=True)]
    return [{"pos": [round(x, 3), round(y, 3), PLANE], "dir": [0, 0, 1]} for y in places[1] for x in places[0]]


def model() -> dict:
    """The model with its luminaires just below the ceiling."""
    points = [{"type": "Point3D", "x": x, "y": y, "z": HEIGHT - 0.01} for y in (1.2, 3.3) for x in (1.5, 4.5)]
    luminaire = {
        "type": "Luminaire",
        "identifier": "panel",
        "ies_content": panel(),
        "light_loss_factor": 1.0,
        "luminaire_zone": {"type": "LuminaireZone", "instances": [{"type": "LuminaireInstance", "point": point} for point in points]},
    }
    grid = {"type": "SensorGrid", "identifier": "desks", "sensors": sensors()}
    view = {"type": "View", "identifier": "door", "position": [5.6, 4.1, 1.6], "direction": [-0.8, -0.9, -0.15], "up_vector": [0, 0, 1], "h_size": 75, "v_size": 58}
    radiance = {"type": "ModelRadianceProperties", "sensor_grids": [grid], "views": [view], "luminaires": [luminaire]}
    return {"type": "Model", "identifier": "office", "units": "Meters", "rooms": [room()], "properties": {"type": "ModelProperties", "radiance": radiance}}


if __name__ == "__main__":
    path = pathlib.Path(__file__).with_name("office.hbjson")
    path.write_text(json.dumps(model(), indent=1) + "\n")

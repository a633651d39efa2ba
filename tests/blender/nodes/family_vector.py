"""Vectors and normals: mappings, turns, spaces, bumps, tangents, displacement."""

from .case import Case, Node

FAMILY = "Vector"
STEPS = "heights that lie a tenth of a pixel apart, rounded in both engines: held by middles of blocks"
MAPPINGS = ["POINT", "TEXTURE", "VECTOR", "NORMAL"]
TURNS = ["AXIS_ANGLE", "X_AXIS", "Y_AXIS", "Z_AXIS", "EULER_XYZ"]
SPACES = ["WORLD", "OBJECT", "CAMERA"]
HELD = {"Location": (0.3, -0.7, 1.1), "Rotation": (0.4, -0.9, 2.3), "Scale": (1.3, -0.6, 2.2)}
NEAR = {"on_sphere": True, "stage": "near"}
DISPLACED = {"seen": "displacement", "rounded": True, **NEAR}
BUMPED = {"prepare": "waves", **NEAR}
DRIVEN = {"Location": "place 1", "Rotation": "place 2", "Scale": "positive 0"}


def _only(kind: str, inputs: dict) -> dict:
    """The inputs that one kind of mapping has: directions do not move."""
    return inputs if kind in ("POINT", "TEXTURE") else {name: value for name, value in inputs.items() if name != "Location"}


def _spaces() -> tuple[Case, ...]:
    """Vector Transform: each kind of vector from each space to each other."""
    return tuple(
        Case(
            f"{kind}, {first} to {second}",
            {"vector_type": kind, "convert_from": first, "convert_to": second},
            {0: "hit.NewGeometry.Normal" if kind == "NORMAL" else "hit.NewGeometry.Position"},
            on_sphere=True,
        )
        for kind in ("POINT", "VECTOR", "NORMAL")
        for first in SPACES
        for second in SPACES
        if first != second
    )


def _turned(invert: bool) -> tuple[Case, ...]:
    """Vector Rotate in one sense."""
    return tuple(
        Case(
            f"{kind}{', inverted' if invert else ''}",
            {"rotation_type": kind, "invert": invert},
            {
                **{"Vector": "place 0", "Center": "place 1"},
                **({"Rotation": "place 2"} if kind == "EULER_XYZ" else {"Angle": "place 2.x"}),
                **({"Axis": "unit 0"} if kind == "AXIS_ANGLE" else {}),
            },
        )
        for kind in TURNS
    )


NODES = {
    "ShaderNodeMapping": Node(
        "Mapping",
        FAMILY,
        cases=(
            *(Case(kind, {"vector_type": kind}, {"Vector": "place 0", **_only(kind, HELD)}) for kind in MAPPINGS),
            *(Case(f"{kind}, driven", {"vector_type": kind}, {"Vector": "place 0", **_only(kind, DRIVEN)}) for kind in MAPPINGS),
        ),
    ),
    "ShaderNodeVectorRotate": Node("Vector Rotate", FAMILY, cases=(*_turned(False), *_turned(True))),
    "ShaderNodeVectorTransform": Node("Vector Transform", FAMILY, cases=_spaces()),
    "ShaderNodeNormal": Node("Normal", FAMILY, cases=(Case("all", {}, {0: "place 0"}, prepare="normal_value"),)),
    "ShaderNodeNormalMap": Node(
        "Normal Map",
        FAMILY,
        cases=(
            *(
                Case(space, {"space": space}, {"Color": (0.7, 0.35, 0.85), "Strength": 1.0}, on_sphere=True)
                for space in ("TANGENT", "OBJECT", "WORLD", "BLENDER_OBJECT", "BLENDER_WORLD")
            ),
            Case("TANGENT, strength 0.4", {"space": "TANGENT"}, {"Color": (0.7, 0.35, 0.85), "Strength": 0.4}, on_sphere=True),
            Case("TANGENT, strength 1.7", {"space": "TANGENT"}, {"Color": (0.7, 0.35, 0.85), "Strength": 1.7}, on_sphere=True),
            Case("WORLD, strength 0.4", {"space": "WORLD"}, {"Color": (0.7, 0.35, 0.85), "Strength": 0.4}, on_sphere=True),
            Case("TANGENT, driven", {"space": "TANGENT"}, {"Color": "hit.TexCoord.Generated"}, on_sphere=True),
            Case("TANGENT, second map", {"uv_map": "second"}, {"Color": (0.7, 0.35, 0.85)}, on_sphere=True, steps=0.02),
        ),
    ),
    "ShaderNodeBump": Node(
        "Bump",
        FAMILY,
        remark=STEPS,
        cases=(
            Case("smooth", {}, {"Distance": 0.2}, rounded=True, **BUMPED),
            Case("inverted", {"invert": True}, {"Distance": 0.2}, rounded=True, **BUMPED),
            Case("strength 0.4", {}, {"Distance": 0.2, "Strength": 0.4}, rounded=True, **BUMPED),
            Case("filter width 1", {}, {"Distance": 0.2, "Filter Width": 1.0}, **BUMPED),
            Case("inverted, filter width 1", {"invert": True}, {"Distance": 0.2, "Filter Width": 1.0}, **BUMPED),
            Case("strength 0.4, filter width 1", {}, {"Distance": 0.2, "Strength": 0.4, "Filter Width": 1.0}, **BUMPED),
            Case("flat", {}, {"Height": 0.5}, **NEAR),
            Case("on a map", {}, {"Distance": 0.2}, rounded=True, prepare="waves_on_map", **NEAR),
            Case("on a map, filter width 1", {}, {"Distance": 0.2, "Filter Width": 1.0}, prepare="waves_on_map", **NEAR),
        ),
    ),
    "ShaderNodeDisplacement": Node(
        "Displacement",
        FAMILY,
        remark=STEPS,
        cases=tuple(
            Case(f"{space}, as bump", {"space": space}, {"Scale": 0.2, "Midlevel": 0.4}, prepare="waves", **DISPLACED)
            for space in ("OBJECT", "WORLD")
        ),
    ),
    "ShaderNodeVectorDisplacement": Node(
        "Vector Displacement",
        FAMILY,
        remark=STEPS,
        cases=tuple(
            Case(f"{space}, as bump", {"space": space}, {"Scale": 0.2, "Midlevel": 0.1}, prepare="waves", **DISPLACED)
            for space in ("TANGENT", "OBJECT", "WORLD")
        ),
    ),
    "ShaderNodeTangent": Node(
        "Tangent",
        FAMILY,
        cases=(
            *(Case(f"RADIAL, {axis}", {"direction_type": "RADIAL", "axis": axis}, {}, on_sphere=True) for axis in "XYZ"),
            Case("UV_MAP", {"direction_type": "UV_MAP"}, {}, on_sphere=True),
            Case("UV_MAP, second", {"direction_type": "UV_MAP", "uv_map": "second"}, {}, on_sphere=True, steps=0.02),
        ),
    ),
}

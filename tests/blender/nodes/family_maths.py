"""Arithmetic: Math, Vector Math, Map Range, Clamp, and what takes vectors apart and puts them together."""

from .case import WHOLE, Case, Node, modes

FAMILY = "Converter"
# Sums, products, comparisons and steps: nothing that engines may round in a way of their own.
PLAIN = [
    *("ADD", "SUBTRACT", "MULTIPLY", "ABSOLUTE", "MINIMUM", "MAXIMUM", "LESS_THAN", "GREATER_THAN", "SIGN", "COMPARE"),
    *("ROUND", "FLOOR", "CEIL", "TRUNC", "FRACT"),
]
# Steps that lie where a quotient is a whole number.
STEPPED = ["FLOORED_MODULO", "WRAP", "SNAP", "PINGPONG"]
SMOOTH = [
    *("DIVIDE", "MULTIPLY_ADD", "MODULO", "POWER", "LOGARITHM", "SQRT", "INVERSE_SQRT", "EXPONENT", "SMOOTH_MIN", "SMOOTH_MAX"),
    *("RADIANS", "DEGREES", "SINE", "COSINE", "TANGENT", "ARCSINE", "ARCCOSINE", "ARCTANGENT", "ARCTAN2", "SINH", "COSH", "TANH"),
]
OPERANDS = {0: "wide 0.x", 1: "wide 1.x", 2: "wide 2.x"}
# Quotients that are not so large that nothing is left of their fractions.
NEAR = {0: "place 0.x", 1: "place 1.x", 2: "place 2.x"}

VECTOR_PLAIN = [
    *("ADD", "SUBTRACT", "MULTIPLY", "ABSOLUTE", "MINIMUM", "MAXIMUM", "FLOOR", "CEIL", "FRACTION", "SCALE", "SIGN"),
]
VECTOR_STEPPED = ["MODULO", "WRAP", "SNAP"]
VECTOR_SMOOTH = [
    *("DIVIDE", "MULTIPLY_ADD", "CROSS_PRODUCT", "PROJECT", "REFLECT", "FACEFORWARD", "DOT_PRODUCT", "DISTANCE", "LENGTH", "NORMALIZE"),
    *("SINE", "COSINE", "TANGENT", "POWER"),
]
VECTORS = {0: "wide 0", 1: "wide 1", 2: "wide 2", "Scale": "wide 2.y"}

RANGE = {"Value": "wide 0.x", "From Min": "unit 0.x", "From Max": "positive 0.y", "To Min": "place 1.x", "To Max": "place 1.y"}
VECTOR_RANGE = {
    **{"Vector": "wide 0", "From_Min_FLOAT3": "unit 0", "From_Max_FLOAT3": "positive 0"},
    **{"To_Min_FLOAT3": "place 1", "To_Max_FLOAT3": "place 2"},
}


def _ranges(data_type: str, inputs: dict, steps: str) -> tuple[Case, ...]:
    """Map Range of one kind of data: each way between the ends, held to them or not."""
    made = []
    for kind in ("LINEAR", "STEPPED", "SMOOTHSTEP", "SMOOTHERSTEP"):
        driven = {**inputs, steps: "positive 2" if data_type == "FLOAT_VECTOR" else "positive 2.x"} if kind == "STEPPED" else inputs
        share = 0.004 if kind == "STEPPED" else 0.0
        for clamp in (True, False) if kind in ("LINEAR", "STEPPED") else (True,):
            name = f"{data_type}, {kind}{', clamped' if clamp else ''}"
            made.append(Case(name, {"data_type": data_type, "interpolation_type": kind, "clamp": clamp}, driven, steps=share))
    return tuple(made)


NODES = {
    "ShaderNodeMath": Node(
        "Math",
        FAMILY,
        cases=(
            *modes("operation", PLAIN, inputs=OPERANDS, tolerance=WHOLE),
            *modes("operation", STEPPED, inputs=NEAR, steps=0.004),
            *modes("operation", SMOOTH, inputs=OPERANDS),
            Case("ADD, clamped", {"operation": "ADD", "use_clamp": True}, OPERANDS, tolerance=WHOLE),
        ),
    ),
    "ShaderNodeVectorMath": Node(
        "Vector Math",
        FAMILY,
        cases=(
            *modes("operation", VECTOR_PLAIN, inputs=VECTORS, tolerance=WHOLE),
            *modes("operation", VECTOR_STEPPED, inputs={0: "place 0", 1: "place 1", 2: "place 2"}, steps=0.012),
            *modes("operation", VECTOR_SMOOTH, inputs=VECTORS),
            # Total reflection begins at a step.
            Case("REFRACT", {"operation": "REFRACT"}, VECTORS, steps=0.004),
        ),
    ),
    "ShaderNodeClamp": Node(
        "Clamp", FAMILY, cases=modes("clamp_type", ["MINMAX", "RANGE"], inputs=OPERANDS, tolerance=WHOLE)
    ),
    "ShaderNodeMapRange": Node(
        "Map Range", FAMILY, cases=(*_ranges("FLOAT", RANGE, "Steps"), *_ranges("FLOAT_VECTOR", VECTOR_RANGE, "Steps_FLOAT3"))
    ),
    "ShaderNodeFloatCurve": Node(
        "Float Curve",
        FAMILY,
        cases=(
            Case("held", {}, {"Value": "ramp 0.x", "Factor": "unit 0.x"}, prepare="curves"),
            Case("extrapolated", {}, {"Value": "wide 0.x"}, prepare="curves_beyond"),
        ),
    ),
    "ShaderNodeSeparateXYZ": Node("Separate XYZ", FAMILY, cases=(Case("all", {}, {0: "wide 0"}, tolerance=WHOLE),)),
    "ShaderNodeCombineXYZ": Node(
        "Combine XYZ", FAMILY, cases=(Case("all", {}, {0: "wide 0.x", 1: "wide 1.y", 2: "wide 2.z"}, tolerance=WHOLE),)
    ),
}

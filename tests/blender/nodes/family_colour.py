"""Colours: mixing, ramps, curves, spectra, and what takes colours apart and puts them together."""

from .case import WHOLE, Case, Node, modes

FAMILY = "Color"
BLENDS = [
    *("MIX", "DARKEN", "MULTIPLY", "BURN", "LIGHTEN", "SCREEN", "DODGE", "ADD", "OVERLAY", "SOFT_LIGHT", "LINEAR_LIGHT", "DIFFERENCE"),
    *("EXCLUSION", "SUBTRACT", "DIVIDE", "HUE", "SATURATION", "COLOR", "VALUE"),
]
MIXED = {"Factor_Float": "ramp 0.x", "A_Color": "colour 0", "B_Color": "colour 1"}
OLD_MIXED = {"Fac": "unit 0.x", "Color1": "colour 0", "Color2": "colour 1"}
RAMPS = ["LINEAR", "CONSTANT", "EASE", "CARDINAL", "B_SPLINE"]
HUES = ["NEAR", "FAR", "CW", "CCW"]


def _ramps() -> tuple[Case, ...]:
    """Color Ramp: ways between the stops, and around the circle of hues."""
    rest = {"inputs": {"Fac": "ramp 0.x"}, "prepare": "ramp"}
    straight = [Case(kind, {"color_ramp.interpolation": kind}, steps=0.02 if kind == "CONSTANT" else 0.0, **rest) for kind in RAMPS]
    around = [
        Case(f"{space}, {way}", {"color_ramp.color_mode": space, "color_ramp.hue_interpolation": way}, **rest)
        for space in ("HSV", "HSL")
        for way in HUES
    ]
    return (*straight, *around)


NODES = {
    "ShaderNodeMix": Node(
        "Mix",
        FAMILY,
        cases=(
            Case("FLOAT", {"data_type": "FLOAT"}, {"Factor_Float": "ramp 0.x", "A_Float": "place 0.x", "B_Float": "place 1.x"}),
            Case(
                "FLOAT, factor not clamped",
                {"data_type": "FLOAT", "clamp_factor": False},
                {"Factor_Float": "ramp 0.x", "A_Float": "place 0.x", "B_Float": "place 1.x"},
            ),
            Case("VECTOR", {"data_type": "VECTOR"}, {"Factor_Float": "ramp 0.x", "A_Vector": "place 0", "B_Vector": "place 1"}),
            Case(
                "VECTOR, NON_UNIFORM",
                {"data_type": "VECTOR", "factor_mode": "NON_UNIFORM"},
                {"Factor_Vector": "ramp 0", "A_Vector": "place 0", "B_Vector": "place 1"},
            ),
            *modes("blend_type", BLENDS, fields={"data_type": "RGBA"}, inputs=MIXED, outputs=("Result_Color",)),
            Case("ADD, clamped", {"data_type": "RGBA", "blend_type": "ADD", "clamp_result": True}, MIXED, ("Result_Color",)),
            Case(
                "OVERLAY, factor not clamped",
                {"data_type": "RGBA", "blend_type": "OVERLAY", "clamp_factor": False},
                MIXED,
                ("Result_Color",),
            ),
        ),
    ),
    "ShaderNodeMixRGB": Node(
        "Mix (Legacy)",
        FAMILY,
        cases=(
            *modes("blend_type", BLENDS, inputs=OLD_MIXED),
            Case("ADD, clamped", {"blend_type": "ADD", "use_clamp": True}, OLD_MIXED),
        ),
    ),
    "ShaderNodeValToRGB": Node("Color Ramp", FAMILY, cases=_ramps()),
    "ShaderNodeRGBCurve": Node(
        "RGB Curves",
        FAMILY,
        cases=(
            Case("held", {}, {"Color": "ramp 0", "Fac": "unit 0.x"}, prepare="curves"),
            Case("extrapolated", {}, {"Color": "colour 0"}, prepare="curves_beyond"),
        ),
    ),
    "ShaderNodeVectorCurve": Node(
        "Vector Curves",
        FAMILY,
        cases=(
            Case("held", {}, {"Vector": "place 0", "Fac": "unit 0.x"}, prepare="curves"),
            Case("extrapolated", {}, {"Vector": "wide 0"}, prepare="curves_beyond"),
        ),
    ),
    "ShaderNodeInvert": Node("Invert Color", FAMILY, cases=(Case("all", {}, {"Fac": "ramp 0.x", "Color": "colour 0"}),)),
    "ShaderNodeGamma": Node("Gamma", FAMILY, cases=(Case("all", {}, {"Color": "colour 0", "Gamma": "positive 0.x"}),)),
    "ShaderNodeBrightContrast": Node(
        "Brightness/Contrast", FAMILY, cases=(Case("all", {}, {0: "colour 0", 1: "place 0.x", 2: "place 1.x"}),)
    ),
    "ShaderNodeHueSaturation": Node(
        "Hue/Saturation/Value",
        FAMILY,
        cases=(
            Case(
                "all",
                {},
                {"Hue": "unit 0.x", "Saturation": "positive 0.x", "Value": "positive 0.y", "Fac": "unit 0.y", "Color": "colour 0"},
            ),
        ),
    ),
    "ShaderNodeRGBToBW": Node("RGB to BW", FAMILY, cases=(Case("all", {}, {0: "colour 0"}),)),
    "ShaderNodeSeparateColor": Node("Separate Color", FAMILY, cases=modes("mode", ["RGB", "HSV", "HSL"], inputs={0: "colour 0"})),
    "ShaderNodeCombineColor": Node(
        "Combine Color", FAMILY, cases=modes("mode", ["RGB", "HSV", "HSL"], inputs={0: "unit 0.x", 1: "unit 1.y", 2: "unit 2.z"})
    ),
    "ShaderNodeBlackbody": Node("Blackbody", FAMILY, cases=(Case("all", {}, {0: "kelvin 0.x"}), Case("constant", {}, {0: 3000.0}))),
    "ShaderNodeWavelength": Node("Wavelength", FAMILY, cases=(Case("all", {}, {0: "nanometres 0.x"}), Case("constant", {}, {0: 520.0}))),
    "ShaderNodeSeparateRGB": Node(
        "Separate RGB (Legacy)", FAMILY, cases=(Case("all", {}, {0: "colour 0"}, tolerance=WHOLE),), until=(4, 5)
    ),
    "ShaderNodeSeparateHSV": Node("Separate HSV (Legacy)", FAMILY, cases=(Case("all", {}, {0: "colour 0"}),), until=(4, 5)),
    "ShaderNodeCombineRGB": Node(
        "Combine RGB (Legacy)",
        FAMILY,
        cases=(Case("all", {}, {0: "unit 0.x", 1: "unit 1.y", 2: "unit 2.z"}, tolerance=WHOLE),),
        until=(4, 5),
    ),
    "ShaderNodeCombineHSV": Node(
        "Combine HSV (Legacy)", FAMILY, cases=(Case("all", {}, {0: "unit 0.x", 1: "unit 1.y", 2: "unit 2.z"}),), until=(4, 5)
    ),
}

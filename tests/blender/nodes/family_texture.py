"""Textures that read coordinates: images, and patterns without noise."""

from .case import WHOLE, Case, Node, modes

FAMILY = "Texture"
GRADIENTS = ["LINEAR", "QUADRATIC", "EASING", "DIAGONAL", "SPHERICAL", "QUADRATIC_SPHERE", "RADIAL"]
BRICKS = {"Color1": "colour 0", "Color2": "colour 1", "Mortar": "colour 2"}


def _images() -> tuple[Case, ...]:
    """Image Texture: each projection, each filter, each way to go on beyond the picture."""
    made = []
    for filtering in ("Linear", "Closest", "Cubic", "Smart"):
        for beyond in ("REPEAT", "EXTEND", "CLIP", "MIRROR"):
            steps = 0.01 if filtering == "Closest" or beyond == "CLIP" else 0.0
            fields = {"interpolation": filtering, "extension": beyond}
            made.append(Case(f"FLAT, {filtering}, {beyond}", fields, {0: "place 0"}, ("Color",), prepare="picture", steps=steps))
    for projection in ("SPHERE", "TUBE"):
        made.append(Case(f"{projection}, Linear, REPEAT", {"projection": projection}, {0: "unit 0"}, ("Color",), prepare="picture"))
    for blend in (0.0, 0.3):
        fields = {"projection": "BOX", "projection_blend": blend}
        sides = {0: "hit.TexCoord.Generated"}
        made.append(Case(f"BOX, blend {blend}", fields, sides, ("Color",), on_sphere=True, prepare="picture", steps=0.03))
    made.append(Case("sRGB bytes with alpha", {}, {0: "place 0"}, prepare="byte_picture"))
    made.append(Case("sRGB bytes", {}, {0: "place 0"}, ("Color",), prepare="opaque_picture"))
    made.append(Case("unlinked", {"interpolation": "Linear"}, {}, ("Color",), on_sphere=True, prepare="picture"))
    return tuple(made)


def _environments() -> tuple[Case, ...]:
    """Environment Texture: both projections, each filter."""
    return tuple(
        Case(
            f"{projection}, {filtering}",
            {"projection": projection, "interpolation": filtering},
            {0: "place 0"},
            prepare="picture",
            steps=0.01 if filtering == "Closest" else 0.002,
        )
        for projection in ("EQUIRECTANGULAR", "MIRROR_BALL")
        for filtering in ("Linear", "Closest", "Cubic", "Smart")
    )


def _skies() -> tuple[Case, ...]:
    """Sky Texture: each sky by generated coordinates and along the normals of a ball; the sun's disc where there is one."""
    since = {"SINGLE_SCATTERING": (5, 0), "MULTIPLE_SCATTERING": (5, 0)}
    kinds = ("NISHITA", *since, "PREETHAM", "HOSEK_WILKIE")
    atmospheres, along = kinds[:3], {0: "hit.NewGeometry.Normal"}

    def case(kind: str, name: str, inputs: dict, **disc) -> Case:
        version = {"since": since.get(kind, (4, 5)), "until": (4, 5) if kind == "NISHITA" else (9, 9)}
        shown = {"on_sphere": True, "stage": "near", "rounded": kind in atmospheres}
        return Case(f"{kind}{name}", {"sky_type": kind, **disc}, inputs, **shown, **version)

    def no_disc(kind: str) -> dict:
        return {"sun_disc": False} if kind in atmospheres else {}

    return (
        *(case(kind, "", {}, **no_disc(kind)) for kind in kinds),
        *(case(kind, ", along normals", along, **no_disc(kind)) for kind in kinds),
        *(case(kind, ", with the sun", along, sun_size=0.6, sun_elevation=0.9, sun_rotation=0.7, altitude=900.0) for kind in atmospheres),
    )


NODES = {
    "ShaderNodeTexImage": Node("Image Texture", FAMILY, cases=_images()),
    "ShaderNodeTexEnvironment": Node("Environment Texture", FAMILY, cases=_environments()),
    "ShaderNodeTexChecker": Node(
        "Checker Texture",
        FAMILY,
        cases=(
            Case("all", {}, {0: "place 0", 1: "colour 0", 2: "colour 1", 3: "positive 0.x"}, tolerance=WHOLE, steps=0.004),
            Case("unlinked", {}, {}, on_sphere=True, steps=0.01),
        ),
    ),
    "ShaderNodeTexGradient": Node(
        "Gradient Texture",
        FAMILY,
        cases=(
            *modes("gradient_type", GRADIENTS, inputs={0: "place 0"}),
            Case("SPHERICAL, near", {"gradient_type": "SPHERICAL"}, {0: "unit 0"}),
            Case("QUADRATIC_SPHERE, near", {"gradient_type": "QUADRATIC_SPHERE"}, {0: "unit 0"}),
            Case("LINEAR, mapped", {"texture_mapping.scale": (2.0, 3.0, 0.5), "texture_mapping.rotation": (0.1, 0.2, 0.3)}, {0: "unit 0"}),
            Case("LINEAR, unlinked", {}, {}, on_sphere=True),
        ),
    ),
    "ShaderNodeTexBrick": Node(
        "Brick Texture",
        FAMILY,
        cases=(
            Case("usual", {}, {0: "place 0", **BRICKS}, steps=0.004),
            Case(
                "all driven",
                {"offset": 0.3, "offset_frequency": 3, "squash": 1.7, "squash_frequency": 2},
                {
                    **{0: "place 0", **BRICKS, "Scale": "positive 0.x", "Mortar Size": "unit 1.x", "Mortar Smooth": "unit 1.y"},
                    **{"Bias": "unit 1.z", "Brick Width": "positive 1.x", "Row Height": "positive 1.y"},
                },
                steps=0.01,
            ),
            Case("unlinked", {}, {"Scale": 2.0, "Mortar Size": 0.1, "Mortar Smooth": 0.8}, on_sphere=True, steps=0.03),
        ),
    ),
    "ShaderNodeTexMagic": Node(
        "Magic Texture",
        FAMILY,
        cases=(
            *(
                Case(f"depth {depth}", {"turbulence_depth": depth}, {0: "place 0", 1: "positive 0.x"})
                for depth in range(11)
            ),
            Case("depth 2, driven", {}, {0: "place 0", 1: "positive 0.x", 2: "positive 1.x"}),
            Case("unlinked", {}, {"Scale": 1.5}, on_sphere=True),
        ),
    ),
    "ShaderNodeTexSky": Node(
        "Sky Texture",
        FAMILY,
        cases=_skies(),
        reason="Blender 4's atmosphere is within 1.5 %",
        remark="atmospheres, which Cycles reckons in single precision from the middle of the Earth, are held by middles of blocks",
    ),
    "ShaderNodeTexIES": Node(
        "IES Texture",
        FAMILY,
        cases=(
            Case("on a surface", {}, {0: "place 0"}, prepare="distribution"),
            Case("unlinked", {}, {}, on_sphere=True, prepare="distribution"),
        ),
    ),
    "ShaderNodeTexPointDensity": Node("Point Density", FAMILY, cases=(Case("without data", {}, {0: "place 0"}),), until=(4, 5)),
    "ShaderNodeRadialTiling": Node(
        "Radial Tiling",
        FAMILY,
        cases=tuple(
            Case(name, {"normalize": name == "normalized"}, {0: "place 0", 1: "sides 0.x", 2: "unit 0.x"}, steps=0.01)
            for name in ("normalized", "not normalized")
        ),
        since=(5, 0),
    ),
}

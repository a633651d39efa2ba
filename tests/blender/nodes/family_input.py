"""What is known of the hit, its object, the ray and the camera."""

from .case import Case, Node

FAMILY = "Input"
# Outputs of Light Path that a floor finds out which is half a mirror.
SEEN = (
    *("Is Camera Ray", "Is Diffuse Ray", "Is Glossy Ray", "Is Singular Ray", "Is Reflection Ray"),
    *("Ray Length", "Ray Depth", "Diffuse Depth", "Glossy Depth"),
)


def _everywhere(**rest) -> tuple[Case, ...]:
    """All outputs, on balls."""
    return (Case("all", on_sphere=True, **rest),)


def _attributes() -> tuple[Case, ...]:
    """Attribute: each domain, each type of data, and what is not there."""
    named = [("GEOMETRY", name) for name in ("paint", "dye", "arrow", "number", "whole", "UVMap", "absent", "")]
    named += [("OBJECT", "own"), ("OBJECT", "pass_index"), ("INSTANCER", "own"), ("VIEW_LAYER", "shared")]
    return tuple(
        Case(f"{kind}, {name or 'unnamed'}", {"attribute_type": kind, "attribute_name": name}, on_sphere=True, steps=0.02)
        for kind, name in named
    )


NODES = {
    "ShaderNodeNewGeometry": Node("Geometry", FAMILY, cases=_everywhere(steps=0.02)),
    "ShaderNodeTexCoord": Node(
        "Texture Coordinate",
        FAMILY,
        cases=(*_everywhere(), Case("of another object", {}, {}, ("Object",), on_sphere=True, prepare="other_object")),
    ),
    "ShaderNodeUVMap": Node(
        "UV Map", FAMILY, cases=(Case("the one that renders", on_sphere=True), Case("second", {"uv_map": "second"}, on_sphere=True))
    ),
    "ShaderNodeObjectInfo": Node("Object Info", FAMILY, cases=_everywhere()),
    "ShaderNodeAttribute": Node("Attribute", FAMILY, cases=_attributes()),
    "ShaderNodeVertexColor": Node(
        "Color Attribute",
        FAMILY,
        cases=(
            Case("paint", {"layer_name": "paint"}, on_sphere=True),
            Case("dye", {"layer_name": "dye"}, on_sphere=True, steps=0.02),
            Case("unnamed", {}, on_sphere=True),
        ),
    ),
    "ShaderNodeCameraData": Node("Camera Data", FAMILY, cases=_everywhere()),
    "ShaderNodeLightPath": Node(
        "Light Path",
        FAMILY,
        cases=(*_everywhere(), Case("seen in a mirror that scatters too", {}, {}, SEEN, stage="mirror", tolerance=0.04, steps=0.07)),
    ),
    "ShaderNodeFresnel": Node(
        "Fresnel",
        FAMILY,
        cases=(
            Case("all", {}, {"IOR": 1.45}, on_sphere=True),
            Case("IOR below 1", {}, {"IOR": 0.7}, on_sphere=True),
            Case("own normal", {}, {"IOR": 1.45, "Normal": "hit.NewGeometry.True Normal"}, on_sphere=True, steps=0.02),
        ),
    ),
    "ShaderNodeLayerWeight": Node(
        "Layer Weight",
        FAMILY,
        cases=(
            *(Case(f"blend {blend}", {}, {"Blend": blend}, on_sphere=True) for blend in (0.0, 0.3, 0.5, 0.8, 1.0)),
            Case("own normal", {}, {"Normal": "hit.NewGeometry.True Normal"}, on_sphere=True, steps=0.02),
        ),
    ),
    "ShaderNodeValue": Node("Value", FAMILY, cases=(Case("all", prepare="value_value"),)),
    "ShaderNodeRGB": Node("Color", FAMILY, cases=(Case("all", prepare="colour_value"),)),
    "ShaderNodeWireframe": Node(
        "Wireframe",
        FAMILY,
        cases=(
            Case("in metres", {}, {"Size": 0.03}, on_sphere=True, steps=0.03),
            Case("in pixels", {"use_pixel_size": True}, {"Size": 1.5}, on_sphere=True, steps=0.03),
        ),
    ),
    "ShaderNodeBevel": Node(
        "Bevel",
        FAMILY,
        remark="as Cycles' Tabulated Sobol spreads rays; means of 4 are up to 10 % apart with its blue noise; of faces that coincide one "
        "counts",
        cases=tuple(
            Case(f"{samples} samples", {"samples": samples}, {"Radius": 0.15}, stage="floor", tolerance=0.04, steps=0.07)
            for samples in (4, 16)
        ),
    ),
    "ShaderNodeAmbientOcclusion": Node(
        "Ambient Occlusion",
        FAMILY,
        cases=tuple(
            Case(name, fields, {"Distance": far, "Color": (0.9, 0.6, 0.3)}, stage="floor", tolerance=0.04, steps=0.07)
            for name, far, fields in (
                ("outside", 0.6, {}),
                ("inside", 0.1, {"inside": True}),
                ("only local", 0.6, {"only_local": True}),
            )
        ),
    ),
    "ShaderNodeRaycast": Node(
        "Raycast",
        FAMILY,
        since=(5, 2),
        cases=tuple(
            Case(
                name,
                fields,
                {"Position": "hit.NewGeometry.Position", "Direction": "hit.NewGeometry.Normal", "Length": 0.6},
                ("Is Hit", "Self Hit", "Hit Distance", "Hit Position", "Hit Normal"),
                stage="floor",
                tolerance=0.04,
                steps=0.07,
            )
            for name, fields in (("all objects", {}), ("only local", {"only_local": True}))
        ),
    ),
    "ShaderNodeParticleInfo": Node(
        "Particle Info", FAMILY, cases=(*_everywhere(), Case("of particles", stage="particles", steps=0.02))
    ),
    "ShaderNodeHairInfo": Node("Curves Info", FAMILY, cases=_everywhere()),
    "ShaderNodePointInfo": Node("Point Info", FAMILY, cases=_everywhere()),
    "ShaderNodeVolumeInfo": Node("Volume Info", FAMILY, cases=_everywhere()),
}

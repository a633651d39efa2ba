"""Closures: a ball of each, lit by an even sky and a sun, block by block. Volumes: a ball full of it."""

from .case import CLOSURE, Case, Node

SURFACE, VOLUME = "Shader", "Volume"
COLOUR = (0.8, 0.45, 0.2)


def _lit(name: str, *cases: Case, family: str = SURFACE, **rest) -> Node:
    return Node(name, family, CLOSURE, cases or (_case("all", {"Color": COLOUR}),), **rest)


def _case(mode: str, inputs: dict, seen: str = "shader", **rest) -> Case:
    """A case by the means of 16 blocks: one of them may be beyond."""
    stage = rest.pop("stage", "filled" if seen == "volume" else "lit")
    return Case(mode, rest.pop("fields", {}), inputs, (0,), stage=stage, seen=seen, tolerance=0.04, steps=0.07, **rest)


def _distributions(names: list[str], inputs: dict, field: str = "distribution", **rest) -> tuple[Case, ...]:
    return tuple(_case(name, inputs, fields={field: name}, **rest) for name in names)


ROUGH = {"Color": COLOUR, "Roughness": 0.35}
METAL = {"Base Color": COLOUR, "Edge Tint": (0.9, 0.7, 0.5), "Roughness": 0.3}
ON_MESHES = "on meshes, whose fibres lie along an edge of each triangle; strands are told of in [Hair](hair.md)"
# Phase functions with their numbers. Draine's are where Cycles' own draws in single precision keep their digits.
PHASES = {
    "HENYEY_GREENSTEIN": {"Anisotropy": 0.4},
    "FOURNIER_FORAND": {"IOR": 1.2, "Backscatter": 0.1},
    "DRAINE": {"Anisotropy": 0.5, "Alpha": 2.0},
    "RAYLEIGH": {},
    "MIE": {"Diameter": 8.0},
}
SCATTER = {"Scatter Coefficients": (1.2, 0.7, 0.3)}

NODES = {
    "ShaderNodeBsdfDiffuse": _lit("Diffuse BSDF", _case("smooth", {"Color": COLOUR}), _case("rough", {"Color": COLOUR, "Roughness": 0.6})),
    "ShaderNodeBsdfAnisotropic": _lit(
        "Glossy BSDF",
        *_distributions(["GGX", "BECKMANN", "ASHIKHMIN_SHIRLEY", "MULTI_GGX"], ROUGH),
        _case("GGX, anisotropic", {**ROUGH, "Anisotropy": 0.6, "Rotation": 0.1}, fields={"distribution": "GGX"}),
    ),
    "ShaderNodeBsdfGlass": _lit("Glass BSDF", *_distributions(["GGX", "BECKMANN", "MULTI_GGX"], {**ROUGH, "IOR": 1.45})),
    "ShaderNodeBsdfRefraction": _lit("Refraction BSDF", *_distributions(["GGX", "BECKMANN"], {**ROUGH, "IOR": 1.3})),
    "ShaderNodeBsdfMetallic": _lit(
        "Metallic BSDF",
        *_distributions(["GGX", "BECKMANN", "MULTI_GGX"], METAL),
        _case("PHYSICAL_CONDUCTOR", {"Roughness": 0.3}, fields={"fresnel_type": "PHYSICAL_CONDUCTOR"}),
    ),
    "ShaderNodeBsdfPrincipled": _lit(
        "Principled BSDF",
        _case("usual", {"Base Color": COLOUR}),
        _case("metal", {"Base Color": COLOUR, "Metallic": 1.0, "Roughness": 0.25, "Anisotropic": 0.4}),
        _case("glass", {"Base Color": COLOUR, "Transmission Weight": 1.0, "Roughness": 0.1}),
        _case("coat and sheen", {"Base Color": COLOUR, "Coat Weight": 0.7, "Coat Tint": (0.9, 0.8, 0.6), "Sheen Weight": 0.6}),
        _case("skin", {"Base Color": COLOUR, "Subsurface Weight": 1.0, "Subsurface Scale": 0.1}),
        _case("film", {"Base Color": COLOUR, "Metallic": 1.0, "Roughness": 0.3, "Thin Film Thickness": 400.0}),
    ),
    "ShaderNodeBsdfSheen": _lit("Sheen BSDF", *_distributions(["ASHIKHMIN", "MICROFIBER"], {"Color": COLOUR, "Roughness": 0.4})),
    "ShaderNodeBsdfTranslucent": _lit("Translucent BSDF"),
    "ShaderNodeBsdfTransparent": _lit("Transparent BSDF"),
    "ShaderNodeBsdfToon": _lit(
        "Toon BSDF",
        *_distributions(["DIFFUSE", "GLOSSY"], {"Color": COLOUR}, "component"),
        _case("DIFFUSE, smooth", {"Color": COLOUR, "Size": 0.3, "Smooth": 0.4}, fields={"component": "DIFFUSE"}),
        _case("GLOSSY, smooth", {"Color": COLOUR, "Size": 0.2, "Smooth": 0.5}, fields={"component": "GLOSSY"}),
    ),
    "ShaderNodeBsdfHair": _lit(
        "Hair BSDF",
        *_distributions(["Reflection", "Transmission"], {"Color": COLOUR}, "component", stage="found"),
        *(
            _case(f"{name}, narrow", {"Color": COLOUR, "RoughnessU": 0.2, "RoughnessV": 0.3}, fields={"component": name}, stage="found")
            for name in ("Reflection", "Transmission")
        ),
        remark=ON_MESHES,
    ),
    "ShaderNodeBsdfHairPrincipled": _lit(
        "Principled Hair BSDF", *_distributions(["CHIANG", "HUANG"], {"Color": COLOUR}, "model", stage="found"), remark=ON_MESHES
    ),
    "ShaderNodeBsdfRayPortal": _lit(
        "Ray Portal BSDF",
        _case("straight on", {"Color": COLOUR}),
        _case("another way", {"Color": COLOUR, "Direction": (1.0, 0.0, 0.2)}),
        _case("to a place", {"Color": COLOUR}, prepare="portal"),
        _case("into the neighbour", {"Color": COLOUR}, prepare="portal_beside"),
    ),
    "ShaderNodeSubsurfaceScattering": _lit(
        "Subsurface Scattering", *_distributions(["RANDOM_WALK", "RANDOM_WALK_SKIN", "BURLEY"], {"Color": COLOUR, "Scale": 0.1}, "falloff")
    ),
    "ShaderNodeEmission": _lit("Emission", _case("all", {"Color": COLOUR, "Strength": 0.7})),
    "ShaderNodeBackground": _lit("Background", _case("on a surface", {"Color": COLOUR, "Strength": 0.7})),
    "ShaderNodeHoldout": _lit("Holdout", _case("all", {})),
    "ShaderNodeMixShader": _lit("Mix Shader", _case("all", {"Fac": 0.3}, prepare="two_shaders")),
    "ShaderNodeAddShader": _lit("Add Shader", _case("all", {}, prepare="two_shaders")),
    "ShaderNodeVolumeAbsorption": _lit("Volume Absorption", _case("all", {"Color": COLOUR, "Density": 1.5}, "volume"), family=VOLUME),
    "ShaderNodeVolumeScatter": _lit(
        "Volume Scatter",
        *(_case(each, {"Color": COLOUR, "Density": 1.5, **numbers}, "volume", fields={"phase": each}) for each, numbers in PHASES.items()),
        family=VOLUME,
    ),
    "ShaderNodeVolumePrincipled": _lit("Principled Volume", _case("all", {"Color": COLOUR, "Density": 1.5}, "volume"), family=VOLUME),
    "ShaderNodeVolumeCoefficients": _lit(
        "Volume Coefficients",
        *(_case(each, {**SCATTER, **numbers}, "volume", fields={"phase": each}) for each, numbers in PHASES.items()),
        family=VOLUME,
    ),
}

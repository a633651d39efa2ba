"""Materials by chance: closures and their mixtures, whose values come from patterns, ramps and blends of colours."""

import random

import bpy
from stage import blank, diffuse, node, socket, surface

COORDINATES = ("Generated", "Object", "UV", "Normal", "Camera", "Reflection")
# Patterns, and the choices of each that are drawn from.
PATTERNS = {
    "Noise": {"noise_type": ("FBM", "MULTIFRACTAL", "RIDGED_MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "HETERO_TERRAIN")},
    "Voronoi": {
        "feature": ("F1", "F2", "SMOOTH_F1", "DISTANCE_TO_EDGE", "N_SPHERE_RADIUS"),
        "distance": ("EUCLIDEAN", "MANHATTAN", "CHEBYCHEV", "MINKOWSKI"),
    },
    "Wave": {"wave_type": ("BANDS", "RINGS"), "bands_direction": ("X", "Y", "Z", "DIAGONAL"), "wave_profile": ("SIN", "SAW", "TRI")},
    "Checker": {},
    "Gradient": {"gradient_type": ("LINEAR", "QUADRATIC", "EASING", "DIAGONAL", "SPHERICAL", "QUADRATIC_SPHERE", "RADIAL")},
    "Magic": {"turbulence_depth": (0, 1, 2, 3, 4)},
    "Brick": {},
    "Gabor": {},
}
BLENDS = ("MIX", "MULTIPLY", "OVERLAY", "SCREEN", "DIFFERENCE", "DARKEN", "LIGHTEN", "COLOR", "HUE", "SOFT_LIGHT", "DODGE", "BURN", "VALUE")
CLOSURES = ("BsdfDiffuse", "BsdfAnisotropic", "BsdfGlass", "BsdfMetallic", "BsdfSheen", "BsdfRefraction", "Emission", "BsdfToon")
# Weights of the Principled BSDF, how often they are asked for, and up to what.
WEIGHTS = {
    "Metallic": (0.3, 1.0),
    "Diffuse Roughness": (0.3, 1.0),
    "Specular IOR Level": (0.4, 1.0),
    "Anisotropic": (0.25, 1.0),
    "Anisotropic Rotation": (0.25, 1.0),
    "Coat Weight": (0.25, 1.0),
    "Sheen Weight": (0.25, 1.0),
    "Transmission Weight": (0.2, 1.0),
    "Subsurface Weight": (0.15, 1.0),
    "Emission Strength": (0.1, 0.5),
}
TINTS = {"Base Color": 0.02, "Coat Tint": 0.3, "Sheen Tint": 0.02, "Specular Tint": 0.5, "Emission Color": 0.02}


def colour(chance: random.Random, low: float = 0.02) -> tuple[float, float, float]:
    """Neither black nor white."""
    return (chance.uniform(low, 0.9), chance.uniform(low, 0.9), chance.uniform(low, 0.9))


def diffuse_or_made(chance: random.Random) -> bpy.types.Material:
    """What lies under the rest: plain more often than not."""
    return made_material(chance) if chance.random() < 0.3 else diffuse(tuple(chance.uniform(0.3, 0.7) for _ in range(3)))


def made_material(chance: random.Random) -> bpy.types.Material:
    """A material of up to four closures."""
    made, tree = blank("Made")
    surface(tree, shader(chance, tree, 0))
    return made


def shader(chance: random.Random, tree: bpy.types.NodeTree, depth: int) -> bpy.types.Node:
    """A closure, or a mixture of two."""
    kind = chance.random()
    if depth < 2 and kind < 0.25:
        mix = node(tree, "ShaderNodeMixShader")
        for end in mix.inputs[1:]:
            tree.links.new(shader(chance, tree, depth + 1).outputs[0], end)
        share(chance, tree, mix.inputs[0])
        return mix
    made = principled(chance, tree) if kind < 0.65 else closure(chance, tree)
    if chance.random() < 0.25 and "Normal" in made.inputs:
        bump = node(tree, "ShaderNodeBump", Strength=chance.uniform(0.1, 0.6), Distance=chance.uniform(0.02, 0.1))
        tree.links.new(scalar(chance, tree, 0.0, 1.0), bump.inputs["Height"])
        tree.links.new(bump.outputs[0], made.inputs["Normal"])
    return made


def share(chance: random.Random, tree: bpy.types.NodeTree, end: bpy.types.NodeSocket) -> None:
    """What a mixture goes by."""
    kind = chance.choice(["constant", "Fresnel", "Facing", "pattern", "Backfacing"])
    if kind == "constant":
        end.default_value = chance.random()
    elif kind == "pattern":
        tree.links.new(scalar(chance, tree, 0.0, 1.0), end)
    else:
        nodes = {"Fresnel": "LayerWeight", "Facing": "LayerWeight", "Backfacing": "NewGeometry"}
        tree.links.new(socket(node(tree, f"ShaderNode{nodes[kind]}").outputs, kind), end)


def principled(chance: random.Random, tree: bpy.types.NodeTree) -> bpy.types.Node:
    """The Principled BSDF with some of its lobes."""
    made = node(tree, "ShaderNodeBsdfPrincipled", distribution=chance.choice(["GGX", "MULTI_GGX"]))
    inputs = made.inputs
    for name, low in TINTS.items():
        inputs[name].default_value = (*colour(chance, low), 1.0)
    inputs["Roughness"].default_value, inputs["IOR"].default_value = chance.uniform(0.15, 1.0), chance.uniform(1.1, 2.0)
    inputs["Coat Roughness"].default_value, inputs["Subsurface Scale"].default_value = chance.uniform(0.1, 0.6), 0.1
    if chance.random() < 0.5:
        tree.links.new(hue(chance, tree), inputs["Base Color"])
    if chance.random() < 0.3:
        tree.links.new(scalar(chance, tree, 0.2, 0.9), inputs["Roughness"])
    for name, (often, most) in WEIGHTS.items():
        if chance.random() < often:
            inputs[name].default_value = chance.uniform(0.0, most)
            if chance.random() < 0.25:
                tree.links.new(scalar(chance, tree, 0.0, most), inputs[name])
    if chance.random() < 0.3:
        inputs["Thin Film Thickness"].default_value = chance.uniform(100.0, 900.0)
    return made


def closure(chance: random.Random, tree: bpy.types.NodeTree) -> bpy.types.Node:
    """A closure by itself."""
    made = node(tree, f"ShaderNode{chance.choice(CLOSURES)}")
    for end in made.inputs:
        if end.type == "RGBA":
            end.default_value = (*colour(chance), 1.0)
        elif end.type == "VALUE" and end.name in ("Roughness", "IOR", "Strength"):
            low, high = {"Roughness": (0.2, 0.9), "IOR": (1.1, 1.8), "Strength": (0.1, 0.6)}[end.name]
            end.default_value = chance.uniform(low, high)
    tinted = [end for end in made.inputs if end.name in ("Color", "Base Color")]
    if tinted and chance.random() < 0.5:
        tree.links.new(hue(chance, tree), tinted[0])
    return made


def pattern(chance: random.Random, tree: bpy.types.NodeTree, coordinates: tuple[str, ...]) -> bpy.types.NodeSocket:
    """A procedural texture over coordinates of some kind, mapped at times."""
    kind = chance.choice(sorted(PATTERNS))
    made = tree.nodes.new(f"ShaderNodeTex{kind}")
    for name, choices in PATTERNS[kind].items():
        setattr(made, name, chance.choice(choices))
    place = socket(tree.nodes.new("ShaderNodeTexCoord").outputs, chance.choice(coordinates))
    if chance.random() < 0.6:
        mapping = node(tree, "ShaderNodeMapping")
        tree.links.new(place, mapping.inputs["Vector"])
        mapping.inputs["Rotation"].default_value = [chance.uniform(-2.0, 2.0) for _ in range(3)]
        mapping.inputs["Scale"].default_value = [chance.uniform(0.4, 3.0) for _ in range(3)]
        place = mapping.outputs[0]
    tree.links.new(place, made.inputs["Vector"])
    if "Scale" in made.inputs:
        made.inputs["Scale"].default_value = chance.uniform(0.5, 3.0)
    for end in made.inputs:
        if end.type == "RGBA":
            end.default_value = (*colour(chance), 1.0)
    return chance.choice([end for end in made.outputs if end.enabled and end.type in ("RGBA", "VALUE")])


def scalar(chance: random.Random, tree: bpy.types.NodeTree, low: float, high: float) -> bpy.types.NodeSocket:
    """A pattern between two values."""
    made = node(tree, "ShaderNodeMapRange", clamp=True)
    made.interpolation_type = chance.choice(["LINEAR", "SMOOTHSTEP", "SMOOTHERSTEP"])
    tree.links.new(pattern(chance, tree, COORDINATES), made.inputs[0])
    made.inputs[3].default_value, made.inputs[4].default_value = low, high
    return made.outputs[0]


def hue(chance: random.Random, tree: bpy.types.NodeTree, coordinates: tuple[str, ...] = COORDINATES) -> bpy.types.NodeSocket:
    """A pattern as a colour from black to white: by a ramp, or blended with a colour."""
    value = pattern(chance, tree, coordinates)
    if chance.random() < 0.5:
        ramp = node(tree, "ShaderNodeValToRGB")
        ramp.color_ramp.interpolation = chance.choice(["LINEAR", "EASE", "CONSTANT", "B_SPLINE", "CARDINAL"])
        for element in ramp.color_ramp.elements:
            element.color = (*colour(chance), 1.0)
        tree.links.new(value, ramp.inputs[0])
        return ramp.outputs[0]
    blend = node(tree, "ShaderNodeMix", data_type="RGBA", blend_type=chance.choice(BLENDS), clamp_result=True)
    share_, first, second = (end for end in blend.inputs if end.enabled)
    share_.default_value, second.default_value = chance.random(), (*colour(chance), 1.0)
    tree.links.new(value, first)
    return next(end for end in blend.outputs if end.enabled)

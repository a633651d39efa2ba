"""Surfaces: the Principled BSDF lobe by lobe, each closure by itself, and their mixtures."""

import bpy
from stage import blank, diffuse, lit_floor, material, node, principled, resolution, rows_of_balls, socket, surface

RED, BLUE, GOLD, SKIN = (0.7, 0.15, 0.1), (0.1, 0.25, 0.7), (0.95, 0.72, 0.35), (0.85, 0.5, 0.4)


def shown(covers: list[bpy.types.Material], columns: int) -> None:
    """Balls on a lit floor."""
    resolution(64 * columns, 64 * -(-len(covers) // columns))
    lit_floor()
    rows_of_balls(covers, columns)


def principled_lobes() -> None:
    """What reflects: diffuse, rough diffuse, specular, metal, anisotropic metal, coat, sheen, emission."""
    shown(
        [
            principled(Base_Color=RED, Specular_IOR_Level=0.0),
            principled(Base_Color=RED, Specular_IOR_Level=0.0, Diffuse_Roughness=1.0),
            principled(Base_Color=(0.02, 0.02, 0.02), Roughness=0.3, IOR=1.8, Specular_Tint=(1.0, 0.7, 0.4)),
            principled(Base_Color=GOLD, Metallic=1.0, Roughness=0.35, Specular_Tint=(1.0, 0.95, 0.8)),
            principled(Base_Color=GOLD, Metallic=1.0, Roughness=0.4, Anisotropic=0.8, Anisotropic_Rotation=0.1),
            principled(Base_Color=BLUE, Specular_IOR_Level=0.0, Coat_Weight=1.0, Coat_Roughness=0.2, Coat_Tint=(1.0, 0.7, 0.5)),
            principled(Base_Color=BLUE, Specular_IOR_Level=0.0, Sheen_Weight=1.0, Sheen_Roughness=0.4, Sheen_Tint=(1.0, 0.8, 0.6)),
            principled(Base_Color=(0.0, 0.0, 0.0), Specular_IOR_Level=0.0, Emission_Color=(1.0, 0.5, 0.2), Emission_Strength=0.6),
        ],
        4,
    )


def principled_transmission() -> None:
    """What lets light through or bends its colour: glass, rough glass, subsurface, alpha, thin films on plastic, on metal and on glass."""
    shown(
        [
            principled(Base_Color=(0.7, 0.9, 1.0), Transmission_Weight=1.0, Roughness=0.05, IOR=1.45),
            principled(Base_Color=(1.0, 0.8, 0.6), Transmission_Weight=1.0, Roughness=0.5, IOR=1.3),
            principled(Base_Color=SKIN, Subsurface_Weight=1.0, Subsurface_Scale=0.1, Specular_IOR_Level=0.0),
            principled(Base_Color=RED, Alpha=0.4),
            principled(Base_Color=(0.05, 0.05, 0.05), Roughness=0.3, Thin_Film_Thickness=400.0, Thin_Film_IOR=1.4),
            principled(Base_Color=GOLD, Metallic=1.0, Roughness=0.3, Thin_Film_Thickness=300.0, Thin_Film_IOR=1.6),
            principled(Transmission_Weight=1.0, Roughness=0.3, Thin_Film_Thickness=350.0, Thin_Film_IOR=1.8),
            principled(Base_Color=RED, Roughness=0.7, Specular_IOR_Level=1.0),
        ],
        4,
    )


def principled_together() -> None:
    """All lobes at once, in three shares."""
    shown(
        [
            principled(
                Base_Color=colour,
                Metallic=0.3,
                Roughness=0.35 + 0.1 * number,
                Diffuse_Roughness=0.5,
                Anisotropic=0.5,
                Transmission_Weight=0.3,
                Subsurface_Weight=0.4,
                Subsurface_Scale=0.1,
                Coat_Weight=0.4,
                Coat_Roughness=0.2,
                Coat_Tint=(1.0, 0.8, 0.7),
                Sheen_Weight=0.3,
                Specular_Tint=(0.9, 0.95, 1.0),
                Emission_Color=(0.3, 0.5, 1.0),
                Emission_Strength=0.1,
                Alpha=1.0 - 0.15 * number,
            )
            for number, colour in enumerate((SKIN, RED, BLUE))
        ],
        3,
    )


def closures() -> None:
    """Nodes that reflect: Diffuse, Glossy in four distributions, Metallic of both kinds, Sheen of both kinds, Emission."""
    kinds = ("GGX", "MULTI_GGX", "BECKMANN", "ASHIKHMIN_SHIRLEY")
    glossy = [material("BsdfAnisotropic", distribution=kind, Color=(0.8, 0.8, 0.7), Roughness=0.4) for kind in kinds]
    shown(
        [
            material("BsdfDiffuse", Color=RED, Roughness=0.7),
            *glossy,
            material("BsdfMetallic", fresnel_type="F82", Base_Color=GOLD, Edge_Tint=(1.0, 0.9, 0.8), Roughness=0.3, Anisotropy=0.5),
            material("BsdfMetallic", fresnel_type="PHYSICAL_CONDUCTOR", IOR=(0.2, 0.7, 1.4), Extinction=(3.5, 2.5, 1.9), Roughness=0.3),
            material("BsdfSheen", distribution="MICROFIBER", Color=(0.8, 0.7, 0.9), Roughness=0.5),
            material("BsdfSheen", distribution="ASHIKHMIN", Color=(0.8, 0.7, 0.9), Roughness=0.5),
            material("Emission", Color=(1.0, 0.6, 0.3), Strength=0.5),
        ],
        5,
    )


def closures_through() -> None:
    """Nodes that let light through: Glass, Refraction, Transparent, Translucent, Subsurface Scattering."""
    shown(
        [
            material("BsdfGlass", Color=(0.95, 1.0, 0.95), Roughness=0.0, IOR=1.5),
            material("BsdfGlass", distribution="GGX", Color=(0.9, 0.9, 1.0), Roughness=0.4, IOR=1.5),
            material("BsdfRefraction", Color=(1.0, 0.9, 0.8), Roughness=0.2, IOR=1.3),
            material("BsdfRefraction", distribution="BECKMANN", Color=(0.9, 1.0, 1.0), Roughness=0.4, IOR=1.45),
            material("BsdfTransparent", Color=(0.8, 0.4, 0.3)),
            material("BsdfTranslucent", Color=(0.6, 0.7, 0.3)),
            material("SubsurfaceScattering", Color=SKIN, Scale=0.1),
            diffuse(BLUE),
        ],
        4,
    )


def mixed(kind: str, first: tuple[str, dict], second: tuple[str, dict], **share) -> bpy.types.Material:
    """Two shaders in a Mix or an Add Shader."""
    made, tree = blank(kind)
    both = node(tree, f"ShaderNode{kind}Shader", **share)
    for end, (shader, values) in zip(list(both.inputs)[-2:], (first, second), strict=True):
        tree.links.new(node(tree, f"ShaderNode{shader}", **values).outputs[0], end)
    surface(tree, both)
    return made


def mixtures() -> None:
    """Mix and Add: by constants, by Fresnel, by Layer Weight, and with transparency."""
    red, gloss = ("BsdfDiffuse", {"Color": RED}), ("BsdfAnisotropic", {"Color": (0.9, 0.9, 0.9), "Roughness": 0.3})
    shown(
        [
            mixed("Mix", red, gloss, Fac=0.3),
            mixed("Add", ("BsdfDiffuse", {"Color": BLUE}), ("BsdfAnisotropic", {"Color": (0.2, 0.2, 0.2), "Roughness": 0.4})),
            mixed("Mix", ("BsdfTransparent", {}), ("BsdfDiffuse", {"Color": BLUE}), Fac=0.6),
            mixed("Add", ("BsdfTranslucent", {"Color": (0.3, 0.4, 0.1)}), ("Emission", {"Color": (1.0, 0.5, 0.2), "Strength": 0.2})),
            by_angle("ShaderNodeFresnel", "Fac", red, gloss, IOR=1.6),
            by_angle("ShaderNodeLayerWeight", "Facing", red, ("BsdfDiffuse", {"Color": BLUE}), Blend=0.4),
        ],
        3,
    )


def by_angle(kind: str, output: str, first: tuple[str, dict], second: tuple[str, dict], **values) -> bpy.types.Material:
    """Two shaders mixed by a node that looks at the angle of view."""
    made = mixed("Mix", first, second)
    tree = made.node_tree
    mix = next(each for each in tree.nodes if each.bl_idname == "ShaderNodeMixShader")
    tree.links.new(socket(node(tree, kind, **values).outputs, output), mix.inputs[0])
    return made


def subsurface() -> None:
    """Each method, of the node and in the Principled BSDF, with radii that differ by channel, isotropic and not."""
    thick = {"Color": SKIN, "Scale": 0.15, "Radius": (1.0, 0.4, 0.2)}
    whole = {"Base_Color": SKIN, "Subsurface_Scale": 0.1, "Subsurface_Radius": (1.0, 0.4, 0.2)}
    shown(
        [
            material("SubsurfaceScattering", falloff="BURLEY", **thick),
            material("SubsurfaceScattering", falloff="RANDOM_WALK", Anisotropy=0.5, **thick),
            material("SubsurfaceScattering", falloff="RANDOM_WALK_SKIN", **thick),
            principled(subsurface_method="BURLEY", Subsurface_Weight=1.0, **whole),
            principled(subsurface_method="RANDOM_WALK", Subsurface_Weight=0.7, **whole),
            principled(subsurface_method="RANDOM_WALK_SKIN", Subsurface_Weight=1.0, **whole),
        ],
        3,
    )

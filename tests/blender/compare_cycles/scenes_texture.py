"""Image textures: coordinates, interpolation, colour spaces, and what they drive."""

import bpy
import numpy
from stage import ball, blank, box, camera, image, lamp, node, plane, resolution, soft_sky, surface

SIZE = 64


def waves() -> numpy.ndarray:
    """Two crossed waves and a ramp, soft enough that filters do not matter: (64, 64), 0 to 1."""
    v, u = numpy.meshgrid(*[(numpy.arange(SIZE) + 0.5) / SIZE] * 2, indexing="ij")
    return 0.5 + 0.25 * numpy.sin(4.0 * numpy.pi * u) * numpy.cos(2.0 * numpy.pi * v) + 0.25 * (u - v)


def colours() -> bpy.types.Image:
    """An 8-bit sRGB picture, its alpha 1."""
    ramp = waves()
    return image("Colours", numpy.stack([ramp, 0.9 - 0.6 * ramp, 0.3 + 0.5 * ramp**2], axis=-1))


def values() -> bpy.types.Image:
    """Floats that are no colours."""
    return image("Values", numpy.repeat(waves()[..., None], 3, axis=-1), is_float=True, colours="Non-Color")


def normals() -> bpy.types.Image:
    """A tangent-space normal map of dents."""
    ramp = waves()
    slope = numpy.stack(numpy.gradient(ramp)[::-1], axis=-1) * -6.0
    whole = numpy.concatenate([slope, numpy.ones((SIZE, SIZE, 1))], axis=-1)
    whole /= numpy.linalg.norm(whole, axis=-1, keepdims=True)
    return image("Normals", 0.5 + 0.5 * whole, is_float=True, colours="Non-Color")


def textured(picture, coordinates="UV", scale=(1.0, 1.0, 1.0), **fields):
    """A material's tree with an image in it: material, tree, image node."""
    made, tree = blank(f"{picture.name} {coordinates}")
    place = node(tree, "ShaderNodeTexCoord")
    turned = node(tree, "ShaderNodeMapping", Vector=place.outputs[coordinates], Rotation=(0.0, 0.0, 0.4), Scale=scale)
    return made, tree, node(tree, "ShaderNodeTexImage", image=picture, Vector=turned.outputs[0], **fields)


def principled(made, tree, **values) -> bpy.types.Material:
    """Ends a tree in a Principled BSDF."""
    surface(tree, node(tree, "ShaderNodeBsdfPrincipled", **values))
    return made


def coloured(*arguments, **keywords) -> bpy.types.Material:
    """The picture as base colour."""
    made, tree, picture = textured(*arguments, **keywords)
    return principled(made, tree, Base_Color=picture.outputs["Color"], Roughness=0.6)


def rough() -> bpy.types.Material:
    """Values as roughness of a metal, through a Map Range."""
    made, tree, picture = textured(values())
    level = node(tree, "ShaderNodeMapRange", Value=picture.outputs["Color"], To_Min=0.2, To_Max=0.7)
    return principled(made, tree, Base_Color=(0.9, 0.7, 0.5), Metallic=1.0, Roughness=level.outputs[0])


def dented() -> bpy.types.Material:
    """A normal map."""
    made, tree, picture = textured(normals(), scale=(2.0, 2.0, 1.0))
    bent = node(tree, "ShaderNodeNormalMap", Strength=0.8, Color=picture.outputs["Color"])
    return principled(made, tree, Base_Color=(0.2, 0.4, 0.7), Roughness=0.5, Normal=bent.outputs[0])


def bumpy() -> bpy.types.Material:
    """Values as heights."""
    made, tree, picture = textured(values(), scale=(2.0, 2.0, 1.0))
    bent = node(tree, "ShaderNodeBump", Strength=0.7, Distance=0.15, Height=picture.outputs["Color"])
    return principled(made, tree, Base_Color=(0.7, 0.3, 0.2), Roughness=0.5, Normal=bent.outputs[0])


def cut_out() -> bpy.types.Material:
    """Alpha from an image."""
    made, tree, picture = textured(values())
    edge = node(tree, "ShaderNodeMapRange", Value=picture.outputs["Color"], From_Min=0.4, From_Max=0.6)
    return principled(made, tree, Base_Color=(0.3, 0.6, 0.3), Alpha=edge.outputs[0])


def stage() -> None:
    """A view from above at a slant, two kinds of light."""
    soft_sky()
    lamp("AREA", 150.0, (-2.5, -3.0, 4.0), (0.65, -0.45, 0.0), shape="SQUARE", size=1.5)
    camera((0.0, -7.0, 5.0), (0.0, 0.0, 0.4), lens=58.0)


def textures() -> None:
    """By UV, Generated and Object coordinates, smooth and in steps, driving colour, roughness and alpha."""
    resolution(192, 128)
    plane(coloured(colours(), scale=(5.0, 5.0, 1.0), interpolation="Closest"), size=8.0)
    ball(coloured(colours()), 0.6, location=(-1.5, 0.5, 0.6))
    ball(coloured(colours(), "Generated", (2.0, 2.0, 2.0)), 0.6, location=(0.0, 0.6, 0.6))
    box(coloured(colours(), "Object", (0.7, 0.7, 0.7), extension="MIRROR"), location=(1.5, 0.5, 0.5))
    ball(rough(), 0.5, location=(-0.8, -0.9, 0.5))
    box(cut_out(), 0.9, location=(0.8, -0.9, 0.46), rotation=(0.0, 0.0, 0.5))
    stage()


def relief() -> None:
    """Normal maps and bumps on a ball and on a plane."""
    resolution(192, 128)
    plane(dented(), size=5.0)
    ball(bumpy(), 0.7, location=(-0.9, 0.0, 0.7))
    ball(dented(), 0.7, location=(0.9, 0.0, 0.7))
    stage()


def alpha() -> None:
    """Packed pictures with alpha: straight, premultiplied, without alpha, and clipped outside."""
    ramp = waves()
    edge = numpy.clip(3.0 * ramp - 1.0, 0.0, 1.0)
    straight = numpy.stack([ramp, 0.9 - 0.6 * ramp, 0.3 + 0.5 * ramp**2, edge], axis=-1)
    multiplied = straight * numpy.stack([edge, edge, edge, 0.0 * edge + 1.0], axis=-1)
    plane(None, size=14.0)
    soft_sky()
    lamp("AREA", 150.0, (-2.5, -3.0, 4.0), (0.65, -0.45, 0.0), shape="DISK", size=4.0)
    for number, (is_float, mode, extension) in enumerate(
        ((False, "STRAIGHT", "REPEAT"), (True, "PREMUL", "REPEAT"), (False, "CHANNEL_PACKED", "CLIP"), (False, "NONE", "CLIP"))
    ):
        shown = image(f"Alpha {number}", multiplied if mode == "PREMUL" else straight, is_float=is_float)
        shown.alpha_mode = mode
        made, tree, picture = textured(shown, scale=(1.5, 1.5, 1.0), extension=extension)
        shader = node(tree, "ShaderNodeBsdfPrincipled", Base_Color=picture.outputs["Color"], Alpha=picture.outputs["Alpha"], Roughness=0.6)
        surface(tree, shader)
        plane(made, size=1.3, location=(1.4 * number - 2.1, 0.0, 0.75), rotation=(1.3, 0.0, 0.0))
    camera((0.0, -8.0, 2.4), (0.0, 0.0, 0.6), lens=45.0)

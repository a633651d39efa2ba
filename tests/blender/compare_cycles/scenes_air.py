"""Volumes of worlds that vary: fog that thins out with height."""

import bpy
from scenes_media import scattered
from stage import ball, box, camera, diffuse, fill, lamp, new_world, node


def by_steps(size: float) -> None:
    """Has Cycles march through the air in steps of so many metres: the cells of its other way are 156 m wide, which tells little of low fog."""
    scene = bpy.context.scene
    if hasattr(scene.cycles, "volume_biased"):
        scene.cycles.volume_biased = True
    scene.world.cycles.volume_step_size = size


def maths(tree: bpy.types.NodeTree, operation: str, *values) -> bpy.types.NodeSocket:
    """The result of a Math node of sockets and numbers."""
    made = node(tree, "ShaderNodeMath", operation=operation)
    for end, value in zip(made.inputs, values, strict=False):
        fill(tree, end, value)
    return made.outputs[0]


def air(density) -> None:
    """A world without light, whose volume is as dense as a socket that `density` makes in its tree."""
    tree = new_world()
    shader = node(tree, "ShaderNodeVolumePrincipled", Color=(0.8, 0.85, 0.9), Anisotropy=0.3, Density=density(tree))
    node(tree, "ShaderNodeOutputWorld", Volume=shader.outputs[0])


def height(tree: bpy.types.NodeTree, place: bpy.types.NodeSocket) -> bpy.types.NodeSocket:
    """The third coordinate of a place."""
    return node(tree, "ShaderNodeSeparateXYZ", Vector=place).outputs["Z"]


def ramp(tree: bpy.types.NodeTree) -> bpy.types.NodeSocket:
    """Most at the floor, nothing from two metres on."""
    place = height(tree, node(tree, "ShaderNodeNewGeometry").outputs["Position"])
    made = node(tree, "ShaderNodeValToRGB", Fac=maths(tree, "MULTIPLY", place, 0.5))
    made.color_ramp.interpolation = "EASE"
    for element, value in zip(made.color_ramp.elements, (0.5, 0.0), strict=True):
        element.color = (value, value, value, 1.0)
    return made.outputs["Color"]


def height_fog_with_lamp() -> None:
    """A closed room, a lamp in it, and a camera in the fog."""
    scattered(2)
    box(diffuse((0.6, 0.5, 0.4)), location=(0.0, 0.0, 2.0), scale=(8.0, 10.0, 4.0))
    box(diffuse((0.4, 0.6, 0.3)), 0.8, location=(1.3, 0.9, 0.4), rotation=(0.0, 0.0, 0.4))
    ball(diffuse((0.2, 0.4, 0.7)), 0.4, location=(-0.9, 0.3, 0.4))
    lamp("POINT", 150.0, (-0.2, 0.8, 1.3), color=(1.0, 0.85, 0.7), shadow_soft_size=0.15, use_soft_falloff=True)
    camera((0.3, -4.4, 1.2), (0.0, 0.3, 1.0), lens=28.0)
    air(ramp)
    by_steps(0.1)

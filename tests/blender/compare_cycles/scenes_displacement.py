"""Displacement: surfaces that a material moves, moves and bends, and that are cut to pixels before."""

import bpy
from stage import ball, blank, camera, lit_floor, node, resolution, shape, surface


def moved(method: str, scale: float = 0.12) -> bpy.types.Material:
    """A grey surface that waves and noise move."""
    made, tree = blank("Moved")
    place = node(tree, "ShaderNodeTexCoord").outputs["Object"]
    noise = node(tree, "ShaderNodeTexNoise", Vector=place, Scale=3.0, Detail=1.0)
    wave = node(tree, "ShaderNodeTexWave", Vector=place, Scale=1.0, Distortion=2.0, Detail=0.0)
    sum_of_both = node(tree, "ShaderNodeMath", operation="ADD")
    tree.links.new(noise.outputs[0], sum_of_both.inputs[0])
    tree.links.new(wave.outputs["Fac"], sum_of_both.inputs[1])
    height = node(tree, "ShaderNodeDisplacement", Height=sum_of_both.outputs[0], Midlevel=0.5, Scale=scale)
    shader = node(tree, "ShaderNodeBsdfPrincipled", Base_Color=(0.6, 0.45, 0.35), Roughness=0.6)
    surface(tree, shader)
    end = next(each for each in tree.nodes if each.bl_idname == "ShaderNodeOutputMaterial")
    tree.links.new(height.outputs[0], end.inputs["Displacement"])
    made.displacement_method = method
    return made


def seen(cover: bpy.types.Material) -> None:
    """A ball, and a cube of many faces that is stretched, on a floor."""
    resolution(192, 128)
    lit_floor()
    ball(cover, 0.7, location=(-1.0, 0.0, 0.8))
    shape(bpy.ops.mesh.primitive_cube_add, cover, size=1.0, location=(1.0, 0.2, 0.75))
    block = bpy.context.object
    bpy.ops.object.mode_set(mode="EDIT")
    bpy.ops.mesh.subdivide(number_cuts=40)
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.shade_smooth()
    block.scale, block.rotation_euler = (1.2, 0.8, 1.0), (0.1, 0.2, 0.5)
    camera((0.0, -6.5, 3.2), (0.0, 0.0, 0.65), lens=58.0)


def displaced() -> None:
    """Displacement only."""
    seen(moved("DISPLACEMENT"))


def displaced_and_bent() -> None:
    """Displacement and bump, which Cycles bends in the object's space: the block is scaled unevenly."""
    seen(moved("BOTH", 0.06))


def displaced_adaptively() -> None:
    """Few faces, cut to pixels by the modifier, or before 5.0 by Cycles' setting of the object."""
    resolution(192, 128)
    lit_floor()
    scene, cover = bpy.context.scene, moved("DISPLACEMENT")
    shape(bpy.ops.mesh.primitive_uv_sphere_add, cover, smooth=True, segments=12, ring_count=8, radius=0.8, location=(-1.0, 0.0, 0.9))
    shape(bpy.ops.mesh.primitive_cube_add, cover, smooth=True, size=1.6, location=(1.0, 0.2, 0.9), rotation=(0.3, 0.4, 0.5))
    for thing in [each for each in scene.objects if each.type == "MESH" and each.data.materials[0] == cover]:
        modifier = thing.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = modifier.render_levels = 2
        if bpy.app.version >= (5, 0, 0):
            modifier.use_adaptive_subdivision, modifier.adaptive_pixel_size = True, 1.0
        else:
            scene.cycles.feature_set, thing.cycles.use_adaptive_subdivision, thing.cycles.dicing_rate = "EXPERIMENTAL", True, 1.0
    camera((0.0, -6.5, 3.2), (0.0, 0.0, 0.65), lens=58.0)

"""A scene of 280,000 triangles. Used inside Blender."""

import bpy
from scenes import diffuse

# Levels of subdivision that give a head 62,976 triangles.
LEVELS = 3
COLOURS = ((0.6, 0.2, 0.1), (0.2, 0.5, 0.2), (0.2, 0.3, 0.7), (0.7, 0.6, 0.2))


def add_heads() -> None:
    """Four heads on a floor, 280,704 triangles in all, an area light and a point light."""
    bpy.ops.mesh.primitive_grid_add(x_subdivisions=120, y_subdivisions=120, size=12.0)
    bpy.context.object.data.materials.append(diffuse("Floor", (0.5, 0.5, 0.5)))
    for number, colour in enumerate(COLOURS):
        bpy.ops.mesh.primitive_monkey_add(location=(2.0 * (number % 2) - 1.0, 2.0 * (number // 2) - 1.0, 1.0), size=1.5)
        head = bpy.context.object
        modifier = head.modifiers.new("Subdivision", "SUBSURF")
        modifier.levels = modifier.render_levels = LEVELS
        bpy.ops.object.modifier_apply(modifier=modifier.name)
        bpy.ops.object.shade_smooth()
        head.data.materials.append(diffuse(f"Head {number}", colour))
    bpy.ops.object.light_add(type="AREA", location=(3.0, -2.0, 5.0), rotation=(0.5, 0.5, 0.0))
    bpy.context.object.data.energy, bpy.context.object.data.size = 600.0, 2.0
    bpy.ops.object.light_add(type="POINT", location=(-3.0, -3.0, 2.5))
    bpy.context.object.data.energy = 200.0


def triangles() -> int:
    """Triangles of all objects."""
    meshes = [each.data for each in bpy.context.scene.objects if each.type == "MESH"]
    for mesh in meshes:
        mesh.calc_loop_triangles()
    return sum(len(mesh.loop_triangles) for mesh in meshes)

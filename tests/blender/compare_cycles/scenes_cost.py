"""Scenes whose cost is compared: a head of hair, a field in motion, and media."""

import math

import bpy
import numpy
from scenes_cost_media import cloud, fire, milk, street
from scenes_hair import MELANIN, strands
from stage import camera, diffuse, even_world, lamp, link, material, plane, resolution, shape

__all__ = ["cloud", "fire", "head", "head_elliptic", "milk", "street", "windmills"]

HAIRS = 100_000
MILLS = 2_000


def head() -> None:
    """A head of a hundred thousand strands of eight points, under two lamps."""
    resolution(384, 384)
    bpy.context.scene.cycles_curves.shape = "THICK"
    even_world(0.2)
    shape(bpy.ops.mesh.primitive_uv_sphere_add, diffuse((0.3, 0.2, 0.15)), smooth=True, radius=0.49, location=(0.0, 0.0, 0.5))
    made = strands(HAIRS).data
    thin = numpy.empty(8 * HAIRS, dtype=numpy.float32)
    made.attributes["radius"].data.foreach_get("value", thin)
    made.attributes["radius"].data.foreach_set("value", 0.15 * thin)
    made.materials.append(material("BsdfHairPrincipled", **MELANIN))
    lamp("AREA", 60.0, (1.5, -2.0, 2.5), (0.75, 0.0, 0.6), size=1.0)
    lamp("AREA", 20.0, (-2.0, -1.0, 1.0), (1.3, 0.0, -1.1), size=0.5)
    camera((0.0, -3.2, 1.2), (0.0, 0.0, 0.55), lens=70.0)


def head_elliptic() -> None:
    """The same with Huang's model."""
    head()
    made = bpy.data.objects["Strands"].data
    made.materials.clear()
    made.materials.append(material("BsdfHairPrincipled", model="HUANG", **MELANIN))


def windmills() -> None:
    """A field of wheels that turn while the shutter is open, instances of one mesh."""
    resolution(512, 256)
    scene = bpy.context.scene
    scene.render.use_motion_blur, scene.render.motion_blur_shutter = True, 0.5
    even_world(0.5)
    plane(diffuse((0.25, 0.3, 0.15)), size=200.0)
    lamp("SUN", 2.0, (0.0, 0.0, 10.0), (0.6, 0.3, 0.0), angle=0.01)
    mesh, random = wheel(), numpy.random.default_rng(7)
    for number, (x, y, turn, size) in enumerate(random.uniform((-20, 0, 0, 0.6), (20, 60, 6, 1.2), size=(MILLS, 4))):
        placed = link(f"Mill{number}", mesh, (x, y, 1.0), (math.pi / 2, turn, 0.0), (size,) * 3)
        for frame, angle in ((0, turn - 0.5), (2, turn + 0.5)):
            placed.rotation_euler.y = angle
            placed.keyframe_insert("rotation_euler", index=1, frame=frame)
    scene.frame_set(1)
    camera((0.0, -6.0, 3.0), (0.0, 10.0, 0.5), lens=35.0)


def wheel() -> bpy.types.Mesh:
    """A ring with spokes, some five thousand triangles."""
    bpy.ops.mesh.primitive_torus_add(major_radius=0.5, minor_radius=0.05, major_segments=96, minor_segments=16)
    made = bpy.context.object
    parts = [made]
    for number in range(6):
        bpy.ops.mesh.primitive_cylinder_add(vertices=32, radius=0.03, depth=1.0, rotation=(math.pi / 2, 0.0, number * math.pi / 6))
        parts.append(bpy.context.object)
    with bpy.context.temp_override(active_object=made, object=made, selected_editable_objects=parts):
        bpy.ops.object.join()
    mesh = made.data
    mesh.materials.append(diffuse((0.7, 0.3, 0.1)))
    bpy.data.objects.remove(made)
    return mesh

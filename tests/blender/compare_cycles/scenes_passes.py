"""What passes of data and cryptomattes tell apart: things with numbers and coordinates, some of them instances."""

from math import radians

import bpy
from stage import ball, box, camera, diffuse, even_world, lamp, link, plane, principled, resolution


def things() -> None:
    """A floor, a ball, a box under a parent, a ring, and two instances of a collection; each with numbers of its own."""
    resolution(192, 128)
    even_world(0.5)
    lamp("POINT", 90.0, (-1.6, -2.2, 3.6), shadow_soft_size=0.3)
    covers = [diffuse((0.5, 0.5, 0.5)), principled(Base_Color=(0.2, 0.4, 0.7)), diffuse((0.7, 0.4, 0.2))]
    for number, (cover, name) in enumerate(zip(covers, ("Stone", "Plastic", "Größe"), strict=True)):
        cover.name, cover.pass_index = name, 10 * number + 3
    floor = plane(covers[0], size=9.0)
    sphere = ball(covers[1], 0.6, location=(-1.2, 0.1, 0.6))
    block = box(covers[2], 0.9, location=(0.4, 0.5, 0.45), rotation=(0.0, 0.0, 0.4))
    bpy.ops.curve.primitive_bezier_circle_add(radius=0.5, location=(-0.2, -1.2, 0.15), rotation=(0.3, 0.2, 0.0))
    ring = bpy.context.object
    ring.data.bevel_depth = 0.1
    ring.data.materials.append(covers[1])
    block.parent = link("Parent", None)
    inside = bpy.data.collections.new("Inside")
    for thing in (ball(covers[2], 0.2, location=(0.0, 0.0, 0.6)), box(covers[0], 0.4, location=(0.0, 0.0, 0.2))):
        bpy.context.scene.collection.objects.unlink(thing)
        inside.objects.link(thing)
        thing.pass_index = 40 + len(inside.objects)
    for number in range(2):
        holder = link(f"Holder {number}", None, location=(1.1 + 0.7 * number, -0.9 + 0.9 * number, 0.0), rotation=(0.0, 0.0, radians(25 * number)))
        holder.instance_type, holder.instance_collection = "COLLECTION", inside
    for number, thing in enumerate((floor, sphere, block, ring)):
        thing.pass_index = number + 1
    camera((0.0, -6.5, 3.4), (0.1, -0.1, 0.4), lens=52.0)

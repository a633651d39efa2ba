"""Scenes by chance: shapes, materials, lamps, worlds and cameras drawn from what both engines know. The same seed makes the same scene."""

import math
import random

import bpy
from mathutils import Vector
from random_materials import diffuse_or_made, hue, made_material
from stage import empty, even_world, link, node, resolution

SIZE, THINGS = 96, 6
SOLIDS = {
    "cube": lambda ops: ops.primitive_cube_add(size=1.1),
    "ball": lambda ops: ops.primitive_ico_sphere_add(subdivisions=3, radius=0.7),
    "globe": lambda ops: ops.primitive_uv_sphere_add(radius=0.7),
    "torus": lambda ops: ops.primitive_torus_add(major_radius=0.5, minor_radius=0.22),
    "cone": lambda ops: ops.primitive_cone_add(radius1=0.6, depth=1.2),
    "cylinder": lambda ops: ops.primitive_cylinder_add(radius=0.5, depth=1.1),
    "monkey": lambda ops: ops.primitive_monkey_add(size=1.2),
    "grid": lambda ops: ops.primitive_grid_add(size=1.2),
}
BOUNCES = ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces")


def build(seed: int) -> None:
    """Makes the scene of a seed the open one."""
    empty()
    chance = random.Random(seed)
    resolution(SIZE, SIZE)
    bpy.ops.mesh.primitive_plane_add(size=14)
    bpy.context.object.data.materials.append(diffuse_or_made(chance))
    for number in range(THINGS):
        thing(chance, number)
    for _ in range(chance.randint(1, 3)):
        lamp(chance)
    world(chance)
    camera(chance)
    for name in BOUNCES:
        if chance.random() < 0.3:
            setattr(bpy.context.scene.cycles, name, chance.randint(0, 6))
    bpy.context.scene.render.film_transparent = chance.random() < 0.2


def thing(chance: random.Random, number: int) -> None:
    """One of six solids in two rows, turned, scaled, smooth or not, with modifiers at times."""
    SOLIDS[chance.choice(sorted(SOLIDS))](bpy.ops.mesh)
    made = bpy.context.object
    place = ((number % 3 - 1) * 1.6, (number // 3) * 1.6 - 0.8, 0.7)
    made.location = [value + chance.uniform(-0.2, 0.2) for value in place]
    made.rotation_euler = [chance.uniform(-3.0, 3.0) for _ in range(3)]
    even = chance.random() < 0.6
    made.scale = [chance.uniform(0.7, 1.05)] * 3 if even else [chance.uniform(0.7, 1.1) * chance.choice([1, 1, 1, -1]) for _ in range(3)]
    if chance.random() < 0.6:
        bpy.ops.object.shade_smooth()
    if chance.random() < 0.25:
        finer = made.modifiers.new("Finer", "SUBSURF")
        finer.levels = finer.render_levels = 2
    if chance.random() < 0.15:
        made.modifiers.new("Bevel", "BEVEL").width = 0.05
    slots = 2 if chance.random() < 0.15 else 1
    for _ in range(slots):
        made.data.materials.append(made_material(chance))
    for face, polygon in enumerate(made.data.polygons):
        polygon.material_index = face % slots
    if chance.random() < 0.15:
        setattr(made, f"visible_{chance.choice(['shadow', 'diffuse', 'glossy', 'camera', 'transmission'])}", False)


def lamp(chance: random.Random) -> None:
    """A lamp of any kind that looks at the middle."""
    kind = chance.choice(["POINT", "SUN", "SPOT", "AREA"])
    data = bpy.data.lights.new("Lamp", kind)
    data.color = [chance.uniform(0.4, 1.0) for _ in range(3)]
    data.energy = chance.uniform(0.5, 3.0) if kind == "SUN" else chance.uniform(100.0, 600.0)
    if kind == "SUN":
        data.angle = chance.uniform(0.0, 0.3)
    elif kind == "AREA":
        data.shape = chance.choice(["SQUARE", "RECTANGLE", "DISK", "ELLIPSE"])
        data.size, data.size_y = chance.uniform(0.3, 2.0), chance.uniform(0.3, 2.0)
        data.spread = chance.choice([math.pi, math.pi, 1.0, 2.0])
    else:
        data.shadow_soft_size = chance.choice([0.1, 0.4])
    if kind == "SPOT":
        data.spot_size, data.spot_blend = chance.uniform(0.6, 1.6), chance.random()
    place = Vector((chance.uniform(-3.0, 3.0), chance.uniform(-4.0, 3.0), chance.uniform(3.0, 5.0)))
    looking(link("Lamp", data, place), Vector((chance.uniform(-0.5, 0.5), chance.uniform(-0.5, 0.5), 0.3)))


def world(chance: random.Random) -> None:
    """An even world, one with a pattern, or a sky."""
    if chance.random() < 0.5:
        even_world(chance.uniform(0.05, 0.5))
        return
    tree = bpy.context.scene.world.node_tree
    tree.nodes.clear()
    background = node(tree, "ShaderNodeBackground", Strength=chance.uniform(0.1, 0.6))
    if chance.random() < 0.5:
        tree.links.new(hue(chance, tree, ("Generated", "Normal", "Object", "Camera")), background.inputs[0])
    else:
        sky = node(tree, "ShaderNodeTexSky")
        sky.sun_disc = chance.random() < 0.5
        background.inputs["Strength"].default_value = 0.1
        tree.links.new(sky.outputs[0], background.inputs[0])
    node(tree, "ShaderNodeOutputWorld", Surface=background.outputs[0])


def camera(chance: random.Random) -> None:
    """A camera before the solids: through a pinhole, a wide lens or in parallel."""
    data = bpy.data.cameras.new("Camera")
    seen_by = link("Camera", data, Vector((chance.uniform(-1.5, 1.5), -7.0, chance.uniform(2.5, 4.5))))
    looking(seen_by, Vector((0.0, 0.0, 0.5)))
    bpy.context.scene.camera = seen_by
    kind = chance.random()
    if kind < 0.15:
        data.type, data.ortho_scale = "ORTHO", 6.5
    elif kind < 0.3:
        data.dof.use_dof, data.dof.focus_distance, data.dof.aperture_fstop = True, 7.0, 0.4
    if chance.random() < 0.2:
        data.shift_x, data.shift_y = 0.1, -0.05


def looking(thing: bpy.types.Object, target: Vector) -> None:
    """Turns a lamp or a camera to a place."""
    thing.rotation_euler = (target - thing.location).to_track_quat("-Z", "Y").to_euler()

"""Scenes by chance: shapes, materials, lamps, worlds and cameras drawn from what both engines know. The same seed makes the same scene."""

import math
import random

import bpy
from mathutils import Vector
from random_materials import diffuse_or_made, hue, made_material
from stage import camera, empty, even_world, lamp, looking, new_world, node, resolution

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
        any_lamp(chance)
    any_world(chance)
    any_camera(chance)
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


def any_lamp(chance: random.Random) -> None:
    """A lamp of any kind that looks at the middle."""
    kind = chance.choice(["POINT", "SUN", "SPOT", "AREA"])
    fields = {"color": [chance.uniform(0.4, 1.0) for _ in range(3)]}
    energy = chance.uniform(0.5, 3.0) if kind == "SUN" else chance.uniform(100.0, 600.0)
    if kind == "SUN":
        fields["angle"] = chance.uniform(0.0, 0.3)
    elif kind == "AREA":
        fields["shape"] = chance.choice(["SQUARE", "RECTANGLE", "DISK", "ELLIPSE"])
        fields["size"], fields["size_y"] = chance.uniform(0.3, 2.0), chance.uniform(0.3, 2.0)
        fields["spread"] = chance.choice([math.pi, math.pi, 1.0, 2.0])
    else:
        fields["shadow_soft_size"] = chance.choice([0.1, 0.4])
    if kind == "SPOT":
        fields["spot_size"], fields["spot_blend"] = chance.uniform(0.6, 1.6), chance.random()
    place = Vector((chance.uniform(-3.0, 3.0), chance.uniform(-4.0, 3.0), chance.uniform(3.0, 5.0)))
    target = Vector((chance.uniform(-0.5, 0.5), chance.uniform(-0.5, 0.5), 0.3))
    lamp(kind, energy, place, looking(place, target), **fields)


def any_world(chance: random.Random) -> None:
    """An even world, one with a pattern, or a sky."""
    if chance.random() < 0.5:
        even_world(chance.uniform(0.05, 0.5))
        return
    tree = new_world()
    background = node(tree, "ShaderNodeBackground", Strength=chance.uniform(0.1, 0.6))
    if chance.random() < 0.5:
        tree.links.new(hue(chance, tree, ("Generated", "Normal", "Object", "Camera")), background.inputs[0])
    else:
        sky = node(tree, "ShaderNodeTexSky", sun_disc=chance.random() < 0.5)
        background.inputs["Strength"].default_value = 0.1
        tree.links.new(sky.outputs[0], background.inputs[0])
    node(tree, "ShaderNodeOutputWorld", Surface=background.outputs[0])


def any_camera(chance: random.Random) -> None:
    """A camera before the solids: through a pinhole, a wide lens or in parallel."""
    place = (chance.uniform(-1.5, 1.5), -7.0, chance.uniform(2.5, 4.5))
    data = camera(place, (0.0, 0.0, 0.5)).data
    kind = chance.random()
    if kind < 0.15:
        data.type, data.ortho_scale = "ORTHO", 6.5
    elif kind < 0.3:
        data.dof.use_dof, data.dof.focus_distance, data.dof.aperture_fstop = True, 7.0, 0.4
    if chance.random() < 0.2:
        data.shift_x, data.shift_y = 0.1, -0.05

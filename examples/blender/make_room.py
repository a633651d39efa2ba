"""Builds room.blend, a furnished corner with a window: `blender -b -P make_room.py -- room.blend` (or a Python with bpy)."""

import math
import sys
from pathlib import Path

import bpy


def material(name: str, colour: tuple[float, float, float], **inputs: float) -> bpy.types.Material:
    """A Principled BSDF; `inputs` are its sockets, with underscores for blanks."""
    made = bpy.data.materials.new(name)
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*colour, 1.0)
    for socket, value in inputs.items():
        shader.inputs[socket.replace("_", " ")].default_value = value
    return made


def place(name: str, surface: bpy.types.Material) -> bpy.types.Object:
    """Names the object that was just added and gives it a surface."""
    thing = bpy.context.object
    thing.name = name
    thing.data.materials.append(surface)
    return thing


def box(name: str, centre, size, surface: bpy.types.Material, bevel: float = 0.0) -> bpy.types.Object:
    """A box with rounded edges."""
    bpy.ops.mesh.primitive_cube_add(size=1.0, location=centre, scale=size)
    bpy.ops.object.transform_apply(location=False, rotation=False, scale=True)
    thing = place(name, surface)
    if bevel:
        edges = thing.modifiers.new("Bevel", "BEVEL")
        edges.width, edges.segments = bevel, 3
    return thing


def room() -> None:
    """A floor, two walls, one with a window, and a ceiling."""
    wall, floor = material("Plaster", (0.75, 0.73, 0.7), Roughness=0.9), material("Oak", (0.42, 0.26, 0.13), Roughness=0.35)
    box("Floor", (0, 0, -0.05), (5, 5, 0.1), floor)
    box("Back Wall", (0, 2.5, 1.4), (5, 0.1, 2.8), wall)
    box("Ceiling", (0, 0, 2.85), (5, 5, 0.1), wall)
    for name, centre, size in (
        ("Wall under the Window", (-2.5, 0, 0.45), (0.1, 5, 0.9)),
        ("Wall over the Window", (-2.5, 0, 2.5), (0.1, 5, 0.6)),
        ("Wall before the Window", (-2.5, -1.75, 1.55), (0.1, 1.5, 1.3)),
        ("Wall behind the Window", (-2.5, 1.75, 1.55), (0.1, 1.5, 1.3)),
    ):
        box(name, centre, size, wall)


def furniture() -> None:
    """A table with things of glass, metal and ceramics, and a lamp."""
    wood = material("Walnut", (0.16, 0.08, 0.04), Roughness=0.3, Coat_Weight=0.5)
    box("Table Top", (0.3, 0.9, 0.73), (1.6, 0.8, 0.04), wood, bevel=0.01)
    for x in (-0.42, 1.02):
        for y in (0.57, 1.23):
            box("Table Leg", (x, y, 0.355), (0.05, 0.05, 0.71), wood, bevel=0.005)
    bpy.ops.mesh.primitive_monkey_add(size=0.35, location=(0.0, 0.95, 0.9), rotation=(math.radians(-25), 0, math.radians(35)))
    monkey = place("Monkey", material("Ceramic", (0.1, 0.3, 0.45), Roughness=0.2, Coat_Weight=1.0))
    monkey.modifiers.new("Subdivision", "SUBSURF").render_levels = 3
    bpy.ops.object.shade_smooth()
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.1, location=(0.5, 0.8, 0.85))
    place("Glass Ball", material("Glass", (1, 1, 1), Roughness=0.0, Transmission_Weight=1.0, IOR=1.5))
    bpy.ops.object.shade_smooth()
    bpy.ops.mesh.primitive_torus_add(major_radius=0.1, minor_radius=0.03, location=(0.8, 1.0, 0.78), major_segments=64, minor_segments=24)
    place("Ring", material("Brass", (0.9, 0.65, 0.3), Roughness=0.25, Metallic=1.0))
    bpy.ops.object.shade_smooth()


def lights() -> None:
    """A sky, the sun through the window, and a warm lamp over the table."""
    world = bpy.data.worlds.new("Sky")
    world.use_nodes = True
    background = world.node_tree.nodes["Background"]
    background.inputs["Color"].default_value = (0.35, 0.55, 1.0, 1.0)
    background.inputs["Strength"].default_value = 1.5
    bpy.context.scene.world = world
    bpy.ops.object.light_add(type="SUN", rotation=(math.radians(20), math.radians(-60), 0))
    bpy.context.object.data.energy, bpy.context.object.data.angle = 6.0, math.radians(0.53)
    bpy.ops.object.light_add(type="AREA", location=(0.3, 0.9, 2.0))
    lamp = bpy.context.object.data
    lamp.shape, lamp.size, lamp.energy = "DISK", 0.3, 15.0
    lamp.use_temperature, lamp.temperature = True, 2700.0


def camera() -> None:
    """A camera in the corner, focused on the monkey."""
    bpy.ops.object.camera_add(location=(2.1, -1.9, 1.5), rotation=(math.radians(81), 0, math.radians(37)))
    scene, seen = bpy.context.scene, bpy.context.object
    scene.camera = seen
    seen.data.lens = 32.0
    seen.data.dof.use_dof, seen.data.dof.focus_object, seen.data.dof.aperture_fstop = True, bpy.data.objects["Monkey"], 2.8


def main() -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    room()
    furniture()
    lights()
    camera()
    render = bpy.context.scene.render
    render.resolution_x, render.resolution_y = 960, 540
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(sys.argv[-1]).resolve()))


main()

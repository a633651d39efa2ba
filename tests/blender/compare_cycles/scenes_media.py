"""Fog, smoke and liquids in meshes and in all of space."""

from math import cos, radians, sin, tau

import bpy
from stage import (
    ball,
    blank,
    box,
    camera,
    diffuse,
    even_world,
    lamp,
    link,
    material,
    new_world,
    node,
    plane,
    resolution,
    soft_sky,
)


def shaded(kind: str, **values) -> tuple[bpy.types.Material, bpy.types.NodeTree, bpy.types.Node]:
    """A material of one shader in its Volume socket, and nothing at its surface."""
    made, tree = blank(kind)
    shader = node(tree, f"ShaderNode{kind}", **values)
    inside(tree, shader)
    return made, tree, shader


def inside(tree: bpy.types.NodeTree, shader: bpy.types.Node) -> None:
    """Makes a shader the volume of its material."""
    node(tree, "ShaderNodeOutputMaterial", Volume=shader.outputs[0])


def medium(kind: str, **values) -> bpy.types.Material:
    """The material alone of `shaded`."""
    return shaded(kind, **values)[0]


def scattered(bounces: int) -> None:
    """A picture of 128 by 96 pixels, in which light scatters so many times in media after the first."""
    resolution(128, 96)
    bpy.context.scene.cycles.volume_bounces = bounces
    bpy.context.scene.cycles.max_bounces = max(12, bounces)


def hall() -> None:
    """A floor, a wall and a thing on the floor, seen from the front."""
    plane(diffuse((0.6, 0.6, 0.6)))
    plane(diffuse((0.7, 0.5, 0.35)), location=(0.0, 2.0, 0.0), rotation=(radians(90), 0.0, 0.0))
    box(diffuse((0.4, 0.6, 0.3)), 0.7, location=(1.3, 0.9, 0.35), rotation=(0.0, 0.0, 0.4))
    camera((0.0, -6.5, 2.4), (0.0, 0.3, 0.8), lens=45.0)


def fog_box_with_lamp() -> None:
    """A box of coloured fog, a lamp inside, an opaque ball before it."""
    scattered(4)
    even_world(0.1)
    hall()
    box(medium("VolumeScatter", Color=(0.9, 0.8, 0.7), Density=0.5, Anisotropy=0.4), 1.7, location=(-0.3, 0.1, 0.95))
    ball(diffuse((0.2, 0.4, 0.7)), 0.2, location=(0.0, -0.4, 0.6))
    lamp("POINT", 60.0, (-0.4, 0.2, 1.2), color=(1.0, 0.8, 0.6), shadow_soft_size=0.1, use_soft_falloff=True)


def overlapping_boxes() -> None:
    """Two boxes with other scattering each that overlap: forwards and back."""
    # Greys, since Cycles weighs both by the mean of their colours.
    scattered(2)
    soft_sky()
    hall()
    forwards = medium("VolumeScatter", Color=(0.8, 0.8, 0.8), Density=1.2, Anisotropy=0.7)
    back = medium("VolumeScatter", Color=(0.5, 0.5, 0.5), Density=2.0, Anisotropy=-0.5)
    box(forwards, 1.2, location=(-0.6, 0.0, 0.7), rotation=(0.0, 0.0, 0.3))
    box(back, 1.1, location=(0.2, 0.2, 0.8), rotation=(0.2, 0.3, 0.0))
    lamp("SUN", 2.0, (0.0, 0.0, 5.0), (0.9, -0.4, 0.3), angle=radians(6))


def overlapping_colours() -> None:
    """Two boxes of other colours that overlap, and a ball wholly within one."""
    scattered(2)
    soft_sky()
    hall()
    red = medium("VolumeScatter", Color=(0.9, 0.3, 0.2), Density=0.8, Anisotropy=0.2)
    box(red, 1.4, location=(-0.4, 0.1, 0.75), rotation=(0.0, 0.0, 0.3))
    box(medium("VolumeAbsorption", Color=(0.3, 0.6, 0.9), Density=1.5), 1.1, location=(0.4, 0.2, 0.8), rotation=(0.2, 0.3, 0.0))
    ball(medium("VolumeScatter", Color=(0.3, 0.8, 0.4), Density=3.0, Anisotropy=0.2), 0.3, location=(-0.5, 0.0, 0.8))
    lamp("AREA", 200.0, (-1.2, -2.6, 3.4), (0.6, -0.3, 0.5), size=1.4)


def camera_inside() -> None:
    """A camera in two bodies of fog, the edge of the outer one and a wall in view."""
    scattered(2)
    even_world(0.4, (0.7, 0.85, 1.0))
    hall()
    haze = medium("VolumePrincipled", Color=(0.7, 0.8, 0.9), Density=0.12, Anisotropy=0.5)
    box(haze, 2.0, location=(-1.0, -4.5, 2.0), scale=(2.0, 3.0, 1.9))
    box(medium("VolumeAbsorption", Color=(0.9, 0.5, 0.3), Density=0.4), 2.0, location=(0.0, -6.3, 2.4))
    lamp("POINT", 80.0, (-1.2, -2.2, 2.0), shadow_soft_size=0.15, use_soft_falloff=True)


def world_fog() -> None:
    """Fog in all of space: a lamp with a beam, and a glowing ball."""
    scattered(2)
    tree = new_world()
    fog = node(tree, "ShaderNodeVolumeScatter", Color=(0.9, 0.9, 0.9), Density=0.08, Anisotropy=0.3)
    node(tree, "ShaderNodeOutputWorld", Volume=fog.outputs[0])
    hall()
    lamp("SPOT", 600.0, (-2.0, -0.6, 3.2), (0.5, -0.6, 0.0), spot_size=radians(40), spot_blend=0.3, shadow_soft_size=0.1)
    ball(material("Emission", Color=(1.0, 0.7, 0.4), Strength=6.0), 0.3, location=(0.3, -0.3, 0.6))


def world_fog_and_sun() -> None:
    """The same with a sun and a sky, of which nothing arrives: the picture stays what it is."""
    world_fog()
    tree = bpy.context.scene.world.node_tree
    sky = node(tree, "ShaderNodeBackground", Color=(0.5, 0.7, 1.0), Strength=0.5)
    end = next(each for each in tree.nodes if each.bl_idname == "ShaderNodeOutputWorld")
    tree.links.new(sky.outputs[0], end.inputs["Surface"])
    lamp("SUN", 3.0, (0.0, 0.0, 5.0), (0.7, -0.3, 0.4), angle=radians(2))


def fog_in_sun() -> None:
    """A large body of fog in which a sun shines through slats."""
    scattered(2)
    even_world(0.15, (0.6, 0.8, 1.0))
    hall()
    box(medium("VolumePrincipled", Density=0.15, Anisotropy=0.3), 5.0, location=(0.0, 0.0, 2.4))
    for number in range(4):
        box(diffuse((0.3, 0.3, 0.3)), location=(-1.5 + number, -0.3, 2.2), scale=(0.5, 1.8, 0.05), rotation=(0.0, 0.2, 0.0))
    lamp("SUN", 4.0, (0.0, 0.0, 5.0), (0.25, -0.5, 0.0), angle=radians(3))


def revolved(profile: list[tuple[float, float]], cover: bpy.types.Material) -> bpy.types.Object:
    """A closed body of revolution about z; its outline (radius, height) goes from the axis to the axis, outside on the right."""
    steps, points, faces = 96, [], []
    for radius, height in profile:
        points += [(radius * cos(tau * step / steps), radius * sin(tau * step / steps), height) for step in range(steps)]
    for low in range(0, steps * (len(profile) - 1), steps):
        faces += [(low + step, low + (step + 1) % steps, low + steps + (step + 1) % steps, low + steps + step) for step in range(steps)]
    last = steps * (len(profile) - 1)
    faces += [tuple(range(steps))[::-1], tuple(range(last, last + steps))]
    mesh = bpy.data.meshes.new("Revolved")
    mesh.from_pydata(points, [], faces)
    mesh.materials.append(cover)
    return link("Revolved", mesh)


def liquid(**values) -> bpy.types.Material:
    """A clear surface as of water, with a Principled volume behind it."""
    made, tree = blank("Liquid")
    clear, within = node(tree, "ShaderNodeBsdfRefraction", Roughness=0.0, IOR=1.33), node(tree, "ShaderNodeVolumePrincipled", **values)
    node(tree, "ShaderNodeOutputMaterial", Surface=clear.outputs[0], Volume=within.outputs[0])
    return made


def glasses() -> None:
    """Two glasses on a floor, one of milk, one of juice; a gap between glass and liquid, so that it does not count who is within whom."""
    scattered(64)
    bpy.context.scene.cycles.transmission_bounces = bpy.context.scene.cycles.max_bounces = 64
    plane(diffuse((0.5, 0.45, 0.4)))
    soft_sky()
    wall = [(0.02, 0.02), (0.5, 0.02), (0.55, 1.4), (0.5, 1.4), (0.45, 0.1), (0.02, 0.1)]
    filled = [(0.02, 0.11), (0.443, 0.11), (0.481, 1.0), (0.02, 1.0)]
    drinks = [
        {"Color": (0.95, 0.9, 0.8), "Density": 6.0, "Anisotropy": 0.5},
        {"Color": (0.3, 0.12, 0.02), "Absorption_Color": (0.6, 0.2, 0.02), "Density": 2.0},
    ]
    for number, drink in enumerate(drinks):
        for part in (revolved(wall, material("BsdfGlass", Roughness=0.0, IOR=1.45)), revolved(filled, liquid(**drink))):
            part.location.x = 1.3 * number - 0.65
    camera((0.0, -5.0, 2.2), (0.0, 0.0, 0.6), lens=50.0)


def collection_of(things: list[bpy.types.Object]) -> bpy.types.Collection:
    """A collection of objects, out of the scene."""
    made = bpy.data.collections.new("Inside")
    for thing in things:
        for each in list(thing.users_collection):
            each.objects.unlink(thing)
        made.objects.link(thing)
    return made


def instances_of(things: list[bpy.types.Object]) -> None:
    """Three instances of a collection: moved, turned, and larger along one axis."""
    shown = collection_of(things)
    for number, (turned, scale) in enumerate([(0.0, (1.0, 1.0, 1.0)), (0.7, (0.7, 0.7, 0.7)), (0.4, (0.8, 1.0, 1.5))]):
        holder = link(f"Holder {number}", None, (1.2 * number - 1.3, 0.1, 0.75), (0.0, 0.2 * number, turned), scale)
        holder.instance_type, holder.instance_collection = "COLLECTION", shown


def fog_instances() -> None:
    """Instances of a collection of a fog mesh, with a ball in the middle."""
    scattered(2)
    soft_sky()
    hall()
    fog = box(medium("VolumeScatter", Color=(0.8, 0.6, 0.4), Density=1.5, Anisotropy=0.4), 0.9)
    instances_of([fog, ball(diffuse((0.2, 0.4, 0.7)), 0.2)])
    lamp("AREA", 200.0, (-1.2, -2.6, 3.4), (0.6, -0.3, 0.5), size=1.4)

"""What is baked into an image: light on a floor and on a box, where faces coincide, as a camera sees it, openness, bent normals."""

import importlib.util
import unittest

import bpy
import scenes_texture
from stage import ball, box, camera, diffuse, even_world, lamp, material, node, plane, principled

SIZE = 128


def bakes(thing: bpy.types.Object, kind: str, **settings) -> None:
    """Makes an object and an image the ones that are baked; `settings` are those of the bake."""
    picture = bpy.data.images.new("Baked", SIZE, SIZE, float_buffer=True)
    for slot in thing.material_slots:
        tree = slot.material.node_tree
        tree.nodes.active = node(tree, "ShaderNodeTexImage", image=picture)
    bpy.ops.object.select_all(action="DESELECT")
    thing.select_set(True)
    bpy.context.view_layer.objects.active = thing
    scene = bpy.context.scene
    scene.cycles.bake_type, scene.render.bake.margin = kind, 0
    for name, value in settings.items():
        setattr(scene.render.bake, name, value)


def room(height: float = 0.8, cover: bpy.types.Material | None = None) -> tuple[bpy.types.Object, bpy.types.Object]:
    """A floor, which is given back with a box over it, a ball, and two lamps."""
    even_world(0.3)
    floor = plane(cover or diffuse((0.6, 0.5, 0.4)), size=4.0)
    block = box(principled(Base_Color=(0.3, 0.6, 0.3), Roughness=0.4), 0.9, location=(0.6, 0.3, height), rotation=(0.0, 0.0, 0.4))
    ball(diffuse((0.2, 0.4, 0.7)), 0.5, location=(-0.8, -0.3, 0.5))
    lamp("POINT", 90.0, (-1.4, -1.2, 2.6), color=(1.0, 0.8, 0.6), shadow_soft_size=0.4, use_soft_falloff=False)
    lamp("AREA", 60.0, (1.5, 0.5, 2.8), (0.0, 0.5, 0.0), color=(0.6, 0.8, 1.0), size=1.0)
    camera((0.0, -5.5, 3.0), (0.0, 0.0, 0.3))
    return floor, block


def bake_combined() -> None:
    """A floor under a box that floats and a ball that stands on it."""
    bakes(room()[0], "COMBINED")


def bake_on_faces() -> None:
    """A box that stands on the floor: its underside lies on it."""
    bakes(room(0.45)[1], "COMBINED")


def bake_irradiance() -> None:
    """Diffuse light without the colour."""
    bakes(room()[0], "DIFFUSE", use_pass_color=False)


def bake_glossy() -> None:
    """What a camera sees of a metal floor."""
    metal = material("BsdfAnisotropic", Color=(0.9, 0.8, 0.6), Roughness=0.4)
    bakes(room(cover=metal)[0], "GLOSSY", view_from="ACTIVE_CAMERA")


def bake_occlusion() -> None:
    """How open a floor is, with a box on it."""
    bakes(room(0.45)[0], "AO")


def bake_normals() -> None:
    """A normal map over another's coordinates, in the tangents' space."""
    room()
    bakes(plane(scenes_texture.dented(), size=2.0, location=(0.0, 0.0, 2.0)), "NORMAL", normal_space="TANGENT")


def bake_denoised() -> None:
    """The floor again, denoised."""
    if importlib.util.find_spec("pyoidn") is None:
        raise unittest.SkipTest("this bpy's Python has no pyoidn: pip install pyoidn")
    bake_combined()
    bpy.context.scene.cycles.use_denoising = True

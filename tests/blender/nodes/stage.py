"""The scenes of the comparison: a plane of tiles, one a material, and rows of balls, lit or not. For Blender."""

import math
from typing import NamedTuple

import bpy
import numpy
from mathutils import Vector

from . import data, tree

# Pixels along the side of a ball's square.
BALL = 96
# And of one that light falls on.
LIT_BALL = 64
# Samples a pixel of what light falls on.
LIT_SAMPLES = 40


def empty(width: int, height: int) -> bpy.types.Scene:
    """A black scene whose samples lie at the middles of pixels."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    scene.view_settings.view_transform = "Raw"
    scene.world = bpy.data.worlds.new("World")
    if bpy.app.version < (5, 0, 0):
        scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    cycles = scene.cycles
    cycles.device, cycles.samples, cycles.max_bounces = "CPU", 1, 0
    cycles.use_adaptive_sampling = cycles.use_denoising = False
    cycles.sample_clamp_direct = cycles.sample_clamp_indirect = 0.0
    cycles.pixel_filter_type, cycles.filter_width = "BLACKMAN_HARRIS", 0.01
    for name in (tree.OUTPUT, tree.PLACE):
        entry = scene.view_layers[0].aovs.add()
        entry.name, entry.type = name, "COLOR"
    return scene


def camera(scene: bpy.types.Scene, location, **fields) -> None:
    """A camera that looks down."""
    made = bpy.data.cameras.new("Camera")
    for name, value in fields.items():
        setattr(made, name, value)
    thing = bpy.data.objects.new("Camera", made)
    thing.location = location
    scene.collection.objects.link(thing)
    scene.camera = thing


class Grid(NamedTuple):
    """Where the parts of a picture lie: pixels along a side of each, from one to the next, and how many stand in a row."""

    side: int
    stride: int
    columns: int

    def part(self, number: int) -> tuple[slice, slice]:
        """The pixels of a part."""
        starts = (self.stride * place + (self.stride - self.side) // 2 for place in divmod(number, self.columns))
        return tuple(slice(start, start + self.side) for start in starts)


def tiles(materials: list) -> Grid:
    """A plane whose faces have these materials, each with the whole of the coordinates."""
    columns = math.ceil(math.sqrt(len(materials)))
    rows = math.ceil(len(materials) / columns)
    scene = empty(columns * data.SIDE, rows * data.SIDE)
    corners, faces, at = [], [], []
    for number in range(len(materials)):
        row, column = divmod(number, columns)
        x, y, first = column - 0.5 * columns, 0.5 * rows - row - 1.0, len(corners)
        corners += [(x, y, 0.0), (x + 1.0, y, 0.0), (x + 1.0, y + 1.0, 0.0), (x, y + 1.0, 0.0)]
        faces.append(range(first, first + 4))
        at += [0.0, 0.0, 1.0, 0.0, 1.0, 1.0, 0.0, 1.0]
    mesh = bpy.data.meshes.new("Tiles")
    mesh.from_pydata(corners, [], faces)
    mesh.uv_layers.new(name="UVMap").uv.foreach_set("vector", at)
    covers = [make() for make in materials]
    for cover in covers:
        mesh.materials.append(cover)
    mesh.polygons.foreach_set("material_index", range(len(faces)))
    scene.collection.objects.link(bpy.data.objects.new("Tiles", mesh))
    camera(scene, (0.0, 0.0, 5.0), type="ORTHO", ortho_scale=max(columns, rows))
    return Grid(data.SIDE, data.SIDE, columns)


def balls(materials: list, shape=None, side: int = BALL, apart: int = 1) -> Grid:
    """Rows of turned balls, or of what a function makes, so many diameters apart."""
    columns = math.ceil(math.sqrt(len(materials)))
    rows = math.ceil(len(materials) / columns)
    scene = empty(columns * side * apart, rows * side * apart)
    mesh = (shape or ball_mesh)()
    for number, make in enumerate(materials):
        row, column = divmod(number, columns)
        thing = bpy.data.objects.new(f"Ball {number}", mesh)
        thing.location = (apart * (column - 0.5 * (columns - 1)), apart * (0.5 * (rows - 1) - row), 0.3)
        thing.rotation_euler, thing.scale = (0.5, 0.3, 0.7), (0.5, 0.5, 0.5)
        thing.color, thing.pass_index = (0.3, 0.6, 0.9, 0.8), 7
        thing["own"] = 0.625
        scene.collection.objects.link(thing)
        thing.material_slots[0].link = "OBJECT"
        thing.material_slots[0].material = cover = make()
        cover.pass_index = 5
    wide = apart * max(columns, rows)
    high = 3.0 * wide
    camera(scene, (0.0, 0.0, high), lens_unit="FOV", angle=2.0 * math.atan(0.5 * wide / high))
    scene["shared"] = 0.375
    return Grid(side, apart * side, columns)


def lit(materials: list) -> Grid:
    """The balls under a soft sky, so far apart that they do not light each other."""
    found = balls(materials, side=LIT_BALL, apart=2)
    scene = bpy.context.scene
    _sky(scene.world.node_tree)
    cycles = scene.cycles
    cycles.samples, cycles.blur_glossy, cycles.light_sampling_threshold = LIT_SAMPLES, 0.0, 0.0
    for name in ("max_bounces", "diffuse_bounces", "glossy_bounces", "transmission_bounces", "volume_bounces"):
        setattr(cycles, name, 4)
    cycles.pixel_filter_type, cycles.filter_width = "BOX", 1.0
    for entry in list(scene.view_layers[0].aovs):
        scene.view_layers[0].aovs.remove(entry)
    return found


def found(materials: list) -> Grid:
    """The same under a sky that Cycles' paths find by themselves.

    Where Cycles samples lights it leaves out what fibres on meshes send to the other side of smooth normals, so that its picture depends on
    how it looks for light.
    """
    grid = lit(materials)
    bpy.context.scene.world.cycles.sampling_method = "NONE"
    return grid


def filled(materials: list) -> Grid:
    """The same for what fills balls, with fewer samples: Cycles takes long for them."""
    found = lit(materials)
    cycles = bpy.context.scene.cycles
    cycles.samples, cycles.volume_bounces, cycles.max_bounces = 16, 1, 2
    return found


def _sky(tree: bpy.types.NodeTree) -> None:
    """A smooth sky, brighter on one side: light with a direction, and little noise; alike at both poles, where filters differ."""
    height, width = 32, 64
    up = numpy.sin(numpy.pi * ((numpy.arange(height) + 0.5) / height - 0.5))[:, None]
    around = numpy.cos(2.0 * numpy.pi * (numpy.arange(width) + 0.5) / width)[None, :]
    level = 0.5 + 0.35 * around * numpy.sqrt(1.0 - up * up)
    whole = numpy.ones((height, width, 4), "f4")
    whole[..., :3] = level[..., None] * numpy.array([0.9, 1.0, 1.1])
    made = bpy.data.images.new("Sky", width, height, float_buffer=True, is_data=True)
    made.pixels.foreach_set(whole.ravel())
    shown = tree.nodes.new("ShaderNodeTexEnvironment")
    shown.image = made
    tree.links.new(shown.outputs["Color"], tree.nodes["Background"].inputs["Color"])
    tree.nodes["Background"].inputs["Strength"].default_value = 1.0


def pixels(place: numpy.ndarray) -> numpy.ndarray:
    """The row and the column, in pixels from the middle, where the camera over the balls sees places."""
    high = bpy.context.scene.camera.location.z
    spread = BALL * high / (high - place[..., 2])
    return numpy.stack([-place[..., 1] * spread, place[..., 0] * spread], axis=-1)


def ball_mesh() -> bpy.types.Mesh:
    """A smooth ball with coordinates and attributes of every domain that shaders see."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=16, ring_count=8)
    thing = bpy.context.object
    bpy.ops.object.shade_smooth()
    mesh = thing.data
    bpy.data.objects.remove(thing)
    mesh.materials.append(None)
    _attributes(mesh)
    return mesh


def _attributes(mesh: bpy.types.Mesh) -> None:
    corners = [Vector(mesh.vertices[each.vertex_index].co) for each in mesh.loops]
    paint = mesh.color_attributes.new("paint", "FLOAT_COLOR", "POINT")
    colours = [(*(Vector((0.6, 0.6, 0.6)) + 0.4 * each.co), 0.5 + 0.3 * each.co.x) for each in mesh.vertices]
    paint.data.foreach_set("color", [value for colour in colours for value in colour])
    dye = mesh.color_attributes.new("dye", "BYTE_COLOR", "CORNER")
    dye.data.foreach_set("color", [value for each in corners for value in (*(Vector((0.5, 0.5, 0.5)) + 0.5 * each.zxy), 1.0)])
    arrow = mesh.attributes.new("arrow", "FLOAT_VECTOR", "POINT")
    arrow.data.foreach_set("vector", [value for each in mesh.vertices for value in Vector(each.co).zxy * 1.5])
    number = mesh.attributes.new("number", "FLOAT", "FACE")
    number.data.foreach_set("value", [(i % 11) / 10 for i in range(len(mesh.polygons))])
    whole = mesh.attributes.new("whole", "INT", "POINT")
    whole.data.foreach_set("value", [round(9.0 * each.co.y) for each in mesh.vertices])
    second = mesh.uv_layers.new(name="second")
    second.uv.foreach_set("vector", [value for each in corners for value in each.xy])
    mesh.uv_layers.active_index = 0
    mesh.uv_layers[0].active_render = True

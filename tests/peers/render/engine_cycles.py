"""Scenes in Cycles, by Blender as a Python module."""

import math
import re
import tempfile
from pathlib import Path

import bpy
import mathutils
import numpy
from blender_pixels import pixels
from cornell import Diffuse, Glass, Mirror
from cornell_cycles import node_name, sockets
from cycles_settings import unbiased
from description import LUMENS_PER_WATT, Camera, Disk, Light, Mesh, Point, Rectangle, Scene, Sphere, Spot, Sun, Surface, Textured

# Blender's z is up, and the middle of an image around the scene lies at its x.
TO_BLENDER = numpy.array([[0, 0, 1, 0], [1, 0, 0, 0], [0, 1, 0, 0], [0, 0, 0, 1]], "f8")
RENDER_TIME = re.compile(rb"cycles\.[^\0]*\.render_time\0string\0.{4}(?:(\d+):)?(\d+):(\d+\.\d+)", re.DOTALL)


class Engine:
    """A scene laid out; pictures are radiance in cd/m², (height, width, 3), the top row first."""

    def __init__(self, scene: Scene, threads: int, variant: str = "") -> None:
        """`variant`: `guided` guides paths, `shadow` casts shadow caustics, `guided+shadow` does both."""
        kinds = set(variant.split("+")) - {""}
        assert kinds <= {"guided", "shadow"}, variant
        self.version = f"Cycles of Blender {bpy.app.version_string}"
        bpy.ops.wm.read_factory_settings(use_empty=True)
        self._file = Path(tempfile.mkdtemp()) / "picture.exr"
        settings(bpy.context.scene, scene, threads)
        bpy.context.scene.cycles.use_guiding = "guided" in kinds
        bpy.context.scene.render.filepath = str(self._file)
        bpy.context.scene.world = world(scene.environment)
        for part in scene.meshes:
            made = mesh(part)
            for place in part.places:
                cast_shadow_caustics(linked(part.name, made, place), part.surface, "shadow" in kinds)
        for light in scene.lights:
            made = lamp(light)
            made.cycles.is_caustics_light = "shadow" in kinds
            linked("light", made, light.matrix).visible_camera = True
        bpy.context.scene.camera = linked("camera", camera(scene.camera), scene.camera.matrix)
        self.render(1, 0)

    def render(self, samples: int, seed: int) -> tuple[numpy.ndarray, float, int]:
        """A picture, the seconds that its samples took by Cycles' own clock, and how many they were."""
        bpy.context.scene.cycles.samples, bpy.context.scene.cycles.seed = samples, seed
        bpy.ops.render.render(write_still=True)
        return pixels(self._file) * LUMENS_PER_WATT, render_seconds(self._file.read_bytes()), samples


def render_seconds(file: bytes) -> float:
    """What Cycles says in the picture's header: the time without what laying out the scene took."""
    found = RENDER_TIME.search(file)
    if found is None:
        raise ValueError("Cycles left no time in the picture")
    hours, minutes, seconds = found.groups()
    return 3600.0 * float(hours or 0) + 60.0 * float(minutes) + float(seconds)


def settings(made: bpy.types.Scene, scene: Scene, threads: int) -> None:
    """What this scene has of its own."""
    unbiased(made, scene.bounces)
    made.render.resolution_x, made.render.resolution_y = scene.width, scene.height
    made.render.threads_mode, made.render.threads = "FIXED", threads
    made.render.use_persistent_data = True


def linked(name: str, data: bpy.types.ID, matrix: numpy.ndarray) -> bpy.types.Object:
    """An object of the scene."""
    made = bpy.data.objects.new(name, data)
    made.matrix_world = mathutils.Matrix((TO_BLENDER @ matrix).tolist())
    bpy.context.scene.collection.objects.link(made)
    return made


def cast_shadow_caustics(thing: bpy.types.Object, surface: Surface, on: bool) -> None:
    """Glass casts them onto all that is neither glass nor mirror; Cycles knows no reflected ones."""
    thing.cycles.is_caustics_caster = on and isinstance(surface, Glass)
    thing.cycles.is_caustics_receiver = on and not isinstance(surface, Glass | Mirror)


def mesh(part: Mesh) -> bpy.types.Mesh:
    """A mesh, with flat faces unless it has normals, and its material."""
    made = bpy.data.meshes.new(part.name)
    made.from_pydata(part.points.tolist(), [], part.triangles.tolist())
    made.polygons.foreach_set("use_smooth", [part.normals is not None] * len(made.polygons))
    if part.normals is not None:
        made.normals_split_custom_set_from_vertices(part.normals.tolist())
    if part.uvs is not None:
        made.uv_layers.new().data.foreach_set("uv", part.uvs[part.triangles].ravel())
    made.materials.append(material(part.name, part.surface))
    return made


def material(name: str, surface: Surface) -> bpy.types.Material:
    """One shader node into the output."""
    made = bpy.data.materials.new(name)
    tree = made.node_tree
    tree.nodes.clear()
    plain = Diffuse((0.0, 0.0, 0.0)) if isinstance(surface, Textured) else surface
    shader = tree.nodes.new(f"ShaderNodeBsdf{node_name(plain)}")
    tree.links.new(shader.outputs[0], tree.nodes.new("ShaderNodeOutputMaterial").inputs["Surface"])
    if hasattr(shader, "distribution"):
        # Energy compensation as gonio has it; it has nothing to do at roughness 0.
        shader.distribution = "MULTI_GGX"
    for socket, value in sockets(plain).items():
        shader.inputs[socket].default_value = value
    if isinstance(surface, Textured):
        lookup = tree.nodes.new("ShaderNodeTexImage")
        lookup.image = image(name, surface.image)
        tree.links.new(lookup.outputs["Color"], shader.inputs["Color"])
    return made


def image(name: str, values: numpy.ndarray) -> bpy.types.Image:
    """A packed image of linear values, (height, width, 3), the top row first."""
    height, width, _ = values.shape
    made = bpy.data.images.new(name, width, height, float_buffer=True)
    made.colorspace_settings.name = "Non-Color"
    whole = numpy.ones((height, width, 4), "f4")
    whole[..., :3] = values[::-1]
    made.pixels.foreach_set(whole.ravel())
    made.pack()
    return made


def world(environment: numpy.ndarray | None) -> bpy.types.World:
    """A black world, or an image around the scene."""
    made = bpy.data.worlds.new("world")
    background = made.node_tree.nodes["Background"]
    background.inputs["Strength"].default_value = 0.0 if environment is None else 1.0 / LUMENS_PER_WATT
    if environment is not None:
        lookup = made.node_tree.nodes.new("ShaderNodeTexEnvironment")
        lookup.image = image("sky", environment)
        made.node_tree.links.new(lookup.outputs["Color"], background.inputs["Color"])
    return made


def lamp(light: Light) -> bpy.types.Light:
    """A lamp; its watts P give an area of A square metres the radiance P / (pi A), a point the intensity P / (4 pi)."""
    match light:
        case Rectangle(_, width, height, radiance):
            made = coloured("AREA", radiance, math.pi * width * height)
            made.shape, made.size, made.size_y = "RECTANGLE", width, height
        case Disk(_, radius, radiance):
            made = coloured("AREA", radiance, math.pi**2 * radius**2)
            made.shape, made.size = "DISK", 2.0 * radius
        case Sphere(_, radius, radiance):
            made = coloured("POINT", radiance, 4.0 * math.pi**2 * radius**2)
            made.shadow_soft_size, made.use_soft_falloff = radius, False
        case Point(_, intensity):
            made = coloured("POINT", intensity, 4.0 * math.pi)
            made.shadow_soft_size = 0.0
        case Spot(_, angle, blend, intensity):
            made = coloured("SPOT", intensity, 4.0 * math.pi)
            made.spot_size, made.spot_blend, made.shadow_soft_size = math.radians(angle), blend, 0.0
        case Sun(_, angle, radiance):
            made = coloured("SUN", radiance, math.pi * math.sin(math.radians(angle) / 2.0) ** 2)
            made.angle = math.radians(angle)
    return made


def coloured(kind: str, strength: tuple[float, ...], watts: float) -> bpy.types.Light:
    """A lamp of a kind; `watts` is its energy for a strength of 1 W/(m² sr) or 1 W/sr."""
    made = bpy.data.lights.new(kind, kind)
    most = max(strength)
    made.energy = most * watts / LUMENS_PER_WATT
    made.color = [component / most for component in strength]
    return made


def camera(view: Camera) -> bpy.types.Camera:
    """A pinhole."""
    made = bpy.data.cameras.new("camera")
    made.sensor_fit = "VERTICAL"
    made.angle = math.radians(view.fov)
    made.clip_start, made.clip_end = 0.01, 1000.0
    return made

"""Scenes that tests render, and how they read the files back. Used inside the child process."""

import math

import bpy
import numpy

LUMENS_PER_WATT = 177.83


def empty(width: int = 64, height: int = 64, samples: int = 64):
    """An empty scene for Gonio, with a black world."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "GONIO"
    scene.gonio.samples = samples
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    scene.world = bpy.data.worlds.new("World")
    scene.world.use_nodes = True
    scene.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    return scene


def diffuse(name: str, colour):
    """A material of one Diffuse BSDF."""
    material = bpy.data.materials.new(name)
    material.use_nodes = True
    tree = material.node_tree
    tree.nodes.clear()
    shader, output = tree.nodes.new("ShaderNodeBsdfDiffuse"), tree.nodes.new("ShaderNodeOutputMaterial")
    shader.inputs["Color"].default_value = (*colour, 1.0)
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    return material


def lit_floor(watts: float = 100.0, **keywords):
    """A white Lambertian floor one metre under a point light; the camera looks straight down past it."""
    scene = empty(**keywords)
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.name = "Floor"
    bpy.context.object.data.materials.append(diffuse("White", (1, 1, 1)))
    bpy.ops.object.light_add(type="POINT", location=(0, 0, 1))
    lamp = bpy.context.object
    lamp.name = "Lamp"
    lamp.data.energy, lamp.data.shadow_soft_size = watts, 0.0
    bpy.ops.object.camera_add(location=(0, 0, 5), rotation=(0, 0, 0))
    scene.camera = bpy.context.object
    scene.camera.data.type, scene.camera.data.ortho_scale = "ORTHO", 0.1
    scene.gonio.max_bounces = 0
    return scene


def expected_irradiance(watts: float) -> float:
    """W/m² one metre below a point light: P/(4π d²)."""
    return watts / (4.0 * math.pi)


def render(path, animation: bool = False) -> None:
    """Renders to multilayer EXR files."""
    import importlib

    scene = bpy.context.scene
    importlib.import_module("gonio_extension.compat").use_multilayer_exr(scene.render.image_settings)
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(path)
    assert bpy.ops.render.render(write_still=not animation, animation=animation) == {"FINISHED"}


def read(path) -> dict[str, numpy.ndarray]:
    """Channels of an EXR file by name, "ViewLayer.Combined.R", rows from the top."""
    bpy.utils.expose_bundled_modules()
    import OpenImageIO

    channels = {}
    # Since 5.0 each pass is a part of its own.
    for part in range(OpenImageIO.ImageBuf(str(path)).nsubimages):
        image = OpenImageIO.ImageBuf(str(path), part, 0)
        pixels = image.get_pixels(OpenImageIO.FLOAT)
        channels.update({name: pixels[..., number] for number, name in enumerate(image.spec().channelnames)})
    return channels

"""The Cornell box in Cycles: run by a Python that has `bpy`.

    python cornell_cycles.py VARIANT SAMPLES SEED OUT.npy
"""

import math
import sys
from pathlib import Path

import bpy
import cornell
import mathutils
import numpy
from blender_pixels import pixels
from cycles_settings import unbiased


def main(variant: str, samples: int, seed: int, out: Path) -> None:
    """Renders and saves radiance (height, width, 3), top row first."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = bpy.context.scene
    settings(scene, samples, seed)
    world = bpy.data.worlds.new("black")
    world.node_tree.nodes["Background"].inputs["Strength"].default_value = 0.0
    scene.world = world
    for part in cornell.parts(variant):
        place(scene, part.name, mesh(part), None)
    place(scene, "light", light(), cornell.light_matrix()).visible_camera = True
    scene.camera = place(scene, "camera", camera(), cornell.camera_matrix())
    picture = out.with_suffix(".exr")
    scene.render.filepath = str(picture)
    bpy.ops.render.render(write_still=True)
    numpy.save(out, pixels(picture))


def settings(scene: bpy.types.Scene, samples: int, seed: int) -> None:
    """What this rendering has of its own."""
    unbiased(scene, cornell.MAX_BOUNCES)
    scene.render.resolution_x = scene.render.resolution_y = cornell.RESOLUTION
    scene.cycles.samples, scene.cycles.seed = samples, seed


def place(scene: bpy.types.Scene, name: str, data: bpy.types.ID, matrix: list[list[float]] | None) -> bpy.types.Object:
    """An object of the scene."""
    thing = bpy.data.objects.new(name, data)
    scene.collection.objects.link(thing)
    if matrix is not None:
        thing.matrix_world = mathutils.Matrix(matrix)
    return thing


def mesh(part: cornell.Part) -> bpy.types.Mesh:
    """A mesh with flat faces and its material."""
    made = bpy.data.meshes.new(part.name)
    made.from_pydata(part.points.tolist(), [], part.triangles.tolist())
    made.polygons.foreach_set("use_smooth", [False] * len(made.polygons))
    made.materials.append(material(part))
    return made


def material(part: cornell.Part) -> bpy.types.Material:
    """One shader node into the output."""
    made = bpy.data.materials.new(part.name)
    tree = made.node_tree
    tree.nodes.clear()
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    shader = tree.nodes.new(f"ShaderNodeBsdf{node_name(part.surface)}")
    tree.links.new(shader.outputs[0], output.inputs["Surface"])
    if hasattr(shader, "distribution"):
        # Energy compensation as gonio has it; it has nothing to do at roughness 0.
        shader.distribution = "MULTI_GGX"
    for name, value in sockets(part.surface).items():
        shader.inputs[name].default_value = value
    return made


def node_name(surface: cornell.Surface) -> str:
    """The end of the node's type name; "Anisotropic" is the Glossy node."""
    match surface:
        case cornell.Diffuse():
            return "Diffuse"
        case cornell.Mirror():
            return "Anisotropic"
        case cornell.Glass():
            return "Glass"
        case cornell.Principled():
            return "Principled"


def sockets(surface: cornell.Surface) -> dict[str, float | tuple[float, ...]]:
    """Socket values; Glossy's Color is a constant reflectance."""
    match surface:
        case cornell.Diffuse(reflectance):
            return {"Color": (*reflectance, 1.0), "Roughness": 0.0}
        case cornell.Mirror(reflectance, roughness):
            return {"Color": (reflectance, reflectance, reflectance, 1.0), "Roughness": roughness}
        case cornell.Glass(ior):
            return {"Color": (1.0, 1.0, 1.0, 1.0), "Roughness": 0.0, "IOR": ior}
        case cornell.Principled():
            return {
                "Base Color": (*surface.base_color, 1.0),
                "Roughness": surface.roughness,
                "Metallic": surface.metallic,
                "Specular Tint": (*surface.specular_tint, 1.0),
                "Coat Weight": surface.coat_weight,
                "Coat Roughness": surface.coat_roughness,
            }


def light() -> bpy.types.AreaLight:
    """The ceiling light: Blender's watts P give the radiance P / (pi * area)."""
    made = bpy.data.lights.new("light", "AREA")
    made.shape = "RECTANGLE"
    made.size, made.size_y = cornell.LIGHT_WIDTH, cornell.LIGHT_DEPTH
    made.energy = cornell.LIGHT_RADIANCE * math.pi * cornell.LIGHT_WIDTH * cornell.LIGHT_DEPTH
    made.color = (1.0, 1.0, 1.0)
    made.cycles.max_bounces = cornell.MAX_BOUNCES
    return made


def camera() -> bpy.types.Camera:
    """A pinhole."""
    made = bpy.data.cameras.new("camera")
    made.sensor_fit = "VERTICAL"
    made.angle = math.radians(cornell.CAMERA_FOV)
    made.clip_start = 0.01
    return made


if __name__ == "__main__":
    main(sys.argv[1], int(sys.argv[2]), int(sys.argv[3]), Path(sys.argv[4]))

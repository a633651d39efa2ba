"""Builds ball.blend, a ball with a measured surface under two lamps: `blender -b -P make_measured_ball.py -- brushed.gbsdf ball.blend`.

The measurement is any file that gonio reads; `examples/python/measured_lobes.py` writes one. Also runs with a Python that has bpy and the
extension installed.
"""

import math
import sys
from pathlib import Path

import bpy

ADDON = "bl_ext.user_default.gonio"


def enable() -> None:
    """Switches the extension on, whose node is used; a Blender that has it on keeps it."""
    if ADDON not in bpy.context.preferences.addons:
        bpy.ops.preferences.addon_enable(module=ADDON)


def measured_material(path: Path) -> bpy.types.Material:
    """A Measured BSDF whose tangent follows the UV map."""
    made = bpy.data.materials.new(path.stem)
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    node, end, tangent = (
        tree.nodes.new(f"{name}") for name in ("GonioShaderNodeMeasured", "ShaderNodeOutputMaterial", "ShaderNodeTangent")
    )
    node.filepath = str(path.resolve())
    end.location.x, tangent.location.x = 300.0, -250.0
    tangent.direction_type = "UV_MAP"
    tree.links.new(tangent.outputs[0], node.inputs["Tangent"])
    tree.links.new(node.outputs[0], end.inputs["Surface"])
    print(f"{path.name}: {node.status}")
    return made


def plain_material() -> bpy.types.Material:
    """A matt grey."""
    made = bpy.data.materials.new("Matt")
    made.use_nodes = True
    shader = made.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value, shader.inputs["Roughness"].default_value = (0.3, 0.3, 0.32, 1.0), 1.0
    return made


def lamp(name: str, place, aim, watts: float, size: float) -> None:
    """A square lamp that looks at a point."""
    light = bpy.data.lights.new(name, "AREA")
    light.energy, light.size = watts, size
    thing = bpy.data.objects.new(name, light)
    thing.location = place
    thing.rotation_euler = (thing.location - aim).to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(thing)


def main() -> None:
    """Ball, floor, lamps and camera, and a sky that is hardly there."""
    arguments = sys.argv[sys.argv.index("--") + 1 :] if "--" in sys.argv else sys.argv[1:]
    bpy.ops.wm.read_factory_settings(use_empty=True)
    enable()
    bpy.ops.mesh.primitive_uv_sphere_add(
        segments=96, ring_count=48, radius=1.0, location=(0.0, 0.0, 1.0), rotation=(0.0, math.radians(50.0), 0.0)
    )
    ball = bpy.context.object
    bpy.ops.object.shade_smooth()
    ball.data.materials.append(measured_material(Path(arguments[0])))
    bpy.ops.mesh.primitive_plane_add(size=20.0)
    bpy.context.object.data.materials.append(plain_material())
    lamp("Key", (-3.0, -2.5, 4.0), ball.location, 150.0, 0.8)
    lamp("Rim", (3.5, 1.5, 2.5), ball.location, 60.0, 0.3)
    camera = bpy.data.cameras.new("Camera")
    camera.lens = 60.0
    holder = bpy.data.objects.new("Camera", camera)
    holder.location, holder.rotation_euler = (0.0, -6.0, 2.0), (math.radians(80.5), 0.0, 0.0)
    scene = bpy.context.scene
    scene.collection.objects.link(holder)
    scene.camera = holder
    scene.world = bpy.data.worlds.new("World")
    scene.render.resolution_x = scene.render.resolution_y = 480
    bpy.ops.wm.save_as_mainfile(filepath=str(Path(arguments[1]).resolve()))


main()

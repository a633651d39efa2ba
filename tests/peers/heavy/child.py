"""One heavy scene rendered by one engine of Blender, in a process of its own: `child.py ENGINE JSON`.

Answers a line of JSON: the peak of memory above what the open file takes, seconds of the processor and of the clock.
"""

import importlib.util
import json
import math
import os
import sys
import time
from pathlib import Path

import bpy
import numpy

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "tests/validate")]

from processor import processor_seconds  # noqa: E402

# Triangles of the thing that is placed many times.
PLACED = 200


def main(engine: str, things: str, count: int, threads: int, **how: bool | int) -> None:
    """Makes the file, renders it once and tells what that took."""
    answers = os.fdopen(os.dup(1), "w")
    # Blender prints where it likes.
    os.dup2(2, 1)
    if engine == "GONIO":
        register()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    shown = {"mesh": ground, "objects": objects, "instances": instances}[things](count, **how)
    settings(engine, threads)
    # Nothing that the first render of all brings along counts.
    for thing in shown:
        thing.hide_render = True
    bpy.ops.render.render()
    for thing in shown:
        thing.hide_render = False
    before = status("VmRSS")
    Path("/proc/self/clear_refs").write_text("5")
    used, start = processor_seconds(), time.perf_counter()
    bpy.ops.render.render()
    used, seconds = processor_seconds() - used, time.perf_counter() - start
    told = {"count": count, "peak": status("VmHWM") - before, "left": status("VmRSS") - before, "processor": used, "seconds": seconds}
    answers.write(json.dumps(told) + "\n")
    answers.flush()
    # The file need not be taken down in order.
    os._exit(0)


def register() -> None:
    """Loads the add-on from its source."""
    folder = Path(os.environ.get("GONIO_ADDON", ROOT / "blender-addon"))
    spec = importlib.util.spec_from_file_location("gonio_extension", folder / "__init__.py", submodule_search_locations=[str(folder)])
    sys.modules["gonio_extension"] = made = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(made)
    made.register()


def status(name: str) -> int:
    """Bytes of this process by their name in /proc."""
    line = next(line for line in Path("/proc/self/status").read_text().splitlines() if line.startswith(f"{name}:"))
    return 1024 * int(line.split()[1])


def ground(triangles: int, quads: bool, uv: bool, seam: bool = False) -> list[bpy.types.Object]:
    """Smooth wrinkled ground of about so many triangles, of one material, its UV map torn in the middle by a `seam`."""
    return [placed("ground", wrinkled_mesh("ground", math.isqrt(triangles // 2), quads, uv, seam))]


def objects(triangles: int, each: int) -> list[bpy.types.Object]:
    """Pieces of ground in a square, each an object with a mesh of its own."""
    count = triangles // each
    across, side, made = math.ceil(math.sqrt(count)), math.isqrt(each // 2), []
    for number in range(count):
        thing = placed(f"piece {number}", wrinkled_mesh(f"piece {number}", side, quads=True, uv=False, seam=False))
        thing.scale = 3 * [1.0 / across]
        # Each has its own place in the pattern, so that no two meshes are alike.
        thing.data.attributes["position"].data[0].vector.z += 1e-3 * number
        thing.location = (20.0 * (number % across + 0.5) / across - 10.0, 20.0 * (number // across + 0.5) / across - 10.0, 0.0)
        made.append(thing)
    return made


def instances(count: int) -> list[bpy.types.Object]:
    """A soup of triangles that geometry nodes put on each point of a square."""
    rng = numpy.random.default_rng(1)
    soup = bpy.data.meshes.new("soup")
    corners = (rng.random((PLACED, 1, 3)) + rng.normal(0.0, 0.1, (PLACED, 3, 3))).reshape(-1, 3)
    soup.from_pydata(corners.tolist(), [], numpy.arange(3 * PLACED).reshape(-1, 3).tolist())
    thing = placed("soup", soup)
    thing.hide_render = True
    side = math.isqrt(count)
    field = bpy.data.meshes.new("field")
    field.vertices.add(side * side)
    across = numpy.linspace(-10.0, 10.0, side, dtype="f4")
    x, y = numpy.meshgrid(across, across)
    field.attributes["position"].data.foreach_set("vector", numpy.stack([x, y, 0.0 * x], axis=2).ravel())
    shown = placed("field", field)
    shown.modifiers.new("instances", "NODES").node_group = instancing(thing, 20.0 / side)
    return [shown]


def instancing(thing: bpy.types.Object, size: float) -> bpy.types.NodeTree:
    """Nodes that put a thing of this size on each point."""
    tree = bpy.data.node_groups.new("instances", "GeometryNodeTree")
    for way in ("INPUT", "OUTPUT"):
        tree.interface.new_socket("Geometry", in_out=way, socket_type="NodeSocketGeometry")
    kinds = ("NodeGroupInput", "GeometryNodeMeshToPoints", "GeometryNodeObjectInfo", "GeometryNodeInstanceOnPoints", "NodeGroupOutput")
    given, points, info, put, result = (tree.nodes.new(kind) for kind in kinds)
    info.inputs["Object"].default_value, info.inputs["As Instance"].default_value = thing, True
    put.inputs["Scale"].default_value = 3 * [size]
    tree.links.new(given.outputs[0], points.inputs["Mesh"])
    tree.links.new(points.outputs[0], put.inputs["Points"])
    tree.links.new(info.outputs["Geometry"], put.inputs["Instance"])
    tree.links.new(put.outputs[0], result.inputs[0])
    return tree


def placed(name: str, mesh: bpy.types.Mesh) -> bpy.types.Object:
    """A mesh in the scene."""
    thing = bpy.data.objects.new(name, mesh)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def wrinkled_mesh(name: str, side: int, quads: bool, uv: bool, seam: bool) -> bpy.types.Mesh:
    """Smooth wrinkled ground of so many squares a side."""
    made = bpy.data.meshes.new(name)
    made.vertices.add((side + 1) ** 2)
    made.attributes["position"].data.foreach_set("vector", wrinkled(side).ravel())
    corners, size = faces(side, quads), 4 if quads else 3
    made.loops.add(len(corners))
    made.loops.foreach_set("vertex_index", corners)
    made.polygons.add(len(corners) // size)
    made.polygons.foreach_set("loop_start", numpy.arange(0, len(corners), size, dtype="i4"))
    if uv:
        flat = wrinkled(side)[corners, :2] * numpy.float32(0.05) + numpy.float32(0.5)
        flat[len(flat) // 2 :] += numpy.float32(seam)
        made.uv_layers.new(do_init=False).uv.foreach_set("vector", flat.ravel())
    made.update(calc_edges=True)
    made.shade_smooth()
    made.materials.append(bpy.data.materials.get("ground") or material(uv))
    return made


def wrinkled(side: int) -> numpy.ndarray:
    """Points row by row."""
    x, y = numpy.meshgrid(*(2 * [numpy.linspace(-10.0, 10.0, side + 1, dtype="f4")]))
    z = 0.6 * numpy.sin(0.7 * x + 0.5) * numpy.cos(0.6 * y) + 0.05 * numpy.sin(9.0 * x) * numpy.sin(8.0 * y)
    return numpy.stack([x, y, z.astype("f4")], axis=2).reshape(-1, 3)


def faces(side: int, quads: bool) -> numpy.ndarray:
    """Points of corner after corner."""
    first = (numpy.arange(side, dtype="i4")[:, None] * (side + 1) + numpy.arange(side, dtype="i4")).reshape(-1, 1)
    around = [0, 1, side + 2, side + 1] if quads else [0, 1, side + 2, 0, side + 2, side + 1]
    return (first + numpy.array(around, dtype="i4")).ravel()


def material(uv: bool) -> bpy.types.Material:
    """Blender's own material, with a checkerboard along the UV map if there is one."""
    made = bpy.data.materials.new("ground")
    if bpy.app.version < (5, 0, 0):
        made.use_nodes = True
    if uv:
        nodes, links = made.node_tree.nodes, made.node_tree.links
        checker = nodes.new("ShaderNodeTexChecker")
        links.new(nodes.new("ShaderNodeUVMap").outputs["UV"], checker.inputs["Vector"])
        links.new(checker.outputs["Color"], nodes["Principled BSDF"].inputs["Base Color"])
    return made


def settings(engine: str, threads: int) -> None:
    """A small picture of one sample, lit by the world."""
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.render.resolution_x = scene.render.resolution_y = 64
    scene.render.threads_mode, scene.render.threads = "FIXED", threads
    own = scene.gonio if engine == "GONIO" else scene.cycles
    own.samples = 1
    scene.cycles.device, scene.cycles.use_denoising = "CPU", False
    scene.world = bpy.data.worlds.new("world")
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.location, camera.rotation_euler = (0.0, -14.0, 9.0), (math.radians(58.0), 0.0, 0.0)
    scene.collection.objects.link(camera)
    scene.camera = camera


if __name__ == "__main__":
    main(sys.argv[1], **json.loads(sys.argv[2]))

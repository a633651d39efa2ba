"""One heavy mesh rendered by one engine of Blender, in a process of its own: `child.py ENGINE JSON`.

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


def main(engine: str, triangles: int, quads: bool, uv: bool, threads: int, seam: bool = False) -> None:
    """Makes the file, renders it once and tells what that took."""
    answers = os.fdopen(os.dup(1), "w")
    # Blender prints where it likes.
    os.dup2(2, 1)
    if engine == "GONIO":
        register()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    count = ground(triangles, quads, uv, seam)
    settings(engine, threads)
    # Nothing that the first render of all brings along counts.
    thing = bpy.data.objects["ground"]
    thing.hide_render = True
    bpy.ops.render.render()
    thing.hide_render = False
    before = status("VmRSS")
    Path("/proc/self/clear_refs").write_text("5")
    used, start = processor_seconds(), time.perf_counter()
    bpy.ops.render.render()
    used, seconds = processor_seconds() - used, time.perf_counter() - start
    told = {"triangles": count, "peak": status("VmHWM") - before, "left": status("VmRSS") - before, "processor": used, "seconds": seconds}
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


def ground(triangles: int, quads: bool, uv: bool, seam: bool = False) -> int:
    """Smooth wrinkled ground of about so many triangles, of one material, its UV map torn in the middle by a `seam`; gives how many they are."""
    side = math.isqrt(triangles // 2)
    made = bpy.data.meshes.new("ground")
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
    made.materials.append(material(uv))
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("ground", made))
    return 2 * side * side


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

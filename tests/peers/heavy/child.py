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

ROOT = Path(__file__).resolve().parents[3]
sys.path[:0] = [str(ROOT / "tests/validate"), str(Path(__file__).resolve().parent)]

from processor import processor_seconds  # noqa: E402
from things import MAKERS  # noqa: E402


def main(engine: str, things: str, count: int, threads: int, **how: bool | int) -> None:
    """Makes the file, renders it once and tells what that took."""
    answers = os.fdopen(os.dup(1), "w")
    # Blender prints where it likes.
    os.dup2(2, 1)
    if engine == "GONIO":
        register()
    bpy.ops.wm.read_factory_settings(use_empty=True)
    shown = MAKERS[things](count, **how)
    settings(engine, threads, count if things == "pixels" else 64)
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


def settings(engine: str, threads: int, side: int) -> None:
    """A square picture of one sample, so many pixels wide, lit by the world."""
    scene = bpy.context.scene
    scene.render.engine = engine
    scene.render.resolution_x = scene.render.resolution_y = side
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

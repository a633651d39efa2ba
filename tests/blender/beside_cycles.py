"""The open scene in Cycles and in Gonio, pixel by pixel. Used inside the child process."""

import sys
from pathlib import Path

import bpy
import numpy as np
from recorder import link, material, module

sys.path.append(str(Path(__file__).resolve().parents[1] / "validate"))

from blender_pixels import pixels  # noqa: E402


def scene(width, height=1, *, scale=None, samples=1):
    """An empty scene seen from above through an orthographic camera: a pixel is a metre unless `scale` says how wide the picture is."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    made = bpy.context.scene
    lens = bpy.data.cameras.new("Camera")
    lens.type, lens.ortho_scale, lens.sensor_fit = "ORTHO", scale or width, "HORIZONTAL"
    made.camera = link(bpy.data.objects.new("Camera", lens))
    made.camera.location = (0.0, 0.0, 5.0)
    made.world = bpy.data.worlds.new("World")
    if bpy.app.version < (5, 0, 0):
        made.world.use_nodes = True
    made.world.node_tree.nodes["Background"].inputs["Color"].default_value = (0, 0, 0, 1)
    made.render.resolution_x, made.render.resolution_y, made.render.resolution_percentage = width, height, 100
    made.render.image_settings.file_format, made.render.image_settings.color_depth = "OPEN_EXR", "32"
    made.cycles.samples, made.cycles.use_denoising, made.cycles.use_adaptive_sampling = samples, False, False
    made.cycles.pixel_filter_type = "BOX"
    return made


def shining(name="Shining"):
    """A material of one Emission shader: the material, its tree, and the socket of the colour."""
    made, tree, end = material(name)
    light = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(light.outputs[0], end.inputs["Surface"])
    return made, tree, light.inputs["Color"]


def both(path, *, lines=()):
    """Pictures (height, width, 3) of Cycles and Gonio, the top row first; the report may hold these words' lines alone."""
    shown = []
    for engine in ("CYCLES", "GONIO"):
        made = bpy.context.scene
        made.render.engine = engine
        if engine == "GONIO":
            bpy.ops.gonio.settings_from_cycles()
            made.gonio.use_adaptive_sampling = False
        made.render.filepath = str(path / f"{engine}.exr")
        bpy.ops.render.render(write_still=True)
        shown.append(pixels(path / f"{engine}.exr"))
    found = [line.text for line in module("report").latest().diagnostics]
    assert all(any(word in line for word in lines) for line in found) and (found or not lines), found
    return shown


def close(pair, tolerance=1e-3):
    """Raises where two pictures differ by more than a share of the largest value, or show nothing."""
    cycles, gonio = pair
    most = np.abs(cycles).max()
    worst = np.abs(cycles - gonio).max()
    assert most > 0.0 and worst <= tolerance * max(most, 1.0), (worst, cycles[0, :4], gonio[0, :4])
    return worst

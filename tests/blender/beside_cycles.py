"""The open scene in Cycles and in Gonio, pixel by pixel. Used inside the child process."""

import sys
from pathlib import Path

import bpy
import numpy as np
from recorder import link, material, module

sys.path.append(str(Path(__file__).resolve().parents[1] / "validate"))

from blender_pixels import pixels  # noqa: E402


def scene(width, height=4, *, scale=None, samples=1):
    """An empty scene seen from above through an orthographic camera: a pixel is a metre unless `scale` says how wide the picture is. No
    picture of Blender's has fewer than four rows or columns."""
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
    made.cycles.pixel_filter_type, made.cycles.filter_width = "BOX", 1.0
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
    place = np.unravel_index(np.abs(cycles - gonio).argmax(), cycles.shape)
    assert most > 0.0 and worst <= tolerance * max(most, 1.0), (worst, place, cycles[place], gonio[place])
    return worst


COLUMNS = 40


def board(cases, values, **camera):
    """Squares of a pixel each: a row of values (of the colour attribute `a`) for each material; opens the scene that shows them."""
    count = len(cases) * len(values)
    rows = max(4, -(-count // COLUMNS))
    made = scene(COLUMNS, rows, **camera)
    mesh = bpy.data.meshes.new("Squares")
    place = np.array([divmod(number, COLUMNS)[::-1] for number in range(count)], dtype=np.float32)
    corner = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], dtype=np.float32)
    points = np.zeros((4 * count, 3), dtype=np.float32)
    points[:, :2] = (place[:, None] + corner[None]).reshape(-1, 2)
    mesh.from_pydata(points.tolist(), [], np.arange(4 * count).reshape(-1, 4).tolist())
    colours = np.ones((count, 4), dtype=np.float32)
    colours[:, :3] = np.tile(np.asarray(values, dtype=np.float32).reshape(len(values), -1), (len(cases), 1))
    mesh.attributes.new("a", "FLOAT_COLOR", "CORNER").data.foreach_set("color", np.repeat(colours, 4, axis=0).ravel())
    mesh.uv_layers.new(name="Map").uv.foreach_set("vector", np.tile(corner, (count, 1)).ravel())
    link(bpy.data.objects.new("Squares", mesh))
    made.camera.location = (0.5 * COLUMNS, 0.5 * rows, 5.0)
    for case in cases.values():
        mesh.materials.append(case())
    mesh.polygons.foreach_set("material_index", np.repeat(np.arange(len(cases)), len(values)))
    return made


def differences(pair, cases, count):
    """Of each case of a board the largest difference as a share of the larger of one and the values, and the values where it is; what
    is negative counts as nothing."""
    cycles, gonio = (np.maximum(picture, 0.0)[::-1].reshape(-1, 3)[: len(cases) * count].reshape(len(cases), count, 3) for picture in pair)
    found = {}
    for number, name in enumerate(cases):
        apart = np.abs(cycles[number] - gonio[number]).max(axis=1) / np.maximum(1.0, np.abs(cycles[number]).max(axis=1))
        worst = int(np.where(np.isfinite(apart), apart, np.inf).argmax())
        found[name] = float(apart[worst]), worst, cycles[number, worst], gonio[number, worst]
    return found


def alike(pair, cases, count, tolerance=1e-5):
    """Raises where a case of a board differs by more than the tolerance, or shows black alone."""
    found = differences(pair, cases, count)
    wrong = {name: each for name, each in found.items() if not each[0] <= tolerance}
    assert max(each[2].max() for each in found.values()) > 0.0
    assert not wrong, wrong
    print({name: f"{each[0]:.1e}" for name, each in found.items()})


def fed(node_type, prepare=None, output=0, inputs=(0,)):
    """A maker of materials that shine with a node's output, the board's values at some of its inputs; numbers are their first component."""

    def make():
        made, tree, colour = shining(node_type)
        node, source, parts = (tree.nodes.new(kind) for kind in (node_type, "ShaderNodeVertexColor", "ShaderNodeSeparateXYZ"))
        source.layer_name = "a"
        tree.links.new(source.outputs[0], parts.inputs[0])
        for number in inputs:
            socket = node.inputs[number]
            tree.links.new(parts.outputs[0] if socket.type == "VALUE" else source.outputs[0], socket)
        if prepare is not None:
            prepare(node)
        tree.links.new(node.outputs[output], colour)
        return made

    return make

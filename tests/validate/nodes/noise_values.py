"""Values of Blender's procedural textures as Cycles computes them, as a table that the tests of gonio-nodes read.

    BPY_PYTHON noise_values.py OUT.txt

A point is a small plane whose material emits the node's output; one picture shows all of them. The place comes from attributes of the
face: a node whose inputs are all constants would not reach Cycles, as Blender 5.0 folds it with its own arithmetic. A line holds the node's
name, its settings, place and inputs, and the four outputs: value, red, green, blue.
"""

import itertools
import random
import sys
import tempfile
from pathlib import Path

import bpy
import numpy

CELL = 3
COLUMNS = 64

NOISE_TYPES = ["FBM", "MULTIFRACTAL", "HYBRID_MULTIFRACTAL", "RIDGED_MULTIFRACTAL", "HETERO_TERRAIN"]
NOISE_INPUTS = ["Scale", "Detail", "Roughness", "Lacunarity", "Offset", "Gain", "Distortion"]
WAVE_INPUTS = ["Scale", "Distortion", "Detail", "Detail Scale", "Detail Roughness", "Phase Offset"]


def coordinates(random_numbers: random.Random, reach: float) -> list[float]:
    return [random_numbers.uniform(-reach, reach) for _ in range(4)]


def noise_points(numbers: random.Random):
    """Every type, dimension and way of normalising, each a few times."""
    for kind, dimensions, normalize in itertools.product(NOISE_TYPES, range(1, 5), (True, False)):
        if kind != "FBM" and normalize:
            continue
        for turn in range(4 if kind == "FBM" else 3):
            detail = [0.0, 2.0, numbers.uniform(0, 6), numbers.uniform(3, 17)][turn]
            distortion = [0.0, 0.0, numbers.uniform(-2, 2), numbers.uniform(0, 1)][turn]
            lacunarity = [2.0, 2.0, numbers.uniform(0.5, 2.5), 1.8][turn]
            inputs = [numbers.uniform(0.3, 6), detail, numbers.uniform(0, 1), lacunarity, numbers.uniform(-0.5, 1.5)]
            inputs += [numbers.uniform(0, 2), distortion]
            settings = {"noise_type": kind, "noise_dimensions": f"{dimensions}D", "normalize": normalize}
            yield "ShaderNodeTexNoise", settings, coordinates(numbers, 5), dict(zip(NOISE_INPUTS, inputs, strict=True))
    for dimensions, reach in itertools.product(range(1, 5), (3e5, 3e6, 3e9)):
        settings = {"noise_type": "FBM", "noise_dimensions": f"{dimensions}D", "normalize": True}
        inputs = [1.0, 0.0, 0.5, 2.0, 0.0, 1.0, 0.0]
        yield "ShaderNodeTexNoise", settings, coordinates(numbers, reach), dict(zip(NOISE_INPUTS, inputs, strict=True))


def white_noise_points(numbers: random.Random):
    for dimensions, reach in itertools.product(range(1, 5), (1, 10, 1e6)):
        yield "ShaderNodeTexWhiteNoise", {"noise_dimensions": f"{dimensions}D"}, coordinates(numbers, reach), {}


def wave_points(numbers: random.Random):
    directions = [("BANDS", axis) for axis in ("X", "Y", "Z", "DIAGONAL")] + [("RINGS", axis) for axis in ("X", "Y", "Z", "SPHERICAL")]
    for (kind, axis), profile in itertools.product(directions, ("SIN", "SAW", "TRI")):
        settings = {"wave_type": kind, "wave_profile": profile, f"{kind.lower()}_direction": axis}
        for turn in range(2):
            distortion = [0.0, numbers.uniform(-6, 6)][turn]
            inputs = [numbers.uniform(0.3, 8), distortion, numbers.uniform(0, 5), numbers.uniform(0.2, 3), numbers.uniform(0, 1)]
            inputs += [numbers.uniform(-7, 7)]
            yield "ShaderNodeTexWave", settings, coordinates(numbers, 3), dict(zip(WAVE_INPUTS, inputs, strict=True))


def magic_points(numbers: random.Random):
    for depth, reach in itertools.product(range(11), (2, 40)):
        inputs = {"Scale": numbers.uniform(0.5, 8), "Distortion": numbers.uniform(0.3, 3)}
        yield "ShaderNodeTexMagic", {"turbulence_depth": depth}, coordinates(numbers, reach), inputs
    yield "ShaderNodeTexMagic", {"turbulence_depth": 4}, coordinates(numbers, 2), {"Scale": 5.0, "Distortion": 0.0}
    yield "ShaderNodeTexMagic", {"turbulence_depth": 2}, coordinates(numbers, 1e6), {"Scale": 1.0, "Distortion": 1.0}


def attribute(tree, name: str, output: str):
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_name = name
    return node.outputs[output]


def material(kind: str, settings: dict, inputs: dict, output: str):
    """A material that emits the node's output at the face's place."""
    made = bpy.data.materials.new("point")
    made.use_nodes = True
    tree = made.node_tree
    tree.nodes.clear()
    node = tree.nodes.new(kind)
    for name, value in settings.items():
        setattr(node, name, value)
    if "Vector" in node.inputs:
        tree.links.new(attribute(tree, "place", "Vector"), node.inputs["Vector"])
    if "W" in node.inputs:
        tree.links.new(attribute(tree, "w", "Fac"), node.inputs["W"])
    for name, number in inputs.items():
        if name in node.inputs:
            # Through a node, since sockets hold their values to narrower ranges.
            value = tree.nodes.new("ShaderNodeValue")
            value.outputs[0].default_value = number
            tree.links.new(value.outputs[0], node.inputs[name])
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(next(socket for socket in node.outputs if socket.name in output.split("/")), emission.inputs["Color"])
    end = tree.nodes.new("ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs[0], end.inputs["Surface"])
    return made


def add_plane(number: int, place: list[float], made) -> None:
    x, y = (number % COLUMNS) * CELL, (number // COLUMNS) * CELL
    mesh = bpy.data.meshes.new("point")
    mesh.from_pydata([(x, y, 0), (x + CELL, y, 0), (x + CELL, y + CELL, 0), (x, y + CELL, 0)], [], [(0, 1, 2, 3)])
    mesh.attributes.new("place", "FLOAT_VECTOR", "FACE").data[0].vector = place[:3]
    mesh.attributes.new("w", "FLOAT", "FACE").data[0].value = place[3]
    mesh.materials.append(made)
    bpy.context.scene.collection.objects.link(bpy.data.objects.new("point", mesh))


def render(count: int) -> numpy.ndarray:
    """The picture's values at the planes' middles."""
    scene = bpy.context.scene
    rows = -(-count // COLUMNS)
    width, height = COLUMNS * CELL, rows * CELL
    camera = bpy.data.objects.new("camera", bpy.data.cameras.new("camera"))
    camera.data.type = "ORTHO"
    camera.data.ortho_scale = max(width, height)
    camera.location = (width / 2, height / 2, 10)
    scene.collection.objects.link(camera)
    scene.camera = camera
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.use_denoising, scene.cycles.use_adaptive_sampling = 1, False, False
    scene.cycles.pixel_filter_type = "BOX"
    scene.cycles.sample_clamp_direct = scene.cycles.sample_clamp_indirect = 0
    scene.render.resolution_x, scene.render.resolution_y, scene.render.resolution_percentage = width, height, 100
    scene.view_settings.view_transform = "Raw"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    with tempfile.TemporaryDirectory() as folder:
        scene.render.filepath = str(Path(folder) / "values.exr")
        bpy.ops.render.render(write_still=True)
        picture = bpy.data.images.load(scene.render.filepath)
        picture.colorspace_settings.name = "Non-Color"
        values = numpy.empty(width * height * picture.channels, "f4")
        picture.pixels.foreach_get(values)
    values = values.reshape(height, width, -1)[CELL // 2 :: CELL, CELL // 2 :: CELL, :3]
    return values.reshape(-1, 3)[:count]


def words(values) -> str:
    return " ".join(numpy.format_float_positional(numpy.float32(v), unique=True, trim="-") for v in values)


def main(out: Path) -> None:
    bpy.ops.wm.read_factory_settings(use_empty=True)
    numbers = random.Random(7)
    points = [*noise_points(numbers), *white_noise_points(numbers), *wave_points(numbers), *magic_points(numbers)]
    for number, (kind, settings, place, inputs) in enumerate(points):
        add_plane(2 * number, place, material(kind, settings, inputs, "Fac/Factor/Value"))
        add_plane(2 * number + 1, place, material(kind, settings, inputs, "Color"))
    values = render(2 * len(points))
    lines = []
    for number, (kind, settings, place, inputs) in enumerate(points):
        name = kind.removeprefix("ShaderNodeTex")
        setting = ",".join(str(value) for value in settings.values())
        lines.append(f"{name} {setting} | {words([*place, *inputs.values()])} | {words([values[2 * number][0], *values[2 * number + 1]])}")
    out.write_text("\n".join(lines) + "\n")


main(Path(sys.argv[-1]))

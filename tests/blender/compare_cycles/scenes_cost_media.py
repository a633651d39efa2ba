"""Scenes of media whose cost is compared: a cloud, a street in fog, a glass of milk, smoke with fire."""

import tempfile
from pathlib import Path

import bpy
import numpy
from stage import blank, camera, diffuse, even_world, lamp, link, node, plane, resolution, shape, surface

EDGE = 512
LAMPS = 20


def cloud() -> None:
    """A dense cloud of 512³ voxels in the sun, a clear even sky about it."""
    resolution(192, 160)
    bpy.context.scene.cycles.volume_bounces = 24
    even_world(0.1)
    lamp("SUN", 5.0, (0.0, 0.0, 10.0), (0.6, 0.3, 0.0), angle=0.01)
    grids = stored(f"cloud{EDGE}", lambda: {"density": heap(EDGE)})
    volume("Cloud", grids, 2.0 / EDGE, density=60.0, Color=(0.98, 0.98, 0.98, 1.0), Anisotropy=0.5)
    camera((0.0, -3.2, 0.4), (0.0, 0.0, 0.0), lens=70.0)


def fire() -> None:
    """Thin smoke over a sparse flame that shines as a black body, by an area light."""
    resolution(160, 192)
    bpy.context.scene.cycles.volume_bounces = 4
    even_world(0.02)
    plane(diffuse((0.3, 0.3, 0.3)), size=8.0, location=(0.0, 0.0, -1.0))
    lamp("AREA", 40.0, (2.0, -1.0, 2.0), (0.6, 0.6, 0.3), size=0.5)
    grids = stored("fire128", plume)
    volume("Fire", grids, 2.0 / 128, density=8.0, Blackbody_Intensity=1.0, Temperature=2500.0)
    camera((0.0, -4.5, 0.3), (0.0, 0.0, 0.0), lens=50.0)


def street() -> None:
    """Twenty lamps over a street between houses, in the fog of all space."""
    resolution(256, 128)
    bpy.context.scene.cycles.volume_bounces = 4
    haze = bpy.data.worlds.new("Fog")
    if bpy.app.version < (5, 0, 0):
        haze.use_nodes = True
    tree = haze.node_tree
    tree.nodes.clear()
    scatter = node(tree, "ShaderNodeVolumeScatter", Density=0.04, Anisotropy=0.6)
    node(tree, "ShaderNodeOutputWorld", Volume=scatter.outputs[0])
    bpy.context.scene.world = haze
    plane(diffuse((0.2, 0.2, 0.2)), size=120.0)
    for number in range(12):
        side = 1 if number % 2 else -1
        place = (side * 9.0, 6.0 * number - 6.0, 4.0)
        shape(bpy.ops.mesh.primitive_cube_add, diffuse((0.5, 0.4, 0.3)), size=1.0, location=place, scale=(6.0, 5.0, 8.0))
    for number in range(LAMPS):
        side = 1 if number % 2 else -1
        lamp("SPOT", 400.0, (side * 4.0, 3.0 * number, 5.0), (0.0, side * 0.2, 0.0), shadow_soft_size=0.1, spot_size=2.0, spot_blend=0.3)
    camera((0.0, -12.0, 2.0), (0.0, 20.0, 2.5), lens=35.0)


def milk() -> None:
    """A glass of milk: walls of glass, and within them what scatters more than it absorbs."""
    resolution(160, 192)
    cycles = bpy.context.scene.cycles
    cycles.max_bounces = cycles.transmission_bounces = cycles.volume_bounces = 64
    even_world(0.3)
    plane(diffuse((0.4, 0.3, 0.25)), size=8.0, location=(0.0, 0.0, 0.0))
    lamp("AREA", 120.0, (1.5, -1.5, 2.5), (0.6, 0.5, 0.0), size=0.6)
    cover, tree = blank("Milk")
    skin = node(tree, "ShaderNodeBsdfGlass", IOR=1.35, Roughness=0.0)
    inside = node(tree, "ShaderNodeVolumeCoefficients" if bpy.app.version >= (5, 0, 0) else "ShaderNodeVolumeScatter")
    if bpy.app.version >= (5, 0, 0):
        inside.inputs["Scatter Coefficients"].default_value = (60.0, 58.0, 55.0)
        inside.inputs["Absorption Coefficients"].default_value = (0.02, 0.05, 0.15)
        inside.inputs["Anisotropy"].default_value = 0.7
    else:
        inside.inputs["Density"].default_value, inside.inputs["Anisotropy"].default_value = 60.0, 0.7
    surface(tree, skin)
    tree.links.new(inside.outputs[0], tree.nodes["Material Output"].inputs["Volume"])
    shape(bpy.ops.mesh.primitive_cylinder_add, cover, vertices=96, radius=0.35, depth=0.9, location=(0.0, 0.0, 0.46))
    camera((0.0, -3.0, 1.2), (0.0, 0.0, 0.45), lens=60.0)


def volume(name: str, path: Path, scale: float, density: float, **inputs) -> bpy.types.Object:
    """A volume object of a file's grids, its box about the origin, with a Principled Volume."""
    cover, tree = blank(name)
    shader = node(tree, "ShaderNodeVolumePrincipled", Density=density)
    for key, value in inputs.items():
        shader.inputs[key.replace("_", " ")].default_value = value
    node(tree, "ShaderNodeOutputMaterial", Volume=shader.outputs[0])
    data = bpy.data.volumes.new(name)
    data.filepath = str(path)
    data.materials.append(cover)
    data.render.space = "WORLD"
    return link(name, data, (-1.0, -1.0, -1.0), (0.0, 0.0, 0.0), (scale,) * 3)


def stored(name: str, grids) -> Path:
    """A file of grids by name, one unit a voxel; made once on a machine, since large ones take a while."""
    path = Path(tempfile.gettempdir()) / f"gonio-{name}.vdb"
    if not path.exists():
        bpy.utils.expose_bundled_modules()
        import openvdb

        made = []
        for key, values in grids().items():
            grid = openvdb.FloatGrid()
            grid.copyFromArray(values)
            grid.name = key
            grid.prune()
            made.append(grid)
        part = path.with_suffix(".part.vdb")
        openvdb.write(str(part), grids=made)
        part.rename(path)
    return path


def heap(edge: int) -> numpy.ndarray:
    """A ball of noise: octaves of random numbers between which values go straight, cut off below."""
    random, noise = numpy.random.default_rng(5), numpy.zeros((edge,) * 3, "f4")
    for octave in range(2, 7):
        noise += finer(random.random((2**octave + 1,) * 3, "f4") - 0.5, edge) * 2.0 ** (2 - octave)
    place = numpy.linspace(-1.0, 1.0, edge, dtype="f4")
    distance = numpy.sqrt(place[:, None, None] ** 2 + place[:, None] ** 2 + (1.4 * place) ** 2)
    return numpy.clip(4.0 * (0.62 - distance + 0.6 * noise), 0.0, 1.0)


def finer(values: numpy.ndarray, edge: int) -> numpy.ndarray:
    """The same values on a finer grid, linear between."""
    for axis in range(3):
        place = numpy.linspace(0.0, values.shape[axis] - 1, edge, dtype="f4")
        first = numpy.minimum(place.astype("i4"), values.shape[axis] - 2)
        share = (place - first).reshape([-1 if other == axis else 1 for other in range(3)])
        values = values.take(first, axis) * (1 - share) + values.take(first + 1, axis) * share
    return values


def plume() -> dict[str, numpy.ndarray]:
    """Smoke that widens upwards, and heat in the lower third of its middle."""
    place = numpy.linspace(-1.0, 1.0, 128, dtype="f4")
    x, y, z = numpy.meshgrid(place, place, place, indexing="ij")
    noise = finer(numpy.random.default_rng(3).random((17,) * 3, "f4"), 128)
    away = numpy.hypot(x + 0.1 * numpy.sin(4 * z), y) / (0.25 + 0.2 * (z + 1))
    density = numpy.clip(1.0 - away, 0.0, 1.0) * numpy.clip(2 * noise - 0.5, 0.0, 1.0) * (z < 0.9)
    heat = numpy.clip(1.0 - 1.6 * away, 0.0, 1.0) * numpy.clip(0.2 - z, 0.0, 1.0) * noise
    return {"density": density.astype("f4"), "temperature": (1000.0 * numpy.minimum(2 * heat, 1.0) / 1000.0).astype("f4")}



"""Heavy things in an empty file of Blender; each maker gives the objects that are shown."""

import math
import tempfile
from collections.abc import Callable
from pathlib import Path

import bpy
import numpy

# Triangles of the thing that is placed many times.
PLACED = 200
# Pixels a side of each image.
IMAGE = 1024


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


def lights(count: int) -> list[bpy.types.Object]:
    """Small ground below a square of point lamps that add up to the same power."""
    shown, across = ground(20_000, quads=True, uv=False), math.ceil(math.sqrt(count))
    for number in range(count):
        lamp = bpy.data.lights.new(f"lamp {number}", "POINT")
        lamp.energy, lamp.shadow_soft_size = 1000.0 / count, 0.01
        thing = bpy.data.objects.new(lamp.name, lamp)
        thing.location = (20.0 * (number % across + 0.5) / across - 10.0, 20.0 * (number // across + 0.5) / across - 10.0, 3.0)
        bpy.context.scene.collection.objects.link(thing)
        shown.append(thing)
    return shown


def textures(count: int) -> list[bpy.types.Object]:
    """Squares side by side, each with an image file of its own that nothing has read yet."""
    folder = Path(tempfile.mkdtemp())
    across, shown, values = math.ceil(math.sqrt(count)), [], numpy.ones((IMAGE, IMAGE, 4), dtype="f4")
    values[..., 0], values[..., 1] = numpy.meshgrid(*(2 * [numpy.linspace(0.0, 1.0, IMAGE, dtype="f4")]))
    for number in range(count):
        values[..., 2] = number / count
        made = bpy.data.images.new(f"made {number}", IMAGE, IMAGE)
        made.pixels.foreach_set(values.ravel())
        made.filepath_raw, made.file_format = str(folder / f"{number}.png"), "PNG"
        made.save()
        bpy.data.images.remove(made)
        image = bpy.data.images.load(str(folder / f"{number}.png"))
        mesh = wrinkled_mesh(f"square {number}", 1, quads=True, uv=True, seam=False)
        mesh.materials[0] = pictured(image)
        thing = placed(f"square {number}", mesh)
        thing.scale = 3 * [1.0 / across]
        thing.location = (20.0 * (number % across + 0.5) / across - 10.0, 20.0 * (number // across + 0.5) / across - 10.0, 0.0)
        shown.append(thing)
    return shown


def pictured(image: bpy.types.Image) -> bpy.types.Material:
    """A material with an image for its colour."""
    made = bpy.data.materials.new(image.name)
    if bpy.app.version < (5, 0, 0):
        made.use_nodes = True
    node = made.node_tree.nodes.new("ShaderNodeTexImage")
    node.image = image
    made.node_tree.links.new(node.outputs["Color"], made.node_tree.nodes["Principled BSDF"].inputs["Base Color"])
    return made


def pixels(side: int) -> list[bpy.types.Object]:
    """Small ground for pictures of many pixels."""
    return ground(20_000, quads=True, uv=False)


MAKERS: dict[str, Callable[..., list[bpy.types.Object]]] = {
    "mesh": ground,
    "objects": objects,
    "instances": instances,
    "lights": lights,
    "textures": textures,
    "pixels": pixels,
}

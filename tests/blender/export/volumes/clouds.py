"""Volume objects that tests show. Used inside the child process."""

import bpy
import numpy as np
from recorder import link

SIZE = 12


def openvdb():
    """Blender's own module for VDB files."""
    bpy.utils.expose_bundled_modules()
    import openvdb

    return openvdb


def ball(edge=SIZE):
    """Numbers that fall from 1 in the middle to 0 before the faces."""
    place = np.arange(edge, dtype=np.float32) - 0.5 * (edge - 1)
    x, y, z = np.meshgrid(place, place, place, indexing="ij")
    return np.maximum(0.0, 1.0 - np.sqrt(x * x + y * y + z * z) / (0.45 * edge)).astype(np.float32)


def stored(path, voxel=0.25, corner=(0, 0, 0), **grids):
    """Writes a file of grids by name, numbers or vectors."""
    vdb, made = openvdb(), []
    for name, values in grids.items():
        grid = vdb.FloatGrid() if values.ndim == 3 else vdb.Vec3SGrid()
        grid.copyFromArray(values, ijk=corner)
        grid.name, grid.transform = name, vdb.createLinearTransform(voxelSize=voxel)
        made.append(grid)
    vdb.write(str(path), grids=made)
    return path


def cloud(path, material=None, name="Cloud"):
    """A volume object that shows a file."""
    data = bpy.data.volumes.new(name)
    data.filepath = str(path)
    if material is not None:
        data.materials.append(material)
    return link(bpy.data.objects.new(name, data))


def filled(kind, name="Smoke", **inputs):
    """A material of one volume shader: the material, its tree and the shader."""
    from recorder import material

    made, tree, end = material(name)
    shader = tree.nodes.new(f"ShaderNode{kind}")
    for key, value in inputs.items():
        shader.inputs[key.replace("_", " ")].default_value = value
    tree.links.new(shader.outputs[0], end.inputs["Volume"])
    return made, tree, shader


def attribute(tree, name):
    """An Attribute node's number."""
    node = tree.nodes.new("ShaderNodeAttribute")
    node.attribute_name = name
    return node.outputs["Fac"]


def exported():
    """The exporter, its recorder after a first sync, and the lines of the report."""
    from recorder import depsgraph, exporter

    made, report = exporter()
    scene = made.sync(depsgraph())
    return made, scene, [line.text for line in report.diagnostics]


def followed(exporter):
    """Has an exporter follow all edits and frames, as a viewport does; what came out different last comes first."""
    found = []

    def update(scene, depsgraph):
        found.insert(0, exporter.update(depsgraph))

    bpy.app.handlers.depsgraph_update_post.append(update)
    bpy.app.handlers.frame_change_post.append(update)
    return found

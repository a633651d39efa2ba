# SPDX-License-Identifier: GPL-3.0-or-later
"""A Blender mesh as the arrays of `gonio.Scene.put_mesh`; raw attributes, so that little happens a vertex in Python."""

import numpy as np

from .material.inputs import PARAMETRIC, SMOOTH_NORMAL, TANGENT, TRIANGLE, UV
from .mesh_attributes import active_uv, spread_out, vertex_normals, wanted
from .mesh_values import PARAMETRIC_CORNERS, apart, corner_points
from .modelled_normals import modelled_normals
from .row import first_corners, integers
from .tangents import tangents
from .transforms import unit

# From faces of so many triangles on, Blender's own normals of points take longer than all the rest.
MANY_TRIANGLES = 5000


def mesh_arguments(mesh, primvars, cut=None):
    """The arguments of `put_mesh` with the named values that materials want; None for a mesh without faces. A mesh that was cut of faces has
    their normals: `cut` says which (`modelled`)."""
    are_triangles = len(mesh.loops) == 3 * len(mesh.polygons)
    if not are_triangles:
        mesh.calc_loop_triangles()
    # Blender would keep the triangles, which are the faces.
    count = len(mesh.polygons) if are_triangles else len(mesh.loop_triangles)
    if count == 0:
        return None
    points = np.empty((len(mesh.vertices), 3), dtype=np.float32)
    mesh.attributes["position"].data.foreach_get("vector", points.reshape(-1))
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.attributes[".corner_vert"].data.foreach_get("value", corners)
    faces = np.arange(count, dtype=np.int32) if are_triangles else _faces(mesh, count)
    # The scene tells points from corners by their number: where both are as many, each corner gets a point of its own.
    spread = corners if len(points) == len(corners) else None
    arguments = {
        "points": spread_out(points, spread),
        "triangles": _triangles(mesh, count),
        "corners": corners if spread is None else None,
        "faces": faces,
        "normals": _normals_as_modelled(mesh, corners, cut) if cut else None,
        "slots": _slots(mesh),
        "primvars": {**_uv_maps(mesh, primvars), **wanted(mesh, points, primvars, spread)},
    }
    if arguments["normals"] is None:
        arguments["normals"] = _normals(mesh, spread, points, corners, faces)
    _add_tangents(arguments, mesh, corners, primvars, cut)
    own = [name for name in (PARAMETRIC, *TRIANGLE) if name in primvars]
    return _with_triangles_own(arguments, own) if own else arguments


def _add_tangents(arguments, mesh, corners, primvars, cut):
    """Adds the normals in the mesh's own space, and tangents, where they are wanted."""
    names = [name for name in primvars if name.startswith(TANGENT)]
    if SMOOTH_NORMAL not in primvars and not names:
        return
    normals = arguments["normals"]
    if cut and normals is not None:
        normals = unit(normals)
    if normals is None:
        facing, lengths = np.empty((len(mesh.polygons), 3), dtype=np.float32), np.empty(len(mesh.polygons), dtype=np.int32)
        mesh.polygon_normals.foreach_get("vector", facing.reshape(-1))
        mesh.polygons.foreach_get("loop_total", lengths)
        normals = np.repeat(facing, lengths, axis=0)
    arguments["primvars"][SMOOTH_NORMAL] = normals
    points, per_corner = arguments["points"], normals if len(normals) == len(corners) else normals[corners]
    of_points = np.arange(len(corners)) if arguments["corners"] is None else corners
    for name in names:
        layer = mesh.uv_layers.get(name.removeprefix(TANGENT)) if name != TANGENT + UV else mesh.uv_layers.get(active_uv(mesh) or "")
        if layer is not None:
            uv = np.empty((len(corners), 2), dtype=np.float32)
            layer.uv.foreach_get("vector", uv.reshape(-1))
            arguments["primvars"][name] = tangents(points, per_corner, uv, of_points, arguments["triangles"])


def _with_triangles_own(arguments, names):
    """The arguments with values that differ from triangle to triangle."""
    arguments = apart(arguments)
    for name in names:
        number = TRIANGLE.index(name) if name in TRIANGLE else None
        values = np.tile(PARAMETRIC_CORNERS, (len(arguments["triangles"]), 1)) if number is None else corner_points(arguments, number)
        arguments["primvars"][name] = np.ascontiguousarray(values)
    return arguments


def triangle_loops(mesh):
    """Corner numbers of each triangle (T, 3) of a mesh whose triangles were computed."""
    return _triangles(mesh, len(mesh.loop_triangles))


def _triangles(mesh, count):
    """Corner numbers of each triangle."""
    if count == len(mesh.polygons):
        return np.arange(3 * count, dtype=np.int32).reshape(-1, 3)
    row = integers(mesh.loop_triangles, 3)
    if row is not None and all(tuple(row[number]) == tuple(mesh.loop_triangles[number].loops) for number in (0, count - 1)):
        return row.copy()
    triangles = np.empty((count, 3), dtype=np.int32)
    mesh.loop_triangles.foreach_get("loops", triangles.reshape(-1))
    return triangles


def _faces(mesh, count):
    """The face of each triangle."""
    starts = first_corners(mesh)
    sizes = np.append(starts[1:], np.int32(len(mesh.loops))) - starts
    faces = np.repeat(np.arange(len(starts), dtype=np.int32), sizes - 2)
    if len(faces) != count:
        # Blender would keep these.
        faces = np.empty(count, dtype=np.int32)
        mesh.loop_triangle_polygons.foreach_get("value", faces)
    return faces


def _normals_as_modelled(mesh, corners, cut):
    """Normals of corners between those of the faces that the mesh was cut of, flat faces left out; None where there are none."""
    normals = None if mesh.normals_domain == "FACE" else modelled_normals(corners, vertex_normals(mesh), *cut)
    flat = mesh.attributes.get("sharp_face")
    if normals is not None and flat is not None:
        own = np.empty((len(corners), 3), dtype=np.float32)
        mesh.corner_normals.foreach_get("vector", own.reshape(-1))
        of_faces = np.empty(len(mesh.polygons), dtype=bool)
        flat.data.foreach_get("value", of_faces)
        normals = np.where(np.repeat(of_faces, 4)[:, None], own, normals)
    return normals


def _normals(mesh, spread, points, corners, faces):
    """Normals of corners or points; None for flat faces."""
    if mesh.normals_domain == "FACE":
        return None
    if mesh.normals_domain == "CORNER":
        normals = np.empty((len(mesh.loops), 3), dtype=np.float32)
        mesh.corner_normals.foreach_get("vector", normals.reshape(-1))
        return normals
    # Triangles of a face follow one another.
    if (faces[MANY_TRIANGLES:] == faces[:-MANY_TRIANGLES]).any():
        return spread_out(_point_normals(mesh, points, corners), spread)
    return spread_out(vertex_normals(mesh), spread)


def _point_normals(mesh, points, corners):
    """Blender's normals of points, those of the faces around weighted by their angles, in a time that does not grow with the square of
    a face's corners as Blender's does."""
    count = len(mesh.polygons)
    first, length, facing = np.empty(count, dtype=np.int32), np.empty(count, dtype=np.int32), np.empty((count, 3), dtype=np.float32)
    mesh.polygons.foreach_get("loop_start", first)
    mesh.polygons.foreach_get("loop_total", length)
    mesh.polygon_normals.foreach_get("vector", facing.reshape(-1))
    after, before = np.arange(1, len(corners) + 1), np.arange(-1, len(corners) - 1)
    after[first + length - 1], before[first] = first, first + length - 1
    ahead, back = (unit(points[corners[other]] - points[corners]) for other in (after, before))
    angles = np.arccos(np.clip(np.einsum("ij,ij->i", ahead, back), -1.0, 1.0))
    weighted = np.repeat(facing, length, axis=0) * angles[:, None]
    summed = [np.bincount(corners, weighted[:, axis], minlength=len(points)) for axis in range(3)]
    return np.ascontiguousarray(unit(np.stack(summed, axis=1)), dtype=np.float32)


def _slots(mesh):
    """The material slot of each face, the last where it names none that there is; None if all have the first."""
    attribute = mesh.attributes.get("material_index")
    if attribute is None or attribute.domain != "FACE" or attribute.data_type != "INT":
        return None
    slots = np.empty(len(mesh.polygons), dtype=np.int32)
    attribute.data.foreach_get("value", slots)
    slots.clip(0, max(len(mesh.materials) - 1, 0), out=slots)
    return slots if slots.any() else None


def _uv_maps(mesh, primvars):
    """Every UV map by its name; the one that renders as the usual coordinates, and by its name too if a material asks for it."""
    maps = {}
    for layer in mesh.uv_layers:
        values = np.empty((len(mesh.loops), 2), dtype=np.float32)
        layer.uv.foreach_get("vector", values.reshape(-1))
        if layer.active_render:
            maps[UV] = values
        if not layer.active_render or layer.name in primvars:
            maps[layer.name] = values
    return maps

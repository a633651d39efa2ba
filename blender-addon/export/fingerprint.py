# SPDX-License-Identifier: GPL-3.0-or-later
"""A number that differs for meshes that differ: over the bytes of positions, corners and attributes as they lie in Blender's memory."""

from ctypes import string_at

from .material.inputs import ISLAND
from .mesh_attributes import active_uv, read
from .row import address, first_corners

# Data types of attributes that surfaces show or normals follow -> bytes of an element.
SIZES = {
    "FLOAT": 4,
    "INT": 4,
    "INT8": 1,
    "BOOLEAN": 1,
    "FLOAT_VECTOR": 12,
    "FLOAT2": 8,
    "FLOAT_COLOR": 16,
    "BYTE_COLOR": 4,
    # Normals of the user's own.
    "INT16_2D": 4,
}
# What is selected shows nowhere.
SELECTED = (".select", ".uv_select")
# Edges themselves, which faces tell as well.
EDGES = ".edge_verts"
# Bytes that are hashed at a time: so many stay in a cache on their way.
CHUNK = 1 << 18


def fingerprint(mesh, primvars):
    """The number of a mesh of which materials want these values. Nothing is computed of it."""
    shown = [(each, each.name, each.domain) for each in mesh.attributes if not each.name.startswith(SELECTED)]
    # In which order edges are is seen by what belongs to them alone.
    has_edges = ISLAND in primvars or any(domain == "EDGE" and name != EDGES for _, name, domain in shown)
    parts = [len(mesh.vertices), len(mesh.polygons), mesh.normals_domain, active_uv(mesh)]
    for attribute, name, domain in shown:
        kind, elements = attribute.data_type, attribute.data
        size = None if name == ".corner_edge" and not has_edges else SIZES.get(kind)
        parts.append((name, domain, kind, len(elements) if size is None else _hash(elements, size, lambda: read(attribute))))
    if len(mesh.loops) != 3 * len(mesh.polygons):
        parts.append(_hash(mesh.polygons, 4, lambda: first_corners(mesh)))
    return hash((*parts, tuple(mesh.texspace_location), tuple(mesh.texspace_size)))


def _hash(elements, size, otherwise):
    """A number for elements of so many bytes that lie in a row; where they do not, for an array in their place, or None."""
    first = address(elements, size)
    if first is not None:
        return _hash_of_memory(first, size * len(elements))
    values = otherwise() if len(elements) else None
    return None if values is None else _hash_of_memory(values.ctypes.data, values.nbytes)


def _hash_of_memory(first, length):
    if length <= CHUNK:
        return hash(string_at(first, length))
    return hash(tuple(hash(string_at(first + start, min(CHUNK, length - start))) for start in range(0, length, CHUNK)))

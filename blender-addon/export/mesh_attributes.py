# SPDX-License-Identifier: GPL-3.0-or-later
"""Named values of a mesh: its attributes, and what Cycles computes of it for nodes that ask."""

import numpy as np

from .colour_management import colours_to_rec709
from .material.inputs import ACTIVE_COLOUR, ALPHA, COMPUTED, FACTOR, GENERATED, ISLAND, POINTINESS, POSITION, TANGENT
from .mesh_values import edges_of, edges_to_points, islands, pointiness

# Data type of an attribute -> (property to read, numbers in it, numpy type).
ATTRIBUTES = {
    "FLOAT": ("value", 1, np.float32),
    "INT": ("value", 1, np.int32),
    "INT8": ("value", 1, np.int32),
    "BOOLEAN": ("value", 1, bool),
    "FLOAT_VECTOR": ("vector", 3, np.float32),
    "FLOAT2": ("vector", 2, np.float32),
    "FLOAT_COLOR": ("color", 4, np.float32),
    # Blender decodes bytes to linear values here.
    "BYTE_COLOR": ("color", 4, np.float32),
}


def read(attribute):
    """The values of an attribute as (elements, numbers), or None for types that no shader can use."""
    form = ATTRIBUTES.get(attribute.data_type)
    if form is None:
        return None
    name, width, dtype = form
    values = np.empty(len(attribute.data) * width, dtype=dtype)
    attribute.data.foreach_get(name, values)
    values = values.reshape(-1, width)
    return colours_to_rec709(values) if name == "color" else values


def active_uv(mesh):
    """Name of the UV map that renders, None if there is none."""
    return next((layer.name for layer in mesh.uv_layers if layer.active_render), None)


def vertex_normals(mesh):
    """Blender's normals of points."""
    normals = np.empty((len(mesh.vertices), 3), dtype=np.float32)
    mesh.vertex_normals.foreach_get("vector", normals.reshape(-1))
    return normals


def spread_out(values, corners):
    """Values of points as values of corners, if that is asked for."""
    return values if corners is None else np.ascontiguousarray(values[corners])


def wanted(mesh, points, primvars, spread):
    """The other named values that materials want of this mesh, as far as it has them."""
    found = {}
    for name in primvars:
        if name == POSITION:
            found[name] = spread_out(points, spread)
        elif name == GENERATED:
            found[name] = spread_out(_generated(mesh), spread)
        elif name == POINTINESS:
            found[name] = spread_out(as_shader_value(pointiness(points, vertex_normals(mesh), edges_of(mesh))[:, None]), spread)
        elif name == ISLAND:
            found[name] = spread_out(as_shader_value(islands(len(points), edges_of(mesh))[:, None]), spread)
        elif name not in COMPUTED:
            attribute = _attribute(mesh, name)
            # A UV map is there already.
            if attribute is not None and (attribute.name not in mesh.uv_layers or name != attribute.name):
                values = _part(read(attribute), name)
                if values is not None:
                    found[name] = _placed(mesh, attribute, values, spread)
    return found


def _part(values, name):
    """The values themselves, or what they are as one number or as alpha: the mean of colours and vectors of three, the first of two, 1."""
    if values is None or not name.startswith((FACTOR, ALPHA)):
        return values
    width = values.shape[1]
    if name.startswith(FACTOR):
        return values[:, :3].mean(axis=1, keepdims=True) if width > 2 else values[:, :1]
    return values[:, 3:] if width > 3 else np.ones((len(values), 1), dtype=np.float32)


def part_of_attribute(attributes, name):
    """What a name asks for of attributes that are of points or curves; None if they have no such."""
    attribute = attributes.get(name) or attributes.get(name.removeprefix(FACTOR).removeprefix(ALPHA))
    return None if attribute is None else _part(read(attribute), name)


def _placed(mesh, attribute, values, spread):
    """Values of points or corners; those of faces are given to their corners, whose number cannot be mistaken, those of edges to points."""
    if attribute.domain == "EDGE":
        values = edges_to_points(values, edges_of(mesh), len(mesh.vertices), attribute.data_type)
    values = as_shader_value(values)
    if attribute.domain == "FACE":
        lengths = np.empty(len(mesh.polygons), dtype=np.int32)
        mesh.polygons.foreach_get("loop_total", lengths)
        return np.repeat(values, lengths, axis=0)
    return values if attribute.domain == "CORNER" else spread_out(values, spread)


def present(mesh, primvars):
    """Which of these names the mesh can give."""
    return [name for name in primvars if name in COMPUTED or name.startswith(TANGENT) or _attribute(mesh, name) is not None]


def _attribute(mesh, name):
    if name != ACTIVE_COLOUR:
        return mesh.attributes.get(name) or mesh.attributes.get(name.removeprefix(FACTOR).removeprefix(ALPHA))
    number = mesh.color_attributes.render_color_index
    return mesh.color_attributes[number] if 0 <= number < len(mesh.color_attributes) else None


def as_shader_value(values):
    """One number fills a colour with alpha 1, as Blender converts it."""
    values = np.ascontiguousarray(values, dtype=np.float32)
    if values.shape[1] == 1:
        return np.concatenate([np.repeat(values, 3, axis=1), np.ones_like(values)], axis=1)
    return values


def _generated(mesh):
    """Positions before modifiers deformed them over the texture space's box, 0 to 1. Blender keeps them for final renders alone; otherwise
    positions stand for them, as in Cycles."""
    points = np.empty((len(mesh.vertices), 3), dtype=np.float32)
    mesh.vertices.foreach_get("undeformed_co", points.reshape(-1))
    centre, size = np.array(mesh.texspace_location), np.array(mesh.texspace_size)
    size = np.where(size == 0.0, 1.0, size)
    return ((points - (centre - size)) / (2.0 * size)).astype(np.float32)

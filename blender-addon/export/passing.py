# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes to read from, whose memory goes with them."""

from contextlib import contextmanager

# What smaller meshes leave is less than the time is worth.
FEW_POINTS = 1 << 14


@contextmanager
def passing(group):
    """The mesh of a group. Evaluated meshes share their arrays with those of the file, until Python looks at one: as it might write, Blender
    copies the array first, and keeps it. Those of a mesh that is made for reading are gone after it."""
    source, data = group.source, group.data
    # What nodes made is no object's own, and nothing else has its arrays.
    if len(data.vertices) < FEW_POINTS or source.type != "MESH" or source.data != data:
        yield data
        return
    try:
        yield source.to_mesh()
    finally:
        source.to_mesh_clear()

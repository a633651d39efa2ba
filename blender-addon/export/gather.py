# SPDX-License-Identifier: GPL-3.0-or-later
"""One walk over everything that the depsgraph shows: placements grouped by what is placed."""

from dataclasses import dataclass, field

import bpy
import numpy as np

from .random_number import of_name
from .visibility import combined, is_ordinary, ray_visibility

# Objects whose surface Blender turns into a mesh on demand.
AS_MESH = {"CURVE", "SURFACE", "FONT", "META"}
# Kinds of object that show nothing by themselves.
SILENT = {"EMPTY", "CAMERA", "ARMATURE", "LATTICE", "SPEAKER", "LIGHT_PROBE"}


@dataclass
class Group:
    """Placements of one thing: the object it came from, its data, and the rows of the walk."""

    name: str
    object_uid: int
    data_uid: int
    kind: str
    data: object
    source: object
    visibility: dict
    pass_index: int
    slots: list
    rows: list = field(default_factory=list)
    matrices: np.ndarray | None = None
    random: np.ndarray | None = None


def gather(depsgraph):
    """The groups of a depsgraph, with their matrices (N, 4, 4)."""
    groups, parents = {}, _special_parents(depsgraph)
    count = 0
    for row, item in enumerate(depsgraph.object_instances):
        thing = item.object
        data = thing.data
        key = (hash(thing.original), 0 if data is None else data.session_uid)
        if parents and item.is_instance and item.parent.original.session_uid in parents:
            key = (*key, item.parent.original.session_uid)
        group = groups.get(key)
        if group is None:
            group = groups[key] = _group(depsgraph, item, thing, data, parents.get(key[2]) if len(key) > 2 else None)
        if group is not None:
            group.rows.append(row)
        count = row + 1
    found = _once([group for group in groups.values() if group is not None])
    _drop_hidden_instancers(depsgraph, found)
    _fill(depsgraph, found, count)
    return [group for group in found if group.rows]


def _group(depsgraph, item, thing, data, parent):
    if thing.type in SILENT or data is None:
        return None
    original = thing.original
    seen = ray_visibility(original, depsgraph.view_layer)
    return Group(
        name=original.name,
        object_uid=original.session_uid,
        data_uid=data.session_uid,
        kind="LIGHT" if thing.type == "LIGHT" else "MESH" if isinstance(data, bpy.types.Mesh) else thing.type,
        data=data,
        source=original.evaluated_get(depsgraph),
        visibility=seen if parent is None else combined(seen, parent),
        pass_index=thing.pass_index,
        slots=[slot.material for slot in thing.material_slots] or list(getattr(data, "materials", [])),
    )


def _once(groups):
    """Leaves out curves, texts and the like whose mesh the depsgraph lists too."""
    meshes = {group.object_uid for group in groups if group.kind == "MESH"}
    return [group for group in groups if group.kind not in AS_MESH or group.object_uid not in meshes]


def _special_parents(depsgraph):
    """Instancers with switches of their own, by session_uid: their instances are grouped apart."""
    special = {}
    for thing in depsgraph.objects:
        if thing.is_instancer or thing.particle_systems or thing.modifiers:
            seen = ray_visibility(thing.original, depsgraph.view_layer)
            if not is_ordinary(seen):
                special[thing.original.session_uid] = seen
    return special


def _drop_hidden_instancers(depsgraph, groups):
    """Instancers may be hidden themselves; only those few groups are asked row by row."""
    suspects = {row: group for group in groups if group.source.is_instancer or group.source.particle_systems for row in group.rows}
    if not suspects:
        return
    hidden = {row for row, item in enumerate(depsgraph.object_instances) if row in suspects and not item.show_self}
    for group in {id(group): group for group in suspects.values()}.values():
        group.rows = [row for row in group.rows if row not in hidden]


def _fill(depsgraph, groups, count):
    flat = np.empty(count * 16, dtype=np.float32)
    depsgraph.object_instances.foreach_get("matrix_world", flat)
    # Blender gives columns; the scene wants rows.
    matrices = flat.reshape(-1, 4, 4).transpose(0, 2, 1)
    for group in groups:
        group.matrices = np.ascontiguousarray(matrices[group.rows])


def fill_random(depsgraph, groups):
    """Adds each placement's random number, 0 to 1, as Cycles' Object Info gives it."""
    if not groups:
        return
    flat = np.empty(sum(1 for _ in depsgraph.object_instances), dtype=np.uint32)
    depsgraph.object_instances.foreach_get("random_id", flat)
    for group in groups:
        numbers = flat[group.rows]
        # What is no instance has no number in Blender.
        numbers = np.where(numbers == 0, np.uint32(of_name(group.name)), numbers)
        group.random = (numbers.astype(np.float64) / 0xFFFFFFFF).astype(np.float32)

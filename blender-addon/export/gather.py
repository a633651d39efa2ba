# SPDX-License-Identifier: GPL-3.0-or-later
"""One walk over everything that the depsgraph shows: placements grouped by what is placed."""

from dataclasses import dataclass, field, replace

import bpy
import numpy as np

from .dicing import dicing_of
from .linking import Named
from .random_number import of_name
from .transforms import usable
from .visibility import Visibility, combined, is_ordinary

# Objects whose surface Blender turns into a mesh on demand.
AS_MESH = {"CURVE", "SURFACE", "FONT", "META"}
# Kinds of object that show nothing by themselves.
# The kind of groups that are the hair of particle systems.
HAIR = "HAIR"
# The kind of groups that grids fill.
VOLUME = "VOLUME"
SILENT = {"EMPTY", "CAMERA", "ARMATURE", "LATTICE", "SPEAKER", "LIGHT_PROBE"}


@dataclass(slots=True)
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
    # Name of the topmost parent, by which asset mattes go.
    asset: str
    # The materials' session_uids, 0 for none.
    slots: tuple
    # What links know it by: its instancer where a collection of receivers or blockers names that, else the object.
    receiver_uid: int
    blocker_uid: int
    # Whether the first row is the object itself.
    is_itself: bool
    rows: list
    matrices: np.ndarray | None = None
    # Which placements can be shown; None if all can.
    kept: np.ndarray | None = None
    random: np.ndarray | None = None
    # What the instancer gives each placement, by name.
    instancer: dict = field(default_factory=dict)
    # How finely the renderer cuts the mesh, as the arguments of `set_dicing`.
    dicing: tuple | None = None
    # The group of the hair of its particle systems, if there is any.
    hair: "Group | None" = None
    # Whether a field that goes by its place fills it.
    is_filled: bool = False


class Walk:
    """What a depsgraph shows, or a part of it: the groups, with their matrices (N, 4, 4), and the materials of their slots by session_uid."""

    def __init__(self, depsgraph, report, part=None):
        self.groups, self.materials = [], {}
        self._part, self._depsgraph, self._visibility = part, depsgraph, Visibility(depsgraph)
        self._named = Named()
        groups, parents, count = {}, None, 0
        for row, item in enumerate(depsgraph.object_instances):
            count = row + 1
            # Instancers may be hidden themselves, and their hair may be seen.
            is_shown = item.show_self
            if not (is_shown or item.show_particles) or (part is not None and not part.shows(item)):
                continue
            thing = item.object
            original, data = thing.original, thing.data
            key, parent = (hash(original), 0 if data is None else data.session_uid), None
            if parents != {} and item.is_instance:
                parents = self._special_parents() if parents is None else parents
                if (uid := item.parent.original.session_uid) in parents:
                    key, parent = (*key, uid), parents[uid]
            if not is_shown:
                key = (*key, HAIR)
            group = groups.get(key, self)
            if group is self:
                groups[key] = None
                with report.guard("Object", original.name, "it is left out"):
                    groups[key] = self._shown(item, thing, original, data, parent, row)
            elif group is not None:
                group.rows.append(row)
                if group.hair is not None:
                    group.hair.rows.append(row)
        shown = [group for group in groups.values() if group is not None]
        self.groups = _once(shown) + [group.hair for group in shown if group.hair is not None]
        _fill(depsgraph, self.groups, count, part)

    def _shown(self, item, thing, original, data, parent, row):
        """The group of a thing, with that of its hair, or the latter alone."""
        group = self._group(item, thing, original, data, parent, row)
        has_hair = group is not None and item.show_particles and len(thing.particle_systems) > 0
        hair = replace(group, kind=HAIR, rows=list(group.rows)) if has_hair else None
        if not item.show_self:
            return hair
        if hair is not None:
            group.hair = hair
        return group

    def _special_parents(self):
        """Instancers with switches or links of their own, by session_uid: their instances are grouped apart."""
        self._named, special = Named(self._depsgraph.objects), {}
        for thing in self._depsgraph.objects:
            if thing.is_instancer or thing.particle_systems or thing.modifiers:
                uid, seen = thing.original.session_uid, self._visibility.of(thing)
                if not is_ordinary(seen) or uid in self._named.receivers or uid in self._named.blockers:
                    special[uid] = seen
        return special

    def _group(self, item, thing, original, data, parent, row):
        kind = thing.type
        if kind in SILENT or data is None:
            return None
        is_instance = item.is_instance
        seen = self._visibility.of(thing)
        placed_by = item.parent.original.session_uid if is_instance else 0
        return Group(
            original.name,
            original.session_uid,
            data.session_uid,
            _kind(thing, data),
            data,
            # What the walk gives for an instance is gone after it.
            original.evaluated_get(self._depsgraph) if is_instance else thing,
            seen if parent is None else combined(seen, parent),
            thing.pass_index,
            _topmost(original).name,
            self._slots(thing, data),
            placed_by if placed_by in self._named.receivers else original.session_uid,
            placed_by if placed_by in self._named.blockers else original.session_uid,
            not is_instance,
            [row],
            dicing=None if self._part is not None else dicing_of(thing, self._depsgraph),
        )

    def _slots(self, thing, data):
        uids = []
        for material in [slot.material for slot in thing.material_slots] or getattr(data, "materials", ()):
            uid = 0 if material is None else material.original.session_uid
            self.materials[uid] = material
            uids.append(uid)
        return tuple(uids)


def _kind(thing, data):
    """What is shown of an object: geometry nodes give it others, and simulations of smoke fill what looks like a mesh."""
    if thing.type == "LIGHT":
        return "LIGHT"
    if isinstance(data, bpy.types.Volume) or domain_of(thing) is not None:
        return VOLUME
    return "MESH" if isinstance(data, bpy.types.Mesh) else thing.type


def domain_of(thing):
    """The settings of an object's smoke and fire; None for whatever is no domain of these."""
    for modifier in thing.modifiers:
        if modifier.type == "FLUID" and modifier.fluid_type == "DOMAIN" and modifier.domain_settings.domain_type == "GAS":
            return modifier.domain_settings
    return None


def _topmost(thing):
    """The object at the top of an object's parents."""
    while thing.parent is not None:
        thing = thing.parent
    return thing


def _once(groups):
    """Leaves out curves, texts and the like whose mesh the depsgraph lists too."""
    meshes = {group.object_uid for group in groups if group.kind == "MESH"}
    return [group for group in groups if group.kind not in AS_MESH or group.object_uid not in meshes]


def _fill(depsgraph, groups, count, part):
    flat = np.empty(count * 16, dtype=np.float32)
    depsgraph.object_instances.foreach_get("matrix_world", flat)
    # Blender gives columns; the scene wants rows.
    matrices = np.ascontiguousarray(flat.reshape(-1, 4, 4).transpose(0, 2, 1))
    if part is not None:
        matrices = part.placed(matrices)
    kept = usable(matrices)
    all_kept = kept.all()
    for group in groups:
        first, end = group.rows[0], group.rows[-1] + 1
        # Most rows follow one another, and need no copy.
        rows = slice(first, end) if end - first == len(group.rows) else group.rows
        group.matrices = matrices[rows]
        if not all_kept and not kept[rows].all():
            group.kept = kept[rows]


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

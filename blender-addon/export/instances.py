# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's placements: one entry for each group, rewritten only where something about it changed."""

from dataclasses import dataclass, field, replace

import numpy as np

from .colour_management import to_rec709
from .gather import SILENT
from .linking import ALL, Sets, linking
from .material.inputs import COLOUR, INDEX, LOCATION, RANDOM
from .motion import moved, shares_of
from .object_attribute import object_attribute
from .transforms import usable

# Names of attributes that are custom properties of the object.
OBJECT_PREFIX = "object "
NO_VALUES = {}


@dataclass(slots=True)
class Entry:
    """What the scene was told of one group."""

    # Mesh, curves or points, and their number.
    shown: tuple
    materials: list
    name: str
    visibility: dict
    pass_index: int
    light_group: str
    asset: str
    # The cosine under which light grazes that starts from the curved surface, as in Cycles.
    terminator: float
    wanted: frozenset
    transforms: np.ndarray
    values: dict
    # The transforms at even times of the shutter (K, N, 4, 4), where they move.
    motion: np.ndarray | None = None
    # What is lit by what it emits, and what casts shadows of it.
    linking: dict = field(default_factory=lambda: ALL)

    def is_like(self, other):
        """Whether another entry tells the scene the same."""
        return (
            self.shown == other.shown
            and self.materials == other.materials
            and self.name == other.name
            and self.visibility == other.visibility
            and self.pass_index == other.pass_index
            and self.light_group == other.light_group
            and self.linking == other.linking
            and self.asset == other.asset
            and self.terminator == other.terminator
            and _same(self.transforms, other.transforms)
            and (self.motion is None) == (other.motion is None)
            and (self.motion is None or _same(self.motion, other.motion))
            and self.values.keys() == other.values.keys()
            and all(_same(self.values[name], other.values[name]) for name in self.values)
        )


def _same(a, b):
    return a.shape == b.shape and a.tobytes() == b.tobytes()


class Instances:
    """The entries of the last pass, to compare with."""

    def __init__(self, scene, report):
        self._scene, self._report = scene, report
        self._written, self.any_written = [], False
        # By the number of an entry, the group it came from: its key and its object.
        self._sources = []
        # Objects that are placed as themselves and not otherwise: the number of their entry, by session_uid.
        self._single = {}
        # Objects that are placed as themselves first: the number of their entry, by session_uid.
        self._own = {}
        # The numbers of the entries as links know them.
        self.sets = Sets()

    def write(self, entries, keys):
        """Puts the given entries, (group, kind and number of what is shown, material numbers, primvars wanted), in place of what was there; `keys`
        name their groups."""
        self.any_written, self._single, self._own, self.sets, self._sources = False, {}, {}, Sets(), []
        made = []
        for entry, key in zip(entries, keys, strict=True):
            with self._report.guard("Object", entry[0].name, "it is left out"):
                self._make(made, key, *entry)
        for number, (group, _, _) in enumerate(made):
            self.sets.add(group, number)
        for number, (group, key, entry) in enumerate(made):
            shares = self._put_linked(number, group, entry)
            self._sources.append((key, shares))
        if len(made) < len(self._written):
            self.any_written = True
            self._scene.truncate("instances", len(made))
            del self._written[len(made) :]

    def _put_linked(self, number, group, entry):
        """Puts an entry with its links; gives the times of the shutter at which it wants to know where it is."""
        with self._report.guard("Object", group.name, "it is left out"):
            entry.linking = linking(group.source.original, self.sets)
            self._put(number, entry)
            return shares_of(group.source) if group.kept is None else ()
        # Nothing takes its place, for others are known by their numbers.
        self._put(number, replace(entry, materials=[], transforms=entry.transforms[:0], values=NO_VALUES, linking=ALL))
        return ()

    def _make(self, made, key, group, shown, materials, wanted):
        """Appends the entry of a group, if anything of it can be shown."""
        is_alone = group.is_itself and len(group.rows) == 1 and group.kept is None and not group.is_filled
        is_single = is_alone and group.object_uid not in self._single
        self._single[group.object_uid] = None
        if group.kept is not None and not self._leave_out(group):
            return
        values = values_of(group, wanted) if wanted else NO_VALUES
        terminator = min(group.source.shadow_terminator_geometry_offset, 1.0)
        of_group = (group.name, group.visibility, group.pass_index, group.source.lightgroup, group.asset, terminator)
        if is_single:
            self._single[group.object_uid] = len(made)
        if group.is_itself and (group.kept is None or group.kept[0]):
            self._own[group.object_uid] = len(made)
        made.append((group, key, Entry(shown, materials, *of_group, wanted, group.matrices, values)))

    def own(self, uid):
        """The number of the entry whose first placement is an object itself, by session_uid, and the numbers of its materials; None without one."""
        number = self._own.get(uid)
        return None if number is None else (number, self._written[number].materials)

    def move(self, moved):
        """Moves the evaluated objects given by session_uid, of which nothing else has changed; False, with nothing written, where that may
        move instances too."""
        places = {}
        for uid, thing in moved.items():
            number = self._single.get(uid)
            if thing.is_instancer or thing.particle_systems or any(modifier.type == "NODES" for modifier in thing.modifiers):
                return False
            if number is not None:
                places[number] = thing, np.array(thing.matrix_world, dtype=np.float32, order="C")[None]
            elif thing.type not in SILENT:
                return False
        if not all(usable(transforms).all() for _, transforms in places.values()):
            return False
        self.any_written = False
        for number, (thing, transforms) in places.items():
            entry = self._written[number]
            values = {**entry.values, **_of_object(thing, entry.pass_index, entry.wanted, 1)}
            if LOCATION in values:
                values[LOCATION] = _locations(transforms)
            self._put(number, replace(entry, transforms=transforms, values=values))
        return True

    def shares(self):
        """All times of the shutter at which entries want to know where they are."""
        return {share for _, shares in self._sources for share in shares}

    def blur(self, places, changed, ends=()):
        """Writes the entries that move, with where they are at the times of the shutter, or at `ends`; what is `changed` (by the key and what
        was shown, or `mesh`) stands in for what was shown."""
        for number, (key, shares) in enumerate(self._sources):
            entry = self._written[number]
            motion = moved(key, entry.transforms, ends or shares, places)
            shown = changed.get((key, "mesh" if entry.shown[0] == "mesh" else entry.shown), entry.shown)
            if motion is not None or shown != entry.shown:
                self._put(number, replace(entry, motion=motion, shown=shown))

    def _leave_out(self, group):
        """Takes the placements away that cannot be shown, with a report line; gives whether any are left."""
        lost = int((~group.kept).sum())
        self._report.add(
            "Object", group.name, f"{lost} placement{'s' * (lost > 1)} with a scale of zero or values that are not numbers left out"
        )
        group.matrices = group.matrices[group.kept]
        if group.random is not None:
            group.random = group.random[group.kept]
        group.instancer = {name: values[group.kept] for name, values in group.instancer.items()}
        return len(group.matrices) > 0

    def _put(self, number, entry):
        known = number < len(self._written)
        if known and self._written[number].is_like(entry):
            # The new one: the old one's transforms may be part of all the matrices of an earlier pass.
            self._written[number] = entry
            return
        self.any_written = True
        kind, shown = entry.shown
        self._scene.put_instances(
            shown if kind == "mesh" else None,
            entry.materials,
            entry.transforms,
            motion=entry.motion,
            name=entry.name,
            visibility=entry.visibility,
            primvars=entry.values or None,
            pass_index=entry.pass_index,
            light_group=entry.light_group,
            linking=None if entry.linking is ALL else entry.linking,
            asset=entry.asset,
            shadow_terminator=entry.terminator,
            index=number if known else None,
            **({} if kind == "mesh" else {kind: shown}),
        )
        if known:
            self._written[number] = entry
        else:
            self._written.append(entry)


def values_of(group, wanted):
    """The values that materials want of each placement."""
    values = _of_object(group.source, group.pass_index, wanted, len(group.matrices))
    if RANDOM in wanted:
        values[RANDOM] = np.ascontiguousarray(group.random[:, None])
    if LOCATION in wanted:
        values[LOCATION] = _locations(group.matrices)
    return {**values, **group.instancer}


def _locations(transforms):
    return np.ascontiguousarray(transforms[:, :3, 3])


def _of_object(source, pass_index, wanted, count):
    """The values that are the same for all placements of an object, `count` times."""
    values = {}
    for name in sorted(wanted):
        value = None
        if name == COLOUR:
            value = to_rec709(source.color)
        elif name == INDEX:
            value = [pass_index]
        elif name.startswith(OBJECT_PREFIX):
            value = object_attribute(source, name.removeprefix(OBJECT_PREFIX))
        if value is not None:
            values[name] = np.tile(np.asarray(value, dtype=np.float32), (count, 1))
    return values

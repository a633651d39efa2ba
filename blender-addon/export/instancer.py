# SPDX-License-Identifier: GPL-3.0-or-later
"""What instancers give their instances: attributes of the instances that geometry nodes make, else properties of the instancer's object."""

import numpy as np

from .mesh_attributes import as_shader_value, read
from .object_attribute import object_attribute

# Names of values that an instancer gives; the object's own where it gives none.
PREFIX = "instancer "
# The attribute by which Blender knows instances again.
ID = "id"
# What Blender writes where a placement is nested less deeply.
NO_LEVEL = 2**31 - 1


def fill_instancer(depsgraph, groups, wanted, report):
    """Adds to groups the values that materials want of instancers: `wanted` are sets of names, one for each group."""
    if not groups:
        return
    asked = [[name for name in names if name.startswith(PREFIX)] for names in wanted]
    places = Places(depsgraph, {row for group in groups for row in group.rows})
    names = {name.removeprefix(PREFIX) for each in asked for name in each}
    instancers = {uid: Instancer(parent, depsgraph, names) for uid, parent in places.parents.items()}
    for group, each in zip(groups, asked, strict=True):
        group.instancer = {name: _values(group, name.removeprefix(PREFIX), places, instancers, report) for name in each}


class Places:
    """Of rows of the depsgraph's instances: their instancer, and their numbers from the innermost level to the outermost."""

    def __init__(self, depsgraph, rows):
        self.parents, self.of_row = {}, {}
        for row, item in enumerate(depsgraph.object_instances):
            if row in rows and item.is_instance:
                parent = item.parent.original
                self.parents[parent.session_uid] = parent
                self.of_row[row] = parent.session_uid, [level for level in item.persistent_id if level != NO_LEVEL]


class Instancer:
    """One object that has instances: attributes of these names as colours, a row for each, or its own property."""

    def __init__(self, source, depsgraph, names):
        evaluated = source.evaluated_get(depsgraph)
        geometry = evaluated.evaluated_geometry() if hasattr(evaluated, "evaluated_geometry") else None
        cloud = geometry.instances_pointcloud() if geometry is not None else None
        # The geometry is gone after this function.
        found = {name: read(cloud.attributes[name]) for name in (*names, ID) if name in cloud.attributes} if cloud is not None else {}
        numbers = found.pop(ID, None)
        self._by_id = None if numbers is None else {int(value): number for number, value in enumerate(numbers[:, 0])}
        self._attributes = {name: _colours(values) for name, values in found.items() if values is not None}
        self._own = {name: object_attribute(source, name) for name in names}

    def value(self, name, levels):
        """What a placement is given, None for nothing."""
        values = self._attributes.get(name)
        if values is not None and levels:
            # The outermost level counts the instances of the object itself, or has their IDs.
            number = levels[-1] if self._by_id is None else self._by_id.get(levels[-1], -1)
            if 0 <= number < len(values):
                return values[number]
        return self._own[name]


def _colours(values):
    """Numbers and vectors as colours: 0 for missing components, alpha 1."""
    values = as_shader_value(values)
    colours = np.zeros((len(values), 4), dtype=np.float32)
    colours[:, 3] = 1.0
    colours[:, : values.shape[1]] = values
    return colours


def _values(group, name, places, instancers, report):
    """A value for each placement of a group: (N, 4)."""
    own = object_attribute(group.source, name) or (0.0,) * 4
    values, is_lost = np.empty((len(group.rows), 4), dtype=np.float32), False
    for place, row in enumerate(group.rows):
        uid, levels = places.of_row.get(row, (None, ()))
        value = instancers[uid].value(name, levels) if uid is not None else None
        values[place] = own if value is None else value
        is_lost |= value is None and len(levels) > 1
    if is_lost:
        report.tell("instancer's attribute", "Object", group.name, f"Attribute '{name}' of the instancer")
    return values

# SPDX-License-Identifier: GPL-3.0-or-later
"""What instancers give their instances: attributes of the instances that geometry nodes make, else properties of the instancer's object."""

import numpy as np

from .mesh import as_shader_value, read
from .object_attribute import object_attribute

# Names of values that an instancer gives; the object's own where it gives none.
PREFIX = "instancer "
# What Blender writes where a placement is nested less deeply.
NO_LEVEL = 2**31 - 1


def fill_instancer(depsgraph, groups, wanted, report):
    """Adds to groups the values that materials want of instancers: `wanted` are sets of names, one for each group."""
    if not groups:
        return
    places = Places(depsgraph, {row for group in groups for row in group.rows})
    instancers = {uid: Instancer(parent, depsgraph) for uid, (parent, _) in places.parents.items()}
    for group, names in zip(groups, wanted, strict=True):
        group.instancer = {name: _values(group, name, places, instancers, report) for name in names if name.startswith(PREFIX)}


class Places:
    """Of rows of the depsgraph's instances: their instancer, and their numbers from the innermost level to the outermost."""

    def __init__(self, depsgraph, rows):
        self.parents, self.of_row = {}, {}
        for row, item in enumerate(depsgraph.object_instances):
            if row in rows and item.is_instance:
                parent = item.parent.original
                self.parents[parent.session_uid] = (parent, row)
                self.of_row[row] = parent.session_uid, [level for level in item.persistent_id if level != NO_LEVEL]


class Instancer:
    """One object that has instances."""

    def __init__(self, source, depsgraph):
        self.source = source
        evaluated = source.evaluated_get(depsgraph)
        geometry = evaluated.evaluated_geometry() if hasattr(evaluated, "evaluated_geometry") else None
        cloud = geometry.instances_pointcloud() if geometry is not None else None
        self._attributes, self._by_id, self.count = {}, None, 0
        # The geometry is gone after this function.
        for attribute in cloud.attributes if cloud is not None else ():
            values = read(attribute)
            if values is not None:
                self._attributes[attribute.name] = values
                self.count = len(values)
        if "id" in self._attributes:
            self._by_id = {int(value): number for number, value in enumerate(self._attributes["id"][:, 0])}

    def has(self, name):
        """Whether its instances have this attribute."""
        return name in self._attributes

    def values(self, name):
        """An attribute as colours, one for each instance."""
        values = as_shader_value(self._attributes[name])
        missing = 4 - values.shape[1]
        # Alpha is 1 where there is none.
        return np.pad(values, ((0, 0), (0, missing)), constant_values=1.0) if missing else values

    def number(self, levels):
        """Which of its instances a placement belongs to; None where that cannot be told."""
        if not levels:
            return None
        number = levels[-1] if self._by_id is None else self._by_id.get(levels[-1])
        return number if number is not None and 0 <= number < self.count else None


def _values(group, name, places, instancers, report):
    """A value for each placement of a group: (N, 4)."""
    asked = name.removeprefix(PREFIX)
    own = object_attribute(group.source, asked) or (0.0,) * 4
    values, is_lost = np.empty((len(group.rows), 4), dtype=np.float32), False
    for place, row in enumerate(group.rows):
        uid, levels = places.of_row.get(row, (None, ()))
        instancer = instancers.get(uid)
        number = instancer.number(levels) if instancer is not None and instancer.has(asked) else None
        if number is not None:
            values[place] = instancer.values(asked)[number]
            continue
        of_parent = object_attribute(instancer.source, asked) if instancer is not None else None
        values[place] = own if of_parent is None else of_parent
        is_lost |= of_parent is None and len(levels) > 1
    if is_lost:
        report.tell("instancer's attribute", "Object", group.name, f"Attribute '{asked}' of the instancer")
    return values

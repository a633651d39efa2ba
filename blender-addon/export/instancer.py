# SPDX-License-Identifier: GPL-3.0-or-later
"""What instancers give their instances, as Cycles looks it up: properties of particles' settings, attributes of the innermost instances of
geometry nodes that have them, properties of the outermost instancer, of the object itself."""

import numpy as np

from .instance_trail import Trails
from .object_attribute import attribute_of, object_attribute

# Names of values that an instancer gives; the object's own where it gives none.
PREFIX = "instancer "
# What Blender writes where a placement is nested less deeply.
NO_LEVEL = 2**31 - 1


def fill_instancer(depsgraph, groups, wanted, report):
    """Adds to groups the values that materials want of instancers: `wanted` are sets of names, one for each group."""
    if not groups:
        return
    asked = [[name.removeprefix(PREFIX) for name in names if name.startswith(PREFIX)] for names in wanted]
    names = {name for each in asked for name in each}
    places = Places(depsgraph, {row for group in groups for row in group.rows}, names)
    for group, each in zip(groups, asked, strict=True):
        group.instancer = {PREFIX + name: places.values(group, name) for name in each}
        if any(row in places.lost for row in group.rows):
            report.tell("instancer's attribute", "Object", group.name, f"Attribute '{each[0]}' of the instancer")


class Places:
    """What gives values of these names to rows of the depsgraph's instances."""

    def __init__(self, depsgraph, rows, names):
        # By row: instances of geometry nodes from the innermost to the outermost, and the number of a set of properties.
        self._of_row, self._properties, known = {}, [], {}
        # Rows whose instances are not known.
        self.lost = set()
        trails = Trails(depsgraph, names)
        for row, item in enumerate(depsgraph.object_instances):
            if row not in rows or not item.is_instance:
                continue
            parent, leaf, system = item.parent, item.object.original, item.particle_system
            levels = [level for level in item.persistent_id if level != NO_LEVEL][::-1]
            trail = trails.follow(parent.original, levels, leaf)
            if trail is None:
                self.lost.add(row)
            settings = None if system is None else system.settings
            owner = parent.original.session_uid, 0 if settings is None else settings.original.session_uid
            if owner not in known:
                known[owner] = len(self._properties)
                self._properties.append({name: _property(settings, parent, name) for name in names})
            self._of_row[row] = (trail or ())[::-1], known[owner]

    def values(self, group, name):
        """A value for each placement of a group: (N, 4)."""
        own = object_attribute(group.source, name) or (0.0,) * 4
        values = np.empty((len(group.rows), 4), dtype=np.float32)
        for place, row in enumerate(group.rows):
            value = self._value(row, name) if row in self._of_row else None
            values[place] = own if value is None else value
        return values

    def _value(self, row, name):
        trail, number = self._of_row[row]
        of_particles, of_parent = self._properties[number][name]
        if of_particles is not None:
            return of_particles
        return next((table.values[name][instance] for table, instance in trail if name in table.values), of_parent)


def _property(settings, parent, name):
    """A property of particles' settings, and one of the instancer."""
    return None if settings is None else attribute_of((settings,), name), object_attribute(parent, name)

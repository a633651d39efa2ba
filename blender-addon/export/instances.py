# SPDX-License-Identifier: GPL-3.0-or-later
"""The scene's placements: one entry for each group, rewritten only where something about it changed."""

import numpy as np

from .material.inputs import COLOUR, INDEX, LOCATION, RANDOM
from .transforms import usable

# Names of attributes that are custom properties of the object.
OBJECT_PREFIX = "object "


class Instances:
    """The entries of the last pass, to compare with."""

    def __init__(self, scene, report):
        self._scene, self._report = scene, report
        self._written, self.any_written = [], False

    def write(self, entries):
        """Puts the given entries, (group, mesh number, material numbers, primvars wanted), in place of what was there."""
        self.any_written = False
        number = 0
        for group, mesh, materials, primvars in entries:
            self._report.forget("Object", group.name)
            kept = usable(group.matrices)
            if not kept.all():
                lost = int((~kept).sum())
                self._report.add(
                    "Object", group.name, f"{lost} placement{'s' * (lost > 1)} with a scale of zero or values that are not numbers left out"
                )
            if kept.any():
                self._put(number, group, mesh, materials, kept, self._values(group, kept, primvars))
                number += 1
        if number < len(self._written):
            self.any_written = True
            self._scene.truncate(instances=number)
        self._written = self._written[:number]

    def _put(self, number, group, mesh, materials, kept, values):
        transforms = group.matrices if kept.all() else np.ascontiguousarray(group.matrices[kept])
        about = (mesh, tuple(materials), group.name, tuple(group.visibility.items()), group.pass_index)
        shown = (about, transforms, values)
        if number < len(self._written) and _same(self._written[number], shown):
            return
        self.any_written = True
        index = number if number < len(self._written) else None
        self._scene.put_instances(
            mesh,
            list(materials),
            transforms,
            name=group.name,
            visibility=group.visibility,
            primvars=values or None,
            pass_index=group.pass_index,
            index=index,
        )
        if index is None:
            self._written.append(shown)
        else:
            self._written[number] = shown

    def _values(self, group, kept, wanted):
        """The values that materials want of each placement."""
        count = int(kept.sum())
        every = lambda value: np.tile(np.asarray(value, dtype=np.float32), (count, 1))
        source, values = group.source, {}
        for name in sorted(wanted):
            if name == RANDOM:
                values[name] = np.ascontiguousarray(group.random[kept, None])
            elif name == LOCATION:
                values[name] = np.ascontiguousarray(group.matrices[kept, :3, 3])
            elif name == COLOUR:
                values[name] = every(tuple(source.color))
            elif name == INDEX:
                values[name] = every([group.pass_index])
            elif name.startswith(OBJECT_PREFIX):
                value = object_attribute(source, name.removeprefix(OBJECT_PREFIX))
                if value is not None:
                    values[name] = every(value)
        return values


def _same(a, b):
    return (
        a[0] == b[0]
        and a[1].shape == b[1].shape
        and a[1].tobytes() == b[1].tobytes()
        and a[2].keys() == b[2].keys()
        and all(a[2][name].tobytes() == b[2][name].tobytes() for name in a[2])
    )


def object_attribute(source, name):
    """A property of an object, or of its data, by the path that Blender's Attribute node takes; as a colour."""
    for thing in (source, source.data):
        for path in (f'["{name}"]', name):
            try:
                value = thing.path_resolve(path)
            except (ValueError, AttributeError):
                continue
            if isinstance(value, (int, float)):
                return (float(value),) * 3 + (1.0,)
            if hasattr(value, "__len__") and not isinstance(value, str) and 1 < len(value) <= 4:
                return [*(float(x) for x in value), 0.0, 1.0][:3] + [float(value[3]) if len(value) == 4 else 1.0]
    return None

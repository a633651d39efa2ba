# SPDX-License-Identifier: GPL-3.0-or-later
"""Through which instances of geometry nodes a placement came, from the outermost to its own: Blender tells a number for each level alone."""

import numpy as np

from .mesh_attributes import as_shader_value, read

# The attribute by which Blender knows instances again.
ID = "id"
# Lists deeper than that go round in a circle.
MOST_LEVELS = 16


class Table:
    """The instances in one geometry: their attributes of some names as colours, a row for each, and what each shows. The geometry need not
    stay."""

    def __init__(self, geometry, cloud, names, tables):
        found = {name: read(cloud.attributes[name]) for name in (*names, ID) if name in cloud.attributes}
        numbers = found.pop(ID, None)
        self._by_id = None if numbers is None else {int(value): number for number, value in enumerate(numbers[:, 0])}
        self.values = {name: _colours(values) for name, values in found.items() if values is not None}
        handles = np.empty(len(cloud.points), dtype=np.int32)
        cloud.attributes[".reference_index"].data.foreach_get("value", handles)
        self._handles, self.count = handles, len(handles)
        # Geometries become tables, objects and collections stay: the originals.
        self._shown = [tables.of_geometry(each) if type(each).__name__ == "GeometrySet" else each.original for each in geometry.instance_references()]

    def find(self, level):
        """The number of the instance that a level tells, None for none."""
        number = level if self._by_id is None else self._by_id.get(level, -1)
        return number if 0 <= number < self.count else None

    def shown(self, number):
        """What an instance shows: an object, a collection, a table, or None for a geometry without instances."""
        return self._shown[self._handles[number]]


def _colours(values):
    """Numbers and vectors as colours: 0 for missing components, alpha 1."""
    values = as_shader_value(values)
    colours = np.zeros((len(values), 4), dtype=np.float32)
    colours[:, 3] = 1.0
    colours[:, : values.shape[1]] = values
    return colours


class Trails:
    """The tables of a depsgraph's instancers, with attributes of these names, and ways through them."""

    def __init__(self, depsgraph, names):
        self._depsgraph, self._names, self._of_object = depsgraph, names, {}

    def of_geometry(self, geometry):
        """The table of a geometry; None where it has no instances."""
        cloud = geometry.instances_pointcloud()
        return None if cloud is None or len(cloud.points) == 0 else Table(geometry, cloud, self._names, self)

    def follow(self, source, levels, leaf):
        """(table, number) for each instance of geometry nodes on the way from an original object to what it places, `leaf` by its original
        object; `levels` go from the outermost on. None where there is no such way."""
        if not levels:
            return () if source == leaf else None
        if len(levels) > MOST_LEVELS:
            return None
        if source.instance_type == "COLLECTION" and source.instance_collection is not None:
            return self._into(source.instance_collection, levels[0], levels[1:], leaf)
        # Vertices, faces and particles do not tell which object they place; particles have a number of their system too.
        placed = ((1, () if source.instance_type == "NONE" else source.children), (2, _of_particles(source)))
        ways = (self.follow(each, levels[used:], leaf) for used, things in placed for each in things)
        way = next((way for way in ways if way is not None), None)
        table = self._table(source) if way is None else None
        return way if table is None else self._through(table, levels, leaf)

    def _table(self, source):
        uid = source.session_uid
        if uid not in self._of_object:
            evaluated = source.evaluated_get(self._depsgraph)
            self._of_object[uid] = self.of_geometry(evaluated.evaluated_geometry()) if hasattr(evaluated, "evaluated_geometry") else None
        return self._of_object[uid]

    def _through(self, table, levels, leaf):
        number = table.find(levels[0])
        if number is None:
            return () if len(levels) == 1 else None
        shown, rest, way = table.shown(number), levels[1:], None
        if shown is None or not rest and isinstance(shown, Table):
            # The last level is the number of a part of the geometry itself.
            way = () if len(rest) == (shown is None) else None
        elif isinstance(shown, Table):
            way = self._through(shown, rest, leaf)
        elif hasattr(shown, "all_objects"):
            # Two numbers an object: of itself, and of what it places.
            way = self._into(shown, rest[0] // 2, rest[1:], leaf) if rest else None
        else:
            way = self.follow(shown, rest, leaf)
        return None if way is None else ((table, number), *way)

    def _into(self, collection, number, rest, leaf):
        objects = collection.all_objects
        return self.follow(objects[number], rest, leaf) if number < len(objects) else None


def _of_particles(source):
    """Objects that particles of an object may place."""
    for system in source.particle_systems:
        if system.settings.instance_object is not None:
            yield system.settings.instance_object
        if system.settings.instance_collection is not None:
            yield from system.settings.instance_collection.all_objects

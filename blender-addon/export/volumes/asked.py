# SPDX-License-Identifier: GPL-3.0-or-later
"""What a volume's shader asks for, and its values at numbers of grids and at places."""

from types import SimpleNamespace

import numpy as np
from gonio.graph import renumber

from ..evaluate import evaluate
from ..material.inputs import ALPHA, FACTOR, GENERATED, GIVEN, POSITION, TANGENT, UV
from .lattice import carried

# What depends on the place: in the world, in the object's space, and within the box of the lattice.
PLACES = {"Position", POSITION, GENERATED}
# How names begin of what meshes and instances have, and grids are not called.
NO_GRIDS = ("blender ", GIVEN, TANGENT)


class Asked:
    """Some values of a graph, three numbers of each colour and one of each number."""

    def __init__(self, t, grids, place, values):
        sources = [value.input() for value in values]
        nodes, order = t.graph.reachable(sources)
        self._graph, self._sources = SimpleNamespace(nodes=nodes), [renumber(source, order) for source in sources]
        self._widths = [1 if value.kind == "VALUE" else 3 for value in values]
        self._pictures, self._place, self._grids = t.images, place, grids
        # Names of grids that count, what is asked of places, and what nothing here can answer.
        self.grids, self.places, self.unknown = set(), set(), set()
        for node in nodes:
            self._sort(node["operation"], node["inputs"])

    def _sort(self, operation, inputs):
        if isinstance(operation, str):
            if operation == "Position":
                self.places.add(operation)
            elif not inputs:
                self.unknown.add(operation)
            return
        ((kind, fields),) = operation.items()
        if kind == "Transform":
            if fields["quantity"] == "Point":
                self.places.add("Position")
            else:
                self.unknown.add(fields["quantity"])
        elif kind == "Primvar":
            name, grid = fields["name"], grid_of(fields["name"])
            if name in PLACES:
                self.places.add(name)
            elif grid in self._grids.names:
                self.grids.add(grid)
        elif not inputs:
            self.unknown.add(kind)

    def at(self, numbers):
        """Values where each grid has these numbers: (N, components)."""
        return self._values(np.repeat(numbers[:, None].astype(np.float32), 4, axis=1))

    def on(self, lattice, rows, arrays):
        """Values at some points of a lattice; `arrays` are grids on it, by name."""
        points = lattice.points(rows) if self.places else None
        return self._values(np.ones((len(rows), 4), np.float32), {name: array.rows(rows) for name, array in arrays.items()}, points, lattice)

    def _values(self, numbers, rows=None, points=None, lattice=None):
        here = {} if points is None else self._places(points, lattice)

        def leaf(operation, inputs):
            if isinstance(operation, str):
                return here.get(operation)
            ((kind, fields),) = operation.items()
            if kind == "Primvar":
                return self._primvar(fields, numbers, rows, here)
            if kind == "Transform" and fields["quantity"] == "Point":
                return self._carried(fields, inputs[0])
            return self._pictures.look_up(fields, inputs[0]) if kind == "Image" else None

        found = evaluate(self._graph, self._sources, numbers.shape, leaf)
        parts = [value[:, :width] for value, width in zip(found, self._widths, strict=True)]
        return np.nan_to_num(np.concatenate(parts, axis=1), posinf=0.0, neginf=0.0)

    def _primvar(self, fields, numbers, rows, here):
        name, grid = fields["name"], grid_of(fields["name"])
        if name in here:
            return here[name]
        if name in self._place.values:
            return np.broadcast_to(_four(self._place.values[name]), numbers.shape)
        if grid not in self.grids:
            return np.broadcast_to(np.asarray(fields["fallback"], np.float32), numbers.shape)
        if name.startswith(ALPHA):
            return np.ones_like(numbers)
        found = numbers if rows is None else rows[grid]
        return np.repeat(found[:, :3].mean(axis=1, keepdims=True), 4, axis=1) if name.startswith(FACTOR) else found

    def _places(self, points, lattice):
        shares, matrix = lattice.shares(points), self._place.matrix
        return {"Position": _padded(carried(matrix, points)), POSITION: _padded(points), GENERATED: _padded(shares)}

    def _carried(self, fields, value):
        if fields["from"] == fields["to"]:
            return value
        matrix = self._place.matrix if fields["to"] == "World" else np.linalg.inv(self._place.matrix)
        return _padded(carried(matrix, value[:, :3]))


def grid_of(name):
    """The grid that a named value is taken from."""
    return name.removeprefix(FACTOR).removeprefix(ALPHA)


def lacking(t, values, grids):
    """By the names of grids that values of a graph ask for and a volume has not: what counts in their place."""
    nodes, _ = t.graph.reachable([value.input() for value in values])
    fields = [node["operation"]["Primvar"] for node in nodes if isinstance(node["operation"], dict) and "Primvar" in node["operation"]]
    other = {UV, *t.instance_primvars}
    asked = {grid_of(each["name"]): each["fallback"][0] for each in fields if each["name"] not in other and not each["name"].startswith(NO_GRIDS)}
    return {name: fallback for name, fallback in asked.items() if name not in grids.names and name not in grids.silent}


def _padded(points):
    return np.concatenate([points, np.zeros_like(points[:, :1])], axis=1)


def _four(value):
    return np.resize(value, 4) if len(value) == 1 else np.concatenate([value, np.ones(4)])[:4]

"""Surfaces of elements, by IfcOpenShell's geometry: triangles with the looks of their items, openings cut out."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .extra import require

THREADS = 2
# Points farther than this from their own origin are told from there in single precision too coarsely, metres.
FAR = 100.0


@dataclass
class Shape:
    """Points in metres about `centre` of the element's own space, triangles, and numbers of style and item for each of these."""

    key: str
    points: Any = field(repr=False)
    faces: Any = field(repr=False)
    # Number of an IfcSurfaceStyle or an IfcMaterial, 0 without one.
    styles: Any = field(repr=False)
    items: Any = field(repr=False)


@dataclass
class Placed:
    """An element's surface, and the matrix (on columns) that takes it to the model's space."""

    element: Any
    shape: Shape
    matrix: Any = field(repr=False)

    def points(self) -> Any:
        """Points in the model's space, metres."""
        return self.shape.points @ self.matrix[:3, :3].T + self.matrix[:3, 3]


def read(model: Any, elements: Sequence[Any]) -> Iterator[Placed]:
    """The surfaces of elements that have any; shared shapes are the same object."""
    if not elements:
        return
    geom = require("ifcopenshell.geom")
    iterator = geom.iterator(geom.settings(), model, THREADS, include=list(elements))
    if not iterator.initialize():
        return
    shared: dict[str, tuple[Shape, Any]] = {}
    while True:
        found = iterator.get()
        key = found.geometry.id
        if key not in shared:
            shared[key] = _shape(found.geometry)
        shape, centre = shared[key]
        if len(shape.faces):
            matrix = np.array(found.transformation.matrix, "f8").reshape(4, 4).T
            matrix[:3, 3] += matrix[:3, :3] @ centre
            yield Placed(model.by_id(found.id), shape, matrix)
        if not iterator.next():
            return


def _shape(geometry: Any) -> tuple[Shape, Any]:
    """A shape, and what was subtracted from its points."""
    points = np.frombuffer(geometry.verts_buffer, "f8").reshape(-1, 3)
    faces = np.array(geometry.faces, "i4").reshape(-1, 3)
    # A number of a material; below 0 there is none.
    numbers = np.array([material.instance_id() for material in geometry.materials] + [0], "i8")
    styles = numbers[np.frombuffer(geometry.material_ids_buffer, "i4")]
    items = np.frombuffer(geometry.item_ids_buffer, "i4")
    good = np.isfinite(points).all(axis=1)[faces].all(axis=1) if len(faces) else np.zeros(0, bool)
    shape = Shape(geometry.id, points, faces[good], styles[good], items[good])
    centre = np.zeros(3)
    if len(shape.faces):
        used = points[np.unique(shape.faces)]
        if np.abs(used).max() > FAR:
            centre = np.round(used.mean(axis=0))
            shape.points = points - centre
    return shape, centre

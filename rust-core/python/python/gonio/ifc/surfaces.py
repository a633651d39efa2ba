"""Which look each triangle has: by its style, the part of the element that it is, or what the element is."""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from . import looks, panes
from .extra import require
from .looks import GLASS, Look
from .notes import Notes
from .shapes import Placed, Shape

Parts = list[tuple[Look, Any]]


@dataclass(frozen=True)
class Kind:
    """What of an element its looks depend on, beside its shape."""

    plain: Look
    glass: Look
    # The transmittance that its properties state goes before that of styles.
    is_stated: bool
    is_window: bool
    is_glass: bool
    # What is up in the element's own space, of slabs alone.
    up: tuple[float, ...] | None


# Slabs and roofs without a style: faces within 45° of level are floor and ceiling.
LEVEL = 0.7071
GLAZING = ("Pset_DoorWindowGlazingType", "VisibleLightTransmittance")
SLABS = ("IfcSlab", "IfcRoof")


class Surfaces:
    """Looks of a model's elements, each style read once."""

    def __init__(self, model: Any, notes: Notes) -> None:
        self.model = model
        self.notes = notes
        self._styles: dict[int, Look | None] = {0: None}
        self._parts: dict[tuple[str, Kind], Parts] = {}
        self._glazing = _glazing_items(model)

    def parts(self, placed: Placed) -> Parts:
        """Faces by their looks."""
        element, shape = placed.element, placed.shape
        kind = Kind(looks.default("element", looks.WALL), GLASS, False, False, False, None)
        with self.notes.sound(element):
            kind = _kind(element, placed.matrix)
        key = (shape.key, kind)
        if key not in self._parts:
            self._parts[key] = self._of_shape(element, shape, kind)
        if any(look.is_default for look, _ in self._parts[key]):
            self._tell_defaults(element, self._parts[key])
        return self._parts[key]

    def _tell_defaults(self, element: Any, parts: Parts) -> None:
        names = sorted({look.name.removeprefix("Default ") for look, _ in parts if look.is_default})
        self.notes.of(f"no style says how light or clear they are; by what they are: {', '.join(names)}", element)

    def _style(self, number: int) -> Look | None:
        """The look of a style, or of a material by its name."""
        if number not in self._styles:
            entity, found = self.model.by_id(number), None
            with self.notes.sound(entity):
                found = looks.of_style(entity, self.notes) if entity.is_a("IfcSurfaceStyle") else None
            self._styles[number] = GLASS if found is None and looks.is_glass(getattr(entity, "Name", None)) else found
        return self._styles[number]

    def _of_shape(self, element: Any, shape: Shape, kind: Kind) -> Parts:
        table: dict[Look | None, int] = {}
        numbers = np.zeros(len(shape.faces), "i4")
        for style in np.unique(shape.styles):
            numbers[shape.styles == style] = table.setdefault(self._style(int(style)), len(table))
        clear = np.array([look is not None and look.is_pane for look in table])[numbers]
        glazing = np.isin(shape.items, list(self._glazing)) & ~clear
        if kind.is_window and not glazing.any() and not clear.any():
            glazing = _by_form(shape)
        masks = [(kind.glass, glazing)]
        for look, number in table.items():
            mask = (numbers == number) & ~glazing
            if look is None:
                masks += [(own, mask & of_own) for own, of_own in _without_style(kind, shape)]
            else:
                masks.append((kind.glass if look.is_pane and kind.is_stated else look, mask))
        return [part for look, mask in masks if mask.any() for part in self._part(element, shape, look, mask)]

    def _part(self, element: Any, shape: Shape, look: Look, mask: Any) -> Parts:
        """Faces with a look. Thin boxes that light goes through become sheets; what is no sheet has half of the pane on each side."""
        faces = shape.faces[mask]
        if not look.is_pane:
            return [(look, faces)]
        sheets, thick = panes.sheets(faces, shape.points, shape.items[mask])
        parts = [(look, sheets)] if len(sheets) else []
        if len(thick):
            self.notes.of("bodies of glass that are no flat panes: each of their two faces has the root of the transmittance", element)
            red, green, blue = (x**0.5 for x in look.transmittance)
            parts.append((replace(look, name=f"{look.name} face", transmittance=(red, green, blue)), thick))
        return parts


def _kind(element: Any, matrix: Any) -> Kind:
    util = require("ifcopenshell.util.element")
    materials = util.get_materials(element)
    stated = util.get_pset(element, *GLAZING)
    is_stated = isinstance(stated, float) and 0.0 < stated <= 1.0
    glass = Look(f"Glass {stated:g}", transmittance=(stated,) * 3) if is_stated else GLASS
    up = tuple(np.round(matrix[2, :3], 3).tolist()) if any(element.is_a(name) for name in SLABS) else None
    # The panels of curtain walls are named by what they are.
    names = [element.Name if element.is_a("IfcPlate") else None, materials[0].Name if len(materials) == 1 else None]
    is_glass = any(looks.is_glass(name) for name in names)
    return Kind(looks.of_class(element), glass, is_stated, element.is_a("IfcWindow"), is_glass, up)


def _by_form(shape: Shape) -> Any:
    """Faces of a window that are flat full rectangles: its glass, or the whole window."""
    glazing = np.zeros(len(shape.faces), bool)
    for members in panes.components(shape.faces, shape.points, shape.items):
        glazing[members] = panes.is_pane(shape.faces[members], shape.points)
    return glazing


def _without_style(kind: Kind, shape: Shape) -> list[tuple[Look, Any]]:
    """Which faces have which look by what the element is; those of slabs by where they look."""
    if kind.is_glass or kind.up is None:
        return [(kind.glass if kind.is_glass else kind.plain, np.ones(len(shape.faces), bool))]
    a, b, c = (shape.points[shape.faces[:, i]] for i in range(3))
    normals = np.cross(b - a, c - a)
    slopes = normals @ kind.up / np.maximum(np.linalg.norm(normals, axis=1), 1e-30)
    sides = [(looks.default("floor", looks.FLOOR), slopes > LEVEL), (looks.default("ceiling", looks.CEILING), slopes < -LEVEL)]
    return [*sides, (kind.plain, np.abs(slopes) <= LEVEL)]


def _glazing_items(model: Any) -> set[int]:
    """Numbers of items that shape aspects call glazing."""
    return {
        item.id()
        for aspect in model.by_type("IfcShapeAspect")
        if looks.is_glass(aspect.Name)
        for representation in aspect.ShapeRepresentations
        for item in representation.Items
    }

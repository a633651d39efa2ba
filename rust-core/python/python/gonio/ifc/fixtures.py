"""Light sources of light fixtures, and what properties say of their light."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from .extra import require
from .notes import Notes
from .tree import DEEPEST, parent

# Occurrences of IFC2X3 are flow terminals that a type makes lamps.
FIXTURES = ("IfcLightFixture", "IfcLamp")
TYPES = ("IfcLightFixtureType", "IfcLampType")
FILES = (".ies", ".ldt", ".gldf")


@dataclass(frozen=True)
class Fixture:
    """A light fixture with its light sources, each with the matrix (on columns, metres) that it is placed by."""

    element: Any
    sources: list[tuple[Any, Any]] = field(repr=False)
    origin: Any = field(repr=False)
    properties: dict[str, Any] = field(repr=False)

    @property
    def maintenance(self) -> float:
        """The maintenance factor that its properties state, else 1."""
        factor = self.number("MaintenanceFactor")
        return factor if 0.0 < factor <= 1.0 else 1.0

    @property
    def lumens(self) -> float:
        """Luminous flux of its lamps by their properties, 0 without."""
        return self.number("ContributedLuminousFlux") * max(self.number("NumberOfSources"), 1.0)

    @property
    def temperature(self) -> float:
        """Colour temperature by properties, 0 without."""
        return self.number("ColorTemperature")

    @property
    def whole(self) -> Any:
        """The luminaire that it is part of, or itself."""
        found = self.element
        for _ in range(DEEPEST):
            above = parent(found)
            if above is None or not any(above.is_a(name) for name in FIXTURES):
                break
            found = above
        return found

    def number(self, name: str) -> float:
        """A property that is a number, 0 where it is none."""
        value = self.properties.get(name)
        return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else 0.0

    def files(self) -> list[str]:
        """Names of photometric files among the properties."""
        return [value for value in self.properties.values() if isinstance(value, str) and value.lower().endswith(FILES)]


def read(model: Any, metre: float, notes: Notes) -> list[Fixture]:
    """All fixtures, and whatever else has light sources in its representation."""
    any_source = bool(model.by_type("IfcLightSource"))
    found = []
    for element in model.by_type("IfcElement"):
        with notes.sound(element):
            found += _fixture(element, metre, any_source)
    return found


def _fixture(element: Any, metre: float, any_source: bool) -> list[Fixture]:
    """The element as a fixture, if it is one."""
    kind = require("ifcopenshell.util.element").get_type(element)
    is_fixture = any(element.is_a(name) for name in FIXTURES) or (kind is not None and any(kind.is_a(name) for name in TYPES))
    pairs = _sources(element, kind) if any_source else []
    # A fixture with lamps shines by these.
    has_lamps = any(part.is_a("IfcLamp") for part in require("ifcopenshell.util.element").get_decomposition(element))
    if not pairs and (has_lamps or not is_fixture):
        return []
    origin = _metres(_placement(element), metre)
    sources = [(source, origin @ _metres(matrix, metre)) for source, matrix in pairs]
    return [Fixture(element, sources, origin, _properties(element))]


def _properties(element: Any) -> dict[str, Any]:
    """Single values of all property sets, of a lamp those of its fixture too."""
    util = require("ifcopenshell.util.element")
    values: dict[str, Any] = {}
    above = parent(element) if element.is_a("IfcLamp") else None
    for part in [above, element] if above is not None and above.is_a("IfcLightFixture") else [element]:
        for properties in util.get_psets(part).values():
            values.update({name: value for name, value in properties.items() if isinstance(value, (str, int, float))})
    return values


def _sources(element: Any, kind: Any) -> list[tuple[Any, Any]]:
    """Light sources with their matrices in the element's space, in the project's unit."""
    representations = element.Representation.Representations if element.Representation else ()
    found = [pair for representation in representations for pair in _in(representation.Items, np.eye(4))]
    if not found and kind is not None:
        maps = kind.RepresentationMaps or () if hasattr(kind, "RepresentationMaps") else ()
        found = [pair for one in maps for pair in _in(one.MappedRepresentation.Items, np.eye(4))]
    return found


def _in(items: Any, matrix: Any) -> Iterator[tuple[Any, Any]]:
    for item in items:
        if item.is_a("IfcLightSource"):
            yield item, matrix
        elif item.is_a("IfcMappedItem"):
            mapped = require("ifcopenshell.util.placement").get_mappeditem_transformation(item)
            yield from _in(item.MappingSource.MappedRepresentation.Items, matrix @ mapped)


def _placement(element: Any) -> Any:
    return require("ifcopenshell.util.placement").get_local_placement(element.ObjectPlacement) if element.ObjectPlacement else np.eye(4)


def _metres(matrix: Any, metre: float) -> Any:
    result = np.array(matrix, "f8")
    result[:3, 3] *= metre
    return result

"""The model's structure as paths of prims: project, site, building, storey, element."""

from __future__ import annotations

import re
import unicodedata
from typing import Any

ROOT = "/Model"
MATERIALS = f"{ROOT}/Materials"
SHAPES = f"{ROOT}/Shapes"
# Deeper structures are circles.
DEEPEST = 64


def identifier(name: str) -> str:
    """A prim's name: ASCII letters, digits and underscores."""
    plain = unicodedata.normalize("NFKD", name).encode("ascii", "ignore").decode()
    word = re.sub(r"[^A-Za-z0-9]+", "_", plain).strip("_")
    return word if word and not word[0].isdigit() else f"_{word}" if word else ""


class Names:
    """Names that no two prims with the same parent share."""

    def __init__(self) -> None:
        self._taken: set[str] = {MATERIALS, SHAPES}

    def below(self, parent: str, wish: str) -> str:
        """A free path; a number is added where the wish is taken."""
        path, number = f"{parent}/{wish}", 1
        while path in self._taken:
            number += 1
            path = f"{parent}/{wish}_{number}"
        self._taken.add(path)
        return path


class Tree:
    """Paths of elements; those that elements lie in are made with them."""

    def __init__(self) -> None:
        self.names = Names()
        self.paths: dict[int, str] = {}
        self.entities: dict[str, Any] = {}
        # Paths with something below them.
        self.branches: set[str] = set()

    def path(self, entity: Any, depth: int = 0) -> str:
        """The path of an element, a part of the spatial structure or the project."""
        if entity is None or entity.is_a("IfcProject") or depth > DEEPEST:
            return ROOT
        if entity.id() not in self.paths:
            above = self.path(_around(entity), depth + 1)
            path = self.names.below(above, _wish(entity))
            self.paths[entity.id()] = path
            self.entities[path] = entity
            self.branches.add(above)
        return self.paths[entity.id()]


def _around(entity: Any) -> Any:
    """What an element lies in, but for rooms: a room's prim is its grid, and has nothing below it."""
    above = parent(entity)
    for _ in range(DEEPEST):
        if above is None or not above.is_a("IfcSpace"):
            break
        above = parent(above)
    return above


def title(entity: Any) -> str:
    """What people call it; of a room its number and its name."""
    name, long_name = _names(entity)
    if entity.is_a("IfcSpace"):
        return " ".join(word for word in (name, long_name) if word)
    return name or long_name


def _wish(entity: Any) -> str:
    """The name of an element's prim; a room's begins with what the room is, since its number cannot come first."""
    name, long_name = _names(entity)
    wish = f"{long_name} {name}" if entity.is_a("IfcSpace") else name or long_name
    return identifier(wish) or str(entity.is_a()).removeprefix("Ifc")


def _names(entity: Any) -> tuple[str, str]:
    """Number and name of a room whose name has its long name in it; else name and long name."""
    name, long_name = entity.Name or "", getattr(entity, "LongName", None) or ""
    return (name.replace(long_name, "").strip(" -_:.,/"), long_name) if entity.is_a("IfcSpace") and long_name else (name, long_name)


def parent(entity: Any) -> Any:
    """What an element is part of, contained in, nested in, or fills; None without such."""
    for inverse in ("Decomposes", "Nests"):
        for relation in getattr(entity, inverse, None) or ():
            if relation.RelatingObject:
                return relation.RelatingObject
    for relation in getattr(entity, "ContainedInStructure", None) or ():
        return relation.RelatingStructure
    for filling in getattr(entity, "FillsVoids", None) or ():
        for void in filling.RelatingOpeningElement.VoidsElements:
            return void.RelatingBuildingElement
    return None

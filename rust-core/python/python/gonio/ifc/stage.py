"""An IFC model as a USD stage."""

from __future__ import annotations

from collections import Counter
from pathlib import Path
from typing import Any

from . import fixtures, prims, rooms, shapes, site
from .extra import require
from .lights import Lights
from .notes import Notes
from .opened import open_model
from .photometry import Photometry
from .shapes import Placed
from .surfaces import Surfaces
from .tree import ROOT, Tree
from .writing import SHARED_FROM, Writer

# What has a body and is none of a building's: openings, what is only reckoned with, steel within concrete.
LEFT_OUT = ("IfcFeatureElementSubtraction", "IfcVirtualElement", "IfcReinforcingElement")
# Kinds of representations that have no surface.
FLAT = {None, "Curve", "Curve2D", "Curve3D", "GeometricCurveSet", "GeometricSet", "Annotation2D", "FootPrint", "BoundingBox", "LightSource"}
# Names of stages.
SUFFIXES = (".usda", ".usdc", ".usd")


def build(source: Path, target: Path) -> list[str]:
    """Writes the stage of a model in this process, and gives the notes; ValueError for what is no model."""
    if target.suffix not in SUFFIXES:
        raise ValueError(f"{target}: expected a stage whose name ends in {', '.join(SUFFIXES)}")
    return _Build(source, target).run()


class _Build:
    """The way from a model to a stage."""

    def __init__(self, source: Path, target: Path) -> None:
        self.source = source
        self.notes = Notes()
        self.model = open_model(source)
        unit = require("ifcopenshell.util.unit").calculate_unit_scale
        self.metre, self.radian = float(unit(self.model)), float(unit(self.model, "PLANEANGLEUNIT"))
        self.tree = Tree()
        self.writer = Writer(target, self.tree.names)
        photometry = Photometry(source, target, self.radian, self.notes)
        self.lights = Lights(photometry, self.metre, self.radian, self.notes)

    def run(self) -> list[str]:
        """Reads, writes, and gives the notes."""
        bodies = self._bodies()
        lit = [(fixture, lamps) for fixture in fixtures.read(self.model, self.metre, self.notes) if (lamps := self.lights.lamps(fixture))]
        spaces = shapes.read(self.model, _with_body(self.model, "IfcSpace"))
        grids = [found for space in spaces if (found := rooms.grid(space, self.notes))]
        for element in [body.element for body in bodies] + [fixture.element for fixture, _ in lit] + [grid.space for grid in grids]:
            self.tree.path(element)
        self._place(bodies)
        self._write_bodies(bodies, {fixture.element.id() for fixture, _ in lit})
        with_body = {body.element.id() for body in bodies}
        for fixture, lamps in lit:
            has_body = not with_body.isdisjoint([fixture.element.id(), fixture.whole.id()])
            for lamp in lamps:
                prims.lamp(self.writer, self.tree.path(fixture.element), lamp, self.tree.path(fixture.whole) if has_body else None)
        for grid in grids:
            prims.grid(self.writer, self.tree.path(grid.space), grid)
        for path, entity in self.tree.entities.items():
            self.writer.about(path, entity)
        self.writer.save()
        return self.notes.lines()

    def _bodies(self) -> list[Placed]:
        """Surfaces of all elements and of the ground; those without are told."""
        kinds = ("IfcElement", "IfcSite", "IfcBuilding")
        wanted = [element for kind in kinds for element in _with_body(self.model, kind) if not any(element.is_a(name) for name in LEFT_OUT)]
        found = list(shapes.read(self.model, wanted))
        if not found:
            count = len(self.model.by_type("IfcProduct"))
            raise ValueError(f"{self.source}: the model has no geometry that can be seen ({count} products); export the bodies of its elements")
        seen = {body.element.id() for body in found}
        for element in wanted:
            with self.notes.sound(element):
                if element.id() not in seen and _is_solid(element):
                    self.notes.of("IfcOpenShell makes no surface of these, which are left out", element)
        for element in self.model.by_type("IfcReinforcingElement"):
            self.notes.of("reinforcement is left out", element)
        return found

    def _place(self, bodies: list[Placed]) -> None:
        """Turns the model to north, brings it to the origin, and says where it is."""
        found = site.read(self.model, self.metre, self.notes)
        project = self.model.by_type("IfcProject")[0]
        root = self.writer.root
        self.writer.about(ROOT, project)
        if found.turn:
            root.AddRotateZOp().Set(found.turn)
            self.notes.say(f"the model is turned by {found.turn:g}° about z, so that true north is +y")
        shift = site.shift([body.points() for body in bodies])
        if shift.any():
            x, y, z = (-shift).tolist()
            root.AddTranslateOp().Set(self.writer.gf.Vec3d(x, y, z))
            self.notes.say(f"the model lies far from its origin and is moved by {x:g}, {y:g}, {z:g} m, before any turn")
        for name in ("latitude", "longitude", "elevation"):
            if (value := getattr(found, name)) is not None:
                self.writer.custom(root.GetPrim(), name, "Double", value)

    def _write_bodies(self, bodies: list[Placed], lit: set[int]) -> None:
        """A mesh for each element, an instance where a large shape stands several times."""
        surfaces = Surfaces(self.model, self.notes)
        parts = [surfaces.parts(body) for body in bodies]
        counts = Counter(map(id, parts))
        for body, own in zip(bodies, parts):
            if not own:
                continue
            path = self.tree.path(body.element)
            if path in self.tree.branches or body.element.id() in lit:
                path = self.tree.names.below(path, "Body")
            if counts[id(own)] > 1 and len(body.shape.faces) >= SHARED_FROM:
                self.writer.shared(path, id(own), body.shape.points, own)
            else:
                self.writer.mesh(path, body.shape.points, own)
            self.writer.place(path, body.matrix)


def _with_body(model: Any, kind: str) -> list[Any]:
    return [element for element in model.by_type(kind) if element.Representation]


def _is_solid(element: Any) -> bool:
    """Whether an element has more than axes, plans and light sources."""
    return any(representation.RepresentationType not in FLAT for representation in element.Representation.Representations)

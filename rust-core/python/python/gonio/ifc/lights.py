"""Light sources of fixtures as lamps: with a distribution and its flux, or with a flux alone."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .fixtures import Fixture
from .looks import Colour, linear, rgb
from .notes import Notes
from .photometry import Photometry

# A colour temperature is one within these, K.
COOLEST, HOTTEST = 500.0, 50_000.0


@dataclass(frozen=True)
class Lamp:
    """A light of the stage: a file's distribution or an even one, a flux in lm where it is not the file's, a spot's cone in degrees."""

    matrix: Any = field(repr=False)
    file: Path | None = None
    lumens: float | None = None
    temperature: float = 0.0
    colour: Colour | None = None
    maintenance: float = 1.0
    cone: float | None = None
    softness: float = 0.0
    focus: float = 0.0


class Lights:
    """Reads the lamps of fixtures; `metre` and `radian` are the project's units."""

    def __init__(self, photometry: Photometry, metre: float, radian: float, notes: Notes) -> None:
        self.photometry, self.metre, self.radian, self.notes = photometry, metre, radian, notes

    def lamps(self, fixture: Fixture) -> list[Lamp]:
        """The fixture's lamps; what gives no light is told."""
        found: list[Lamp] = []
        for source, matrix in fixture.sources:
            with self.notes.sound(fixture.element):
                found += filter(None, [self._lamp(fixture, source, matrix)])
        if not fixture.sources:
            found = self._by_properties(fixture)
        if found and fixture.maintenance < 1.0:
            self.notes.of(f"light is multiplied by the maintenance factor {fixture.maintenance:g} of their properties", fixture.element)
        return found

    def _lamp(self, fixture: Fixture, source: Any, matrix: Any) -> Lamp | None:
        if source.is_a("IfcLightSourceGoniometric"):
            return self._goniometric(fixture, source, matrix)
        if source.is_a("IfcLightSourcePositional"):
            return self._positional(fixture, source, matrix)
        self.notes.of(f"{source.is_a()} has no photometry and gives no light", fixture.element)
        return None

    def _goniometric(self, fixture: Fixture, source: Any, matrix: Any) -> Lamp | None:
        data, stated = source.LightDistributionDataSource, float(source.LuminousFlux or 0.0)
        lumens = None
        if data.is_a("IfcLightIntensityDistribution"):
            file = self.photometry.inline(fixture, data, stated)
        else:
            file, lumens = self.photometry.external(fixture, data, stated) or (None, None)
        if file is None:
            return None
        colour = _colour(source.ColourAppearance or source.LightColour)
        temperature = _temperature(source.ColourTemperature) or _temperature(fixture.temperature)
        place = matrix @ self._axes(source.Position)
        return Lamp(place, file, lumens, temperature, colour, fixture.maintenance)

    def _positional(self, fixture: Fixture, source: Any, matrix: Any) -> Lamp | None:
        if fixture.lumens <= 0.0:
            self.notes.of(f"{source.is_a()} does not say its luminous flux and gives no light", fixture.element)
            return None
        place = np.eye(4)
        place[:3, 3] = np.array(source.Position.Coordinates, "f8") * self.metre
        words = (fixture.lumens / len(fixture.sources), _temperature(fixture.temperature), _colour(source.LightColour), fixture.maintenance)
        if not source.is_a("IfcLightSourceSpot"):
            return Lamp(matrix @ place, None, *words)
        place[:3, :3] = _facing(np.array(source.Orientation.DirectionRatios, "f8"))
        spread, beam = (min(math.degrees(angle * self.radian), 180.0) for angle in (source.SpreadAngle, source.BeamWidthAngle))
        softness = max(0.0, 1.0 - beam / spread)
        return Lamp(matrix @ place, None, *words, spread, softness, float(source.ConcentrationExponent or 0.0))

    def _by_properties(self, fixture: Fixture) -> list[Lamp]:
        """A file that a property names, at the fixture's origin, or nothing."""
        for name in fixture.files()[:1]:
            if found := self.photometry.named(fixture, name, 0.0):
                self.notes.of("photometry by a property, at the fixture's origin, down along its -z", fixture.element)
                return [Lamp(fixture.origin, found[0], None, _temperature(fixture.temperature), None, fixture.maintenance)]
            return []
        watts = fixture.number("TotalWattage")
        self.notes.of(f"no photometry, and so no light{f' ({watts:g} W)' if watts else ''}", fixture.element)
        return []

    def _axes(self, placement: Any) -> Any:
        """The matrix of an IfcAxis2Placement3D, metres."""
        z = np.array(placement.Axis.DirectionRatios if placement.Axis else (0.0, 0.0, 1.0), "f8")
        x = np.array(placement.RefDirection.DirectionRatios if placement.RefDirection else (1.0, 0.0, 0.0), "f8")
        matrix = np.eye(4)
        matrix[:3, :3] = _frame(z, x)
        matrix[:3, 3] = np.array(placement.Location.Coordinates, "f8") * self.metre
        return matrix


def _facing(direction: Any) -> Any:
    """Axes whose -z is a direction."""
    return _frame(-direction, np.array((1.0, 0.0, 0.0)))


def _frame(z: Any, x: Any) -> Any:
    """Orthonormal axes as columns, z as given, x as near to the wish as can be."""
    z = z / np.linalg.norm(z)
    across = x - (x @ z) * z
    if np.linalg.norm(across) < 1e-6:
        across = np.eye(3)[np.abs(z).argmin()]
        across = across - (across @ z) * z
    x = across / np.linalg.norm(across)
    return np.stack([x, np.cross(z, x), z], axis=1)


def _temperature(kelvin: Any) -> float:
    """A colour temperature in K, 0 for what is none."""
    return float(kelvin) if kelvin and COOLEST <= kelvin <= HOTTEST else 0.0


def _colour(colour: Any) -> Colour | None:
    """A lamp's colour; black is none."""
    found = linear(rgb(colour)) if colour is not None else None
    return found if found and max(found) > 0.0 else None

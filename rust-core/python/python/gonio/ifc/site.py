"""Where a model lies: true north, latitude and longitude, distance from the project's origin."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from .notes import Notes

# Single precision keeps a tenth of a millimetre within a kilometre.
FAR = 1000.0


@dataclass(frozen=True)
class Site:
    """Turn about z in degrees that brings true north to +y; degrees north and east, metres above the sea."""

    turn: float
    latitude: float | None
    longitude: float | None
    elevation: float | None


def read(model: Any, metre: float, notes: Notes) -> Site:
    """The site; `metre` is the length of the project's unit."""
    turn = None
    for context in model.by_type("IfcGeometricRepresentationContext", include_subtypes=False):
        with notes.sound(context):
            turn = _turn(context) if turn is None else turn
    if turn is None:
        notes.say("the model does not say where true north is; +y is taken")
    for conversion in [] if model.schema == "IFC2X3" else model.by_type("IfcMapConversion"):
        with notes.sound(conversion):
            _tell_map(conversion, notes)
    for site in model.by_type("IfcSite"):
        with notes.sound(site):
            latitude, longitude = degrees(site.RefLatitude), degrees(site.RefLongitude)
            if latitude is None or longitude is None:
                continue
            notes.say(f"the site lies at {latitude:.5f}° north, {longitude:.5f}° east: --sun {latitude:.5f},{longitude:.5f},TIME")
            elevation = None if site.RefElevation is None else site.RefElevation * metre
            return Site(turn or 0.0, latitude, longitude, elevation)
    return Site(turn or 0.0, None, None, None)


def degrees(parts: Sequence[int] | None) -> float | None:
    """Degrees, minutes, seconds and millionths of a second (IfcCompoundPlaneAngleMeasure) as degrees."""
    if not parts:
        return None
    # All parts have the same sign; some programs give it to the first alone.
    sign = -1.0 if any(part < 0 for part in parts) else 1.0
    return sign * sum(abs(part) / unit for part, unit in zip(parts, (1.0, 60.0, 3600.0, 3.6e9)))


def shift(points: list[Any]) -> Any:
    """The whole metres by which far points (rows of x, y, z) are brought to the origin; zeros where they are near."""
    low, high = np.min([p.min(axis=0) for p in points], axis=0), np.max([p.max(axis=0) for p in points], axis=0)
    if max(np.abs(low).max(), np.abs(high).max()) <= FAR:
        return np.zeros(3)
    return np.round([0.5 * (low[0] + high[0]), 0.5 * (low[1] + high[1]), low[2]])


def _turn(context: Any) -> float | None:
    """Degrees counter-clockwise from the project's true north to +y."""
    if context.ContextType == "Model" and context.TrueNorth:
        x, y, *_ = context.TrueNorth.DirectionRatios
        if x or y:
            return round(math.degrees(math.atan2(x, y)), 9)
    return None


def _tell_map(conversion: Any, notes: Notes) -> None:
    east, north, height = conversion.Eastings, conversion.Northings, conversion.OrthogonalHeight
    name = getattr(conversion.TargetCRS, "Name", None) or "a map"
    notes.say(f"the project's origin is at {east:g} east, {north:g} north, {height:g} high in {name}; the stage keeps the project's coordinates")

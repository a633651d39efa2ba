"""Lamps and calculation grids as prims with gonio's attributes."""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import numpy as np

from .lights import Lamp
from .rooms import Grid
from .writing import NOTHING, Writer

# Radius of lamps of which nothing is said but their flux, metres.
RADIUS = 0.02
# Cones from here on are none.
FULL_CONE = 180.0


def lamp(writer: Writer, above: str, found: Lamp, body: str | None) -> None:
    """A light below its fixture; the luminaire's body casts no shadow on it, for photometry is that of the whole luminaire."""
    path = writer.names.below(above, "Light")
    if not writer.stage.GetPrimAtPath(above):
        writer.geom.Xform.Define(writer.stage, above)
    light = writer.lux.SphereLight.Define(writer.stage, path)
    light.CreateRadiusAttr(RADIUS)
    writer.place(path, found.matrix)
    if found.colour and not found.temperature:
        light.CreateColorAttr(writer.gf.Vec3f(*found.colour))
    if found.temperature:
        light.CreateEnableColorTemperatureAttr(True)
        light.CreateColorTemperatureAttr(found.temperature)
    prim = light.GetPrim()
    if found.file:
        _photometry(writer, prim, "file", "Asset", writer.sdf.AssetPath(_asset(found.file, writer.path)))
    if found.lumens is not None:
        _photometry(writer, prim, "quantity", "Double", found.lumens)
        _photometry(writer, prim, "unit", "Token", "lm")
    if found.maintenance < 1.0:
        _photometry(writer, prim, "maintenanceFactor", "Float", found.maintenance)
    if found.cone is not None and found.cone < FULL_CONE:
        shaping = writer.lux.ShapingAPI.Apply(prim)
        shaping.CreateShapingConeAngleAttr(found.cone)
        shaping.CreateShapingConeSoftnessAttr(found.softness)
        shaping.CreateShapingFocusAttr(found.focus)
    if body:
        blockers = writer.usd.CollectionAPI.Apply(prim, "shadowLink")
        blockers.CreateIncludeRootAttr(True)
        blockers.CreateExcludesRel().SetTargets([body])


def grid(writer: Writer, path: str, found: Grid) -> None:
    """A room's work plane: nothing but a rectangle, or a surface that light passes."""
    if found.size:
        prim = writer.geom.Xform.Define(writer.stage, path).GetPrim()
        writer.place(path, found.matrix)
        _grid(writer, prim, "size", "Double2", writer.gf.Vec2d(*found.size))
    else:
        writer.mesh(path, found.points, [(NOTHING, np.asarray(found.faces))])
        prim = writer.stage.GetPrimAtPath(path)
    _grid(writer, prim, "quantity", "Token", "illuminance")
    _grid(writer, prim, "margin", "Double", found.margin)


def _photometry(writer: Writer, prim: Any, name: str, kind: str, value: Any) -> None:
    prim.CreateAttribute(f"gonio:photometry:{name}", getattr(writer.sdf.ValueTypeNames, kind), True).Set(value)


def _grid(writer: Writer, prim: Any, name: str, kind: str, value: Any) -> None:
    prim.CreateAttribute(f"gonio:grid:{name}", getattr(writer.sdf.ValueTypeNames, kind), True).Set(value)


def _asset(file: Path, stage: Path) -> str:
    """A file's name as a stage beside it has it, else its whole path."""
    file, folder = file.resolve(), stage.resolve().parent
    return f"./{file.name}" if file.parent == folder else file.as_posix().replace(os.sep, "/")

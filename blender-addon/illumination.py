# SPDX-License-Identifier: GPL-3.0-or-later
"""Illumination maps: the light that objects get, as images over their UV maps and as attributes of their meshes."""

from dataclasses import dataclass

import bpy
import gonio
import numpy as np

from .export import Exporter
from .export.material.inputs import UV
from .export.mesh import triangle_loops
from .report import Report

SIDES = {"FRONT": ("front",), "BACK": ("back",), "BRIGHTER": ("front", "back")}


@dataclass(frozen=True)
class Target:
    """An object that gets a map."""

    name: str
    uid: int
    # What the engine calls the UV map, for images.
    uv: str | None = None
    # For attributes: each triangle's corners (T, 3), its face and its square metres, the points of corners, and how many points and faces there are.
    loops: np.ndarray | None = None
    faces: np.ndarray | None = None
    areas: np.ndarray | None = None
    points: np.ndarray | None = None
    counts: tuple[int, int] = (0, 0)


@dataclass(frozen=True)
class Found:
    """What a target got: which side is shown, and the engine's map."""

    target: Target
    side: str
    surface: object

    def line(self) -> str:
        """Its figures in words."""
        surface, side = self.surface, self.side
        direct, error = (value / surface.area for value in (surface.direct_flux(side), surface.flux_error(side)))
        of_side = " (back)" if side == "back" else ""
        return f"{self.target.name}{of_side}: {surface.mean(side):,.4g} lx ± {error:.2g}, direct {direct:,.4g}"


def targets(depsgraph, things, *, images: bool) -> list[Target]:
    """Objects as targets, for images or attributes; raises ValueError with the first thing that makes no map."""
    shown = [thing for thing in things if thing.type in {"MESH", "CURVE", "SURFACE", "FONT", "META"}]
    if not shown:
        raise ValueError("No surface is selected: select the objects that are to keep their light")
    if not images:
        _check_owners(shown)
    return [_target(depsgraph, thing, images) for thing in shown]


def _target(depsgraph, thing, images: bool) -> Target:
    evaluated = thing.evaluated_get(depsgraph)
    mesh = evaluated.to_mesh()
    try:
        if mesh is None or len(mesh.polygons) == 0:
            raise ValueError(f"{thing.name}: it has no faces")
        if images:
            return Target(thing.name, thing.session_uid, _coordinates(thing.name, mesh))
        return _of_attribute(thing, mesh, np.array(evaluated.matrix_world, dtype=float)[:3, :3])
    finally:
        evaluated.to_mesh_clear()


def _coordinates(name: str, mesh) -> str:
    """What the engine calls the active UV map."""
    layer = mesh.uv_layers.active
    if layer is None:
        raise ValueError(f"{name}: it has no UV map; unwrap it, or keep the light in an attribute")
    corners = np.empty((len(mesh.loops), 2), dtype=np.float32)
    layer.uv.foreach_get("vector", corners.reshape(-1))
    mesh.calc_loop_triangles()
    a, b, c = np.moveaxis(corners[triangle_loops(mesh)].astype(float), 1, 0)
    (u1, v1), (u2, v2) = (b - a).T, (c - a).T
    if not np.abs(u1 * v2 - u2 * v1).sum() > 0.0:
        raise ValueError(f"{name}: its UV map '{layer.name}' encloses nothing, or is no numbers; unwrap it")
    return UV if layer.active_render else layer.name


def _check_owners(things) -> None:
    """Attributes want a mesh of each object's own, that can be written to."""
    owners = {}
    for thing in things:
        if thing.type != "MESH":
            raise ValueError(f"{thing.name}: an attribute wants a mesh; convert it, or keep the light in an image")
        if thing.data.library is not None:
            raise ValueError(f"{thing.name}: its mesh is linked from another file and takes no attributes")
        other = owners.setdefault(thing.data.session_uid, thing)
        if other is not thing:
            raise ValueError(f"{other.name} and {thing.name} share a mesh, which has one attribute for both; make it single-user")


def _of_attribute(thing, mesh, turn) -> Target:
    """A target with what leads from triangles to points, corners and faces; `turn` leads to the world."""
    mesh.calc_loop_triangles()
    loops, faces = triangle_loops(mesh), np.empty(len(mesh.loop_triangles), dtype=np.int32)
    mesh.loop_triangle_polygons.foreach_get("value", faces)
    points = _corner_points(mesh)
    if len(mesh.polygons) != len(thing.data.polygons) or not np.array_equal(points, _corner_points(thing.data)):
        raise ValueError(f"{thing.name}: its modifiers change its faces; apply them, or keep the light in an image")
    places = np.empty((len(mesh.vertices), 3), dtype=np.float32)
    mesh.attributes["position"].data.foreach_get("vector", places.reshape(-1))
    a, b, c = np.moveaxis((places @ turn.T)[points[loops]], 1, 0)
    areas = 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)
    return Target(thing.name, thing.session_uid, None, loops, faces, areas, points, (len(mesh.vertices), len(mesh.polygons)))


def _corner_points(mesh):
    corners = np.empty(len(mesh.loops), dtype=np.int32)
    mesh.attributes[".corner_vert"].data.foreach_get("value", corners)
    return corners


class Mapping:
    """A scene that was exported once, and the maps of some of its objects."""

    def __init__(self, depsgraph, targets: list[Target], things: dict) -> None:
        """`things` are the targets' objects by session_uid."""
        self.report, self.notes, self._targets = Report(), [], targets
        exporter = Exporter(self.report)
        self._scene = exporter.sync(depsgraph)
        exporter.settings(depsgraph, width=1, height=1, passes=["color"])
        self._instances = {}
        for target in targets:
            entry = exporter.own_entry(things[target.uid])
            if entry is None:
                raise ValueError(f"{target.name}: it is not in the scene as a surface; is it hidden?")
            self._instances[entry[0]] = target

    def run(self, cancelled=None, *, side: str = "BRIGHTER", **options) -> list[Found]:
        """Traces light with options of `gonio.illumination_map`; it asks nothing of Blender, so that any thread may wait for it."""
        found = []
        for uv in dict.fromkeys(target.uv for target in self._targets):
            names = [target.name for target in self._targets if target.uv == uv]
            maps = gonio.illumination_map(self._scene, prims=names, uv=uv, cancelled=cancelled, **options)
            self.notes += maps.diagnostics
            for surface in maps.surfaces:
                # Others may have the same name; what an object shows itself is its first placement.
                target = self._instances.get(surface.instances)
                if target is not None and target.uv == uv and surface.placement == 0:
                    found.append(Found(target, max(SIDES[side], key=surface.flux), surface))
        self.report.add_render(self.notes)
        missing = next((target for target in self._targets if all(each.target is not target for each in found)), None)
        if missing is not None:
            raise ValueError(f"{missing.name}: none of its faces has an area")
        return found


def write_image(found: Found, name: str, quantity: str, margin: int):
    """Puts the texels' lux into an image of floats of this name, `margin` texels beyond the charts, and gives the image."""
    lux = np.asarray(found.surface.illuminance(found.side))
    direct = np.asarray(found.surface.direct(found.side))
    lux = {"ILLUMINANCE": lux, "DIRECT": direct, "INDIRECT": lux - direct}[quantity]
    # What has no faces stays black.
    lux = np.nan_to_num(spread(lux, margin))
    height, width = lux.shape
    image = bpy.data.images.get(name)
    if image is None or not image.is_float or image.library is not None:
        image = bpy.data.images.new(name, width, height, float_buffer=True, is_data=True)
    elif tuple(image.size) != (width, height):
        image.scale(width, height)
    pixels = np.ones((height, width, 4), dtype=np.float32)
    pixels[..., :3] = lux[::-1, :, None]
    image.pixels.foreach_set(pixels.reshape(-1))
    image.update()
    # The file keeps it, and so does undo.
    image.pack()
    return image


def spread(values: np.ndarray, steps: int) -> np.ndarray:
    """Values (height, width) with what is no number filled from its neighbours, step by step."""
    for _ in range(steps):
        empty = np.isnan(values)
        if not empty.any() or empty.all():
            break
        padded = np.pad(values, 1, constant_values=np.nan)
        height, width = values.shape
        around = np.stack([padded[y : y + height, x : x + width] for y in range(3) for x in range(3)])
        count = (~np.isnan(around)).sum(axis=0)
        filled = np.nansum(around, axis=0) / np.maximum(count, 1)
        values = np.where(empty & (count > 0), filled, values)
    return values


def write_attribute(found: Found, mesh, name: str, quantity: str, domain: str):
    """Puts lux into an attribute of points, corners or faces, and gives it."""
    target = found.target
    values = of_domain(found, quantity, domain)
    attribute = mesh.attributes.get(name)
    if attribute is not None and attribute.data_type != "FLOAT":
        raise ValueError(f"{target.name}: its mesh has another attribute '{name}' that holds no lux; choose another name")
    if attribute is not None and attribute.domain != domain:
        mesh.attributes.remove(attribute)
        attribute = None
    if attribute is None:
        attribute = mesh.attributes.new(name, "FLOAT", domain)
    attribute.data.foreach_set("value", values.astype(np.float32))
    mesh.update()
    return attribute


def of_domain(found: Found, quantity: str, domain: str) -> np.ndarray:
    """Lux of a target's points, corners or faces; 0 of what no triangle has."""
    target, surface, kind = found.target, found.surface, quantity.lower()
    if domain == "FACE":
        return _means(target.faces, np.asarray(surface.of_triangles(found.side, quantity=kind)), target.areas, target.counts[1])
    lux = np.asarray(surface.at_corners(found.side, quantity=kind))
    number = target.loops.reshape(-1) if domain == "CORNER" else target.points[target.loops].reshape(-1)
    count = len(target.points) if domain == "CORNER" else target.counts[0]
    return _means(number, lux.reshape(-1), np.repeat(target.areas, 3), count)


def _means(number, values, weights, count):
    """Weighted means by number."""
    total = np.bincount(number, weights, minlength=count)
    return np.bincount(number, weights * values, minlength=count) / np.where(total > 0.0, total, 1.0)

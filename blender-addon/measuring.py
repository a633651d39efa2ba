# SPDX-License-Identifier: GPL-3.0-or-later
"""Meters and calculation grids: what operators measure and panels show."""

from dataclasses import dataclass, field

import bpy
import gonio
import numpy as np
from bpy.app.handlers import persistent

from .export import Exporter
from .report import Report

# The least cosine between a level face's normal and the vertical.
LEVEL = 0.999
# What the figures of a quantity are called; of others they are illuminances.
SYMBOLS = {"daylight-factor": "D", "ugr": "UGR", "cct": "CCT", "duv": "Duv", "ra": "Ra", "rf": "Rf", "rg": "Rg"}
# Quantities that eyes have.
OF_EYES = ("illuminance", "melanopic-edi", "cct", "duv", "ra", "rf", "rg")
# Quantities that are how much light there is, of which evenness can be told.
AMOUNTS = ("illuminance", "cylindrical", "daylight-factor", "melanopic-edi")


@dataclass
class Readings:
    """What was measured last."""

    # By the object's name.
    grids: dict = field(default_factory=dict)
    # By the object's name, lines of a year's figures.
    years: dict = field(default_factory=dict)
    # Lines of figures as the N-panel shows them.
    point: tuple = ()
    # Levels of light groups, and what they make of targets.
    levels: tuple = ()
    luminaire: tuple = ()
    maps: tuple = ()

    def clear(self) -> None:
        """Forgets everything."""
        vars(self).update(vars(Readings()))


latest = Readings()


@persistent
def _forget(*_arguments) -> None:
    """Another file's objects may have the same names."""
    latest.clear()


def register() -> None:
    bpy.app.handlers.load_post.append(_forget)


def unregister() -> None:
    bpy.app.handlers.load_post.remove(_forget)


class Meter:
    """A scene to measure in, exported once."""

    def __init__(self, depsgraph) -> None:
        self.report = Report()
        self._exporter = Exporter(self.report)
        self.scene = self._exporter.sync(depsgraph)
        self._exporter.settings(depsgraph, width=1, height=1, passes=["color"])
        self._compiled = None

    def at(self, position, normal, eye, towards, samples: int):
        """Illuminance at `position` on the plane across `normal`, and the luminance that is seen from `eye` towards `towards`."""
        self.scene.truncate("meters", 0)
        self.scene.truncate("grids", 0)
        self.scene.add_meter(tuple(position), normal=tuple(normal))
        self.scene.add_meter(tuple(eye), facing=tuple(towards), quantity="luminance")
        illuminance, luminance = gonio.measure(self.scene, samples=samples, previous=self._render()).meters
        return illuminance, luminance

    def put_grids(self, depsgraph, objects) -> None:
        """Puts the grids on these objects into the scene."""
        self.scene.truncate("meters", 0)
        self.scene.truncate("grids", 0)
        for thing in objects:
            self._add_grid(thing, thing.evaluated_get(depsgraph))

    def grids(self, samples: int, cancelled=None):
        """Readings of the grids that were put there, in their order; it asks nothing of Blender, so that any thread may wait for it."""
        return gonio.measure(self.scene, samples=samples, previous=self._render(cancelled), cancelled=cancelled)

    def _add_grid(self, thing, evaluated) -> None:
        settings = thing.gonio
        mesh = evaluated.to_mesh()
        try:
            points, triangles = _arrays(mesh)
            triangles = work_plane(points, triangles, np.array(evaluated.matrix_world, dtype=float)[:3, :3])
        finally:
            evaluated.to_mesh_clear()
        number = self.scene.add_mesh(points, triangles, name=thing.name)
        self.scene.add_grid(
            mesh=number,
            transform=[list(row) for row in evaluated.matrix_world],
            spacing=settings.grid_spacing,
            margin=settings.grid_margin,
            height=settings.grid_height,
            facing=tuple(evaluated.matrix_world.col[1][:3]),
            eyes=settings.grid_eyes if settings.grid_eyes and settings.grid_quantity in OF_EYES else None,
            quantity=settings.grid_quantity,
            name=thing.name,
        )

    def _render(self, cancelled=None):
        """A render of one pixel, which keeps the trees for measurements that follow."""
        if self._compiled is None:
            self.scene.add_camera()
            self.scene.set(samples=1)
            self._compiled = gonio.Render(self.scene, cancelled=cancelled)
            self._compiled.wait()
        return self._compiled


def _arrays(mesh):
    """Points and triangles of a mesh."""
    mesh.calc_loop_triangles()
    points = np.empty((len(mesh.vertices), 3), np.float32)
    mesh.attributes["position"].data.foreach_get("vector", points.ravel())
    triangles = np.empty((len(mesh.loop_triangles), 3), np.int32)
    mesh.loop_triangles.foreach_get("vertices", triangles.ravel())
    return points, triangles


def work_plane(points, triangles, turn):
    """What a grid lies on: all of a surface with one side; of furniture and other bodies their largest level top. `turn` leads to the world."""
    corners = (points[triangles] @ turn.T).astype(float)
    # Twice the triangles' areas along their normals.
    across = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]) * np.sign(np.linalg.det(turn))
    mean = across.sum(axis=0)
    if len(triangles) == 0 or (across @ mean > 0.0).all():
        return triangles
    area = np.linalg.norm(across, axis=1)
    looks_up = across[:, 2] > LEVEL * np.maximum(area, 1e-30)
    if not looks_up.any():
        return triangles
    height = corners[..., 2].mean(axis=1)
    step = 1e-3 * max(float(np.ptp(corners.reshape(-1, 3), axis=0).max()), 1e-6)
    storey = np.round(height / step).astype(int)
    levels, inverse = np.unique(storey[looks_up], return_inverse=True)
    largest = levels[np.bincount(inverse.ravel(), area[looks_up]).argmax()]
    return triangles[looks_up & (np.abs(storey - largest) <= 1)]


def grid_lines(reading) -> tuple[str, ...]:
    """The figures of a grid."""
    unit, symbol = reading.unit, SYMBOLS.get(reading.quantity, "E")
    figures = (("avg", reading.average), ("min", reading.min), ("max", reading.max))
    lines = [" ".join(f"{symbol}_{name}: {figure.value:.4g} {unit} ± {figure.standard_error:.2g}".split()) for name, figure in figures]
    columns, rows = reading.size
    least = np.asarray(reading.leasts) if reading.leasts is not None else np.empty(0)
    if np.isfinite(least).any():
        lines.append(" ".join(f"Least eye of {len(np.asarray(reading.facings))} directions: {np.nanmin(least):.4g} {unit}".split()))
    elif reading.quantity in AMOUNTS:
        lines.append(f"U0: {reading.uniformity:.3f}   Ud: {reading.diversity:.3f}")
    lines += [f"{columns} × {rows} points", *_tabular(reading), *_left_out(reading.coverage)]
    return tuple(lines)


def year_lines(reading) -> tuple[str, ...]:
    """The figures of a grid's year."""
    figures = reading.figures
    errors = figures["standard_errors"] or {}

    def share(name, label):
        value, error = figures[name], errors.get(name)
        return f"{label}: {100 * value:.1f} %" + (f" ± {100 * error:.1f}" if error is not None else "")

    mean, factor = figures["mean_lx"], figures["median_daylight_factor"]
    return (
        share("sda_300_50", "sDA 300/50 %"),
        share("ase_1000_250", "ASE 1000/250 h"),
        share("udi_100_3000", "UDI 100–3000 lx"),
        f"Mean: {mean:.4g} lx   Daylight factor: {factor:.2f} %",
        f"EN 17037: {figures['en17037']['hourly']['level']}",
    )


def _tabular(reading) -> list[str]:
    """Glare ratings as UGR tables have them, where sources are small enough for CIE 147's own formula."""
    values = np.asarray(reading.as_in_tables)
    if values.size == 0 or not reading.rating_note or "CIE 147" not in reading.rating_note:
        return []
    if not np.isfinite(values).all():
        return ["Small sources by CIE 147; points have no rating in UGR tables"]
    return ["Small sources by CIE 147; as in UGR tables:", f"UGR_avg: {values.mean():.4g}   UGR_max: {values.max():.4g}"]


def _left_out(coverage) -> list[str]:
    """What glare ratings leave out, since it is seen through glass or covers alone, or CIE 117 has no position index for it."""
    covered = sum(1 for point in coverage if point.covered)
    lines = [f"Left out behind glass or covers at {covered} points"] if covered else []
    points = [point for point in coverage if point.left_out]
    if not points:
        return lines
    most, share = max(point.left_out for point in points), max(point.share_left_out for point in points)
    return [*lines, f"Left out (CIE 117) at {len(points)} points:", f"up to {most} sources, {100 * share:.0f} % of their light"]

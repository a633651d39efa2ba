# SPDX-License-Identifier: GPL-3.0-or-later
"""Lamps, by Cycles' laws: watts become radiance of the lamp's surface, or intensity where it has none."""

from dataclasses import replace
from math import degrees, hypot, pi, sin

import numpy as np

from .. import luminaire
from ..units import LUMENS_PER_WATT
from . import (
    goniogram,  # noqa: F401 (it registers its node)
    photometry,
)
from .colour_management import to_rec709
from .lamp_nodes import Part, emission
from .linking import ALL, linking
from .motion import shares_of
from .transforms import columns, without_scale
from .visibility import RAYS


def describe(group, place, images, report):
    """The descriptions of one lamp at the place of a number: one, or one a part of its pattern."""
    lamp, matrix = group.data, group.matrices[place]
    is_photometric = luminaire.is_photometric(lamp)
    parts = parts_of(lamp, matrix, images, report, has_pattern=not is_photometric and not is_portal(lamp))
    return [_described(group, place, images, report, part) for part in parts]


def _described(group, place, images, report, part):
    lamp, matrix = group.data, group.matrices[place]
    strength = part.colour * lamp.energy * 2.0 ** getattr(lamp, "exposure", 0.0)
    shape, radiance, extra = SHAPES[lamp.type](lamp, np.asarray(matrix, dtype=float))
    keeps_size = lamp.type == "AREA"
    texture = None
    if part.pixels is not None:
        texture = images.changing(("lamp", group.name, place), f"pattern of {group.name}", part.pixels)
    description = {
        "origin": {"name": group.name, "file": ""},
        "shape": shape,
        "emission": {
            "radiance": [float(radiance * s * LUMENS_PER_WATT) for s in strength],
            "normalized": False,
            "metres_per_unit": 1.0,
        },
        "shaping": {"cone_angle_deg": None, "cone_softness": 0.0, "focus": 0.0, "focus_tint": [0.0, 0.0, 0.0]},
        "texture": texture,
        "transform": columns(matrix if keeps_size else without_scale(matrix)),
        "visibility": {ray: group.visibility[ray] for ray in RAYS},
        "casts_shadow": bool(lamp.use_shadow),
        "spot": None,
        "spread_deg": 180.0,
        "portal": False,
        "goniogram": part.goniogram,
        "falloff": part.falloff or {"power": 0, "smooth": 0.0},
        "group": group.source.lightgroup,
        **extra,
    }
    # A portal gives no light of its own.
    if luminaire.is_photometric(lamp) and not description["portal"]:
        photometry.apply(description, lamp, part.colour, matrix, report)
    return description


def parts_of(lamp, matrix, images, report, has_pattern=False):
    """The lamp's light: its colour times that of its temperature and of its nodes, and over what that spreads."""
    colour = np.array(lamp.color, dtype=float)
    if getattr(lamp, "use_temperature", False):
        colour = colour * np.array(lamp.temperature_color, dtype=float)
    colour = np.array(to_rec709(colour))
    if not lamp.use_nodes or lamp.node_tree is None:
        return [Part(colour)]
    parts = emission(lamp, matrix, images, report, has_pattern)
    return [replace(part, colour=colour * part.colour) for part in parts]


def _is_normalized(lamp):
    return getattr(lamp, "normalize", True)


def _point(lamp, matrix):
    radius = lamp.shadow_soft_size
    if radius <= 0.0:
        return "Point", 1.0 / (4.0 * pi), {}
    area = 4.0 * pi * radius * radius if _is_normalized(lamp) else 1.0
    # With soft falloff Cycles takes a disk that faces what it lights, as bright as the sphere.
    kind = "FacingDisk" if getattr(lamp, "use_soft_falloff", False) else "Sphere"
    return {kind: {"radius": float(radius)}}, 1.0 / (pi * area), {}


def _spot(lamp, matrix):
    # The cone cuts the light and does not gather it.
    shape, radiance, _ = _point(lamp, matrix)
    lengths = np.linalg.norm(matrix[:3, :3], axis=0)
    stretch = [float(lengths[axis] / lengths[2]) if lengths[2] > 0.0 and lengths[axis] > 0.0 else 1.0 for axis in (0, 1)]
    return shape, radiance, {"spot": {"angle_deg": degrees(lamp.spot_size), "blend": float(lamp.spot_blend), "stretch": stretch}}


def _sun(lamp, matrix):
    half = 0.5 * lamp.angle
    if half <= 0.0:
        return {"Distant": {"angle_deg": 0.0}}, 1.0, {}
    solid_angle = pi * sin(min(half, 0.5 * pi)) ** 2 if _is_normalized(lamp) else 1.0
    return {"Distant": {"angle_deg": degrees(lamp.angle)}}, 1.0 / solid_angle, {}


def _area(lamp, matrix):
    width = float(lamp.size)
    height = float(lamp.size_y) if lamp.shape in ("RECTANGLE", "ELLIPSE") else width
    is_round = lamp.shape in ("DISK", "ELLIPSE")
    scale = [hypot(*matrix[:3, axis]) for axis in (0, 1)]
    area = width * scale[0] * height * scale[1] * (0.25 * pi if is_round else 1.0)
    kind = "Ellipse" if is_round else "Rectangle"
    extra = {"spread_deg": degrees(lamp.spread), "portal": is_portal(lamp)}
    return {kind: {"width": width, "height": height}}, 1.0 / (pi * (area if _is_normalized(lamp) and area > 0.0 else 1.0)), extra


SHAPES = {"POINT": _point, "SPOT": _spot, "SUN": _sun, "AREA": _area}


def is_portal(lamp):
    """Whether an area light only says where light comes in."""
    return any(getattr(getattr(lamp, engine, None), "is_portal", False) for engine in ("gonio", "cycles"))


class Lights:
    """The scene's lights: lamps first, then the world's domes."""

    def __init__(self, scene, images, report):
        self._scene, self._images, self._report = scene, images, report
        self._written, self._lamps, self._domes = [], [], []
        # By the number of a lamp: the key of its group, its times, its place in the group, and whether its size is in its matrix.
        self._sources = []
        self.any_written = False

    def lamps(self, groups, sets):
        """Describes the lamps anew, of groups with their keys; `sets` are the instance sets as links know them."""
        self._report.forget_all("Light")
        self._lamps, self._sources = [], []
        for group, key in groups:
            with self._report.guard("Object", group.name, "the lamp is left out"):
                first = len(self._lamps)
                self._described(group, key)
                links = linking(group.source.original, sets)
                if links is not ALL:
                    self._lamps[first:] = [description | {"linking": links} for description in self._lamps[first:]]

    def _described(self, group, key):
        """Adds the descriptions of a lamp's placements."""
        shares = shares_of(group.source)
        for place, matrix in enumerate(group.matrices):
            if np.isfinite(matrix).all():
                found = describe(group, place, self._images, self._report)
                self._lamps += found
                self._sources += [(key, shares, place, group.data.type == "AREA")] * len(found)
            else:
                self._report.add("Object", group.name, "the lamp's place is not a number; it is left out")

    def shares(self):
        """All times of the shutter at which lamps want to know where they are."""
        return {share for _, shares, _, _ in self._sources for share in shares}

    def blur(self, places):
        """Gives the lamps that move their places at the times of the shutter, and writes them."""
        for number, (key, shares, place, keeps_size) in enumerate(self._sources):
            found = [places[share].groups.get(key) for share in shares]
            if not found or any(matrices is None or len(matrices) <= place for matrices in found):
                continue
            keys = [matrices[place] for matrices in found]
            if all((one == keys[0]).all() for one in keys):
                continue
            motion = [columns(one if keeps_size else without_scale(one)) for one in keys]
            self._lamps[number] = {**self._lamps[number], "motion": motion}
        self.write()

    def domes(self, descriptions):
        """Takes the world's descriptions."""
        self._domes = descriptions

    def write(self):
        """Writes what differs."""
        before, self._written = self._written, []
        self.any_written = False
        for description in (*self._lamps, *self._domes):
            with self._report.guard("Light", description["origin"]["name"], "the light is left out"):
                number = len(self._written)
                known = number < len(before)
                if not known or before[number] != description:
                    self._scene.put_light(description, index=number if known else None)
                    self.any_written = True
                self._written.append(description)
        if len(self._written) < len(before):
            self._scene.truncate("lights", len(self._written))
            self.any_written = True

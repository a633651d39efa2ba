"""The free camera: turns about a point, moves, goes nearer, and shows a whole box. Knows nothing of windows."""

from __future__ import annotations

import itertools
import math
import sys
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

from .vectors import Vector, add, cross, dot, turned, unit, vector

Description = dict[str, Any]
Box = tuple[Vector, Vector]

AXES: dict[str, Vector] = {"Y": (0.0, 1.0, 0.0), "Z": (0.0, 0.0, 1.0)}
# How near the view may come to the vertical, radians.
LEAST_SLANT = math.radians(1.0)
# Room around a box that is shown as a whole.
MARGIN = 1.1
# Half the height of the view at a distance of 1, for cameras without a perspective lens (35°).
DEFAULT_SLOPE = math.tan(math.radians(17.5))
# Metres, where nothing tells how far away things are.
DEFAULT_DISTANCE = 1.0


@dataclass(frozen=True)
class FreeCamera:
    """A camera that looks at a point; metres, in the stage's axes."""

    eye: Vector
    right: Vector
    up: Vector
    back: Vector
    # To the point that it turns about.
    distance: float
    # The stage's vertical.
    vertical: Vector
    # Half the width and height of the view: at a distance of 1, or in metres where rays are parallel.
    slopes: tuple[float, float]
    is_parallel: bool = False
    # Factor on the picture.
    exposure: float = 1.0

    @classmethod
    def of(cls, description: Mapping[str, Any], up: str, distance: float) -> FreeCamera:
        """The view of a camera of the stage, without its lens' blur and clipping."""
        right, upward, back, eye = (vector(column) for column in description["transform"]["columns"])
        slopes, is_parallel = _slopes(description)
        exposure = float(description.get("exposure", 1.0))
        return cls(eye, unit(right), unit(upward), unit(back), distance, AXES[up], slopes, is_parallel, exposure)

    @property
    def pivot(self) -> Vector:
        """The point that it turns about."""
        return add(self.eye, self.back, -self.distance)

    def orbited(self, across: float, upward: float) -> FreeCamera:
        """Turned about the pivot: around the vertical, and over it as far as the vertical itself; radians."""
        slant = math.acos(max(-1.0, min(1.0, dot(self.back, self.vertical))))
        # A camera that already looks along the vertical may leave it.
        least, most = min(LEAST_SLANT, slant), max(math.pi - LEAST_SLANT, slant)
        upward = slant - max(least, min(most, slant - upward))
        # Over the vertical even where the picture is tilted.
        level = cross(self.vertical, self.back)
        level = unit(level) if dot(level, level) > 1e-12 else self.right
        axes = [turned(axis, level, -upward) for axis in (self.right, self.up, self.back)]
        right, up, back = (unit(turned(axis, self.vertical, across)) for axis in axes)
        return replace(self, eye=add(self.pivot, back, self.distance), right=right, up=up, back=back)

    def moved(self, across: float, upward: float) -> FreeCamera:
        """Moved sideways by shares of the view's height at the pivot."""
        height = 2.0 * self.slopes[1] * (1.0 if self.is_parallel else self.distance)
        return replace(self, eye=add(add(self.eye, self.right, across * height), self.up, upward * height))

    def nearer(self, factor: float) -> FreeCamera:
        """With the pivot's distance multiplied by a factor; parallel views show that much of the scene."""
        if self.is_parallel:
            return replace(self, slopes=(self.slopes[0] * factor, self.slopes[1] * factor))
        distance = max(self.distance * factor, 1e-6)
        return replace(self, eye=add(self.pivot, self.back, distance), distance=distance)

    def framing(self, box: Box | None, aspect: float) -> FreeCamera:
        """Seen from the same side, and as near as shows the whole box; `aspect` is the picture's width over its height."""
        if box is None:
            return self
        centre = vector([0.5 * (low + high) for low, high in zip(*box, strict=True)])
        corners = [add(vector(corner), centre, -1.0) for corner in itertools.product(*zip(*box, strict=True))]
        sides = [(abs(dot(corner, self.right)), abs(dot(corner, self.up)), dot(corner, self.back)) for corner in corners]
        width, height = shaped(self.slopes, aspect)
        if self.is_parallel:
            size = MARGIN * max(max(x / width, y / height) for x, y, _ in sides) or 1.0
            depth = max(z for *_, z in sides) * 2.0 + DEFAULT_DISTANCE
            return replace(self, eye=add(centre, self.back, depth), distance=depth, slopes=(width * size, height * size))
        distance = max(z + MARGIN * max(x / width, y / height) for x, y, z in sides) or DEFAULT_DISTANCE
        return replace(self, eye=add(centre, self.back, distance), distance=distance)

    def description(self, aspect: float) -> Description:
        """As `Scene.put_camera` takes it, for a picture of that shape."""
        width, height = shaped(self.slopes, aspect)
        projection: Any = "Orthographic" if self.is_parallel else {"Perspective": {"focal_length": 1.0}}
        return {
            "origin": {"name": "free camera", "file": ""},
            "projection": projection,
            "aperture": [2.0 * width, 2.0 * height],
            "aperture_offset": [0.0, 0.0],
            "lens_radius": 0.0,
            "focus_distance": self.distance,
            "blades": 0,
            "blade_rotation_deg": 0.0,
            "lens_ratio": 1.0,
            "clipping_planes": [],
            "clipping": [0.0, sys.float_info.max],
            "transform": {"columns": [list(self.right), list(self.up), list(self.back), list(self.eye)]},
            "motion": [],
            "exposure": self.exposure,
        }


def _slopes(description: Mapping[str, Any]) -> tuple[tuple[float, float], bool]:
    """Half the view's width and height, and whether rays are parallel."""
    width, height = description["aperture"]
    projection = description["projection"]
    if projection == "Orthographic":
        return (0.5 * width, 0.5 * height), True
    lens = projection.get("Perspective") if isinstance(projection, dict) else None
    if lens is None or not (width > 0.0 and height > 0.0):
        return (DEFAULT_SLOPE, DEFAULT_SLOPE), False
    focal_length = lens["focal_length"]
    return (0.5 * width / focal_length, 0.5 * height / focal_length), False


def shaped(sides: Sequence[float], aspect: float) -> tuple[float, float]:
    """Two lengths, the one that is too short for the shape made longer (UsdRender's expandAperture)."""
    width, height = sides
    return (height * aspect, height) if width < height * aspect else (width, width / aspect)


def through(description: Mapping[str, Any], aspect: float) -> Description:
    """A camera of the stage for a picture of that shape, which shows more to the sides or above and below."""
    projection = description["projection"]
    is_flat = projection == "Orthographic" or (isinstance(projection, dict) and "Perspective" in projection)
    aperture = shaped(description["aperture"], aspect) if is_flat and min(description["aperture"]) > 0.0 else description["aperture"]
    return {**description, "aperture": list(aperture)}


def distance_to(description: Mapping[str, Any], box: Box | None) -> float:
    """How far the middle of a box lies before a camera, metres."""
    if box is None:
        return DEFAULT_DISTANCE
    *_, back, eye = (vector(column) for column in description["transform"]["columns"])
    centre = vector([0.5 * (low + high) for low, high in zip(*box, strict=True)])
    ahead = -dot(add(centre, eye, -1.0), unit(back))
    size = math.dist(*box)
    return ahead if ahead > 0.01 * size else max(0.5 * size, 1e-3)


def box_of(bounds: Sequence[Sequence[float]] | None) -> Box | None:
    """Two corners, or None where nothing is or something has no end."""
    if bounds is None or not all(isinstance(x, (int, float)) and math.isfinite(x) for corner in bounds for x in corner):
        return None
    return vector(bounds[0]), vector(bounds[1])

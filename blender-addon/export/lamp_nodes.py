# SPDX-License-Identifier: GPL-3.0-or-later
"""A lamp's nodes: what they multiply its strength by, over directions or over its surface, or by the mean over all that leaves the lamp."""

from dataclasses import dataclass, replace
from math import acos, cos, degrees, pi, tan

import numpy as np

from ..units import LUMENS_PER_WATT
from .evaluate import Pictures, evaluate
from .material.flatten import flatten
from .material.inputs import GENERATED, POSITION, UV
from .material.sockets import active_output, input_socket
from .material.translator import Translator

# Directions over a lamp's light, or points each way of its surface.
DIRECTIONS, SIDE = 8192, 96
# The same of a pattern: planes through the axis and angles from it, texels a side.
PLANES, ANGLES, PATTERN_SIDE = 721, 361, 256
# Graphs keep the values of all their nodes for so many directions or points.
AT_ONCE = 1 << 14
# Channels that differ by less, as parts of their largest values, have one pattern.
SAME_PATTERN = 1e-3


@dataclass
class Part:
    """Red, green and blue that multiply a lamp's strength, and over what they spread: a goniogram's directions, or a picture on its surface."""

    colour: np.ndarray
    goniogram: dict | None = None
    pixels: np.ndarray | None = None
    falloff: dict | None = None


# What light is multiplied by, as a power of the distance, by the outputs of Light Falloff.
POWERS = {"Quadratic": 0, "Linear": 1, "Constant": 2}


def emission(lamp, matrix, images, report, has_pattern=True):
    """The parts of a lamp's light by its nodes; without `has_pattern` what varies is taken by its mean."""
    t = Translator(lamp, lamp.node_tree, Pictures(images, report), report, kind="Light")
    parts = _parts(t, lamp, matrix, has_pattern)
    if t.falloff is None:
        return parts
    output, smooth = t.falloff
    falloff = {"power": POWERS[output], "smooth": max(smooth, 0.0)}
    return [replace(part, falloff=falloff) for part in parts]


def _parts(t, lamp, matrix, has_pattern):
    end = active_output(lamp.node_tree, "Light")
    if end is None:
        return [Part(np.zeros(3))]
    flatten(t, input_socket(end, "Surface"), t.root, t.graph.scalar(1.0))
    emitting = [closure for closure in t.closures if closure["model"] == "Emission"]
    products = [(dict(closure["parameters"])["emission_color"], closure["weight"]) for closure in emitting]
    varies = any("Node" in factor for factors in products for factor in factors)
    if varies and has_pattern and t.goniogram is None and _has_pattern(lamp):
        return _pattern(t, lamp, matrix, products)
    if varies:
        t.tell("textured lamp", end, t.root)
    light = Light(lamp, matrix, *SAMPLES[lamp.type](lamp))
    return [Part(light.mean(t, products) / LUMENS_PER_WATT, t.goniogram)]


def _has_pattern(lamp):
    """Whether the lamp's light can have a pattern: over directions from points and spots, over the surface of a rectangle."""
    return lamp.type in ("POINT", "SPOT") or (lamp.type == "AREA" and lamp.shape in ("SQUARE", "RECTANGLE"))


def _pattern(t, lamp, matrix, products):
    if lamp.type == "AREA":
        light = Light(lamp, matrix, *_area(lamp, PATTERN_SIDE))
        values = light.values(t, products) / LUMENS_PER_WATT
        # Lamps shine along -z, so that who looks at one sees x to the left.
        rows = values.reshape(PATTERN_SIDE, PATTERN_SIDE, 3)[::-1, ::-1]
        pixels = np.ones((PATTERN_SIDE, PATTERN_SIDE, 4), dtype=np.float32)
        pixels[..., :3] = rows
        return [Part(np.ones(3), pixels=pixels)]
    planes, angles = _directions(lamp)
    light = Light(lamp, matrix, *SAMPLES[lamp.type](lamp, _towards(planes, angles)))
    values = light.values(t, products) / LUMENS_PER_WATT
    # A goniogram is not negative: what takes light away is a part of its own.
    signed = ((sign, _goniograms(planes, angles, np.maximum(sign * values, 0.0))) for sign in (1.0, -1.0))
    return [replace(part, colour=sign * part.colour) for sign, parts in signed for part in parts]


def _goniograms(planes, angles, values):
    """The parts that shine with these values by direction, red, green and blue, none of them negative."""
    most = values.max(axis=0)
    if not most.any():
        return []
    scaled = values / np.where(most > 0.0, most, 1.0)
    # A goniogram has no colours: those that spread alike are one part, others shine in red, green and blue apart.
    if np.abs(scaled - scaled[:, [int(most.argmax())]])[:, most > 0.0].max(initial=0.0) < SAME_PATTERN:
        return [Part(most, _goniogram(planes, angles, scaled[:, int(most.argmax())]))]
    return [Part(np.eye(3)[c] * most[c], _goniogram(planes, angles, scaled[:, c])) for c in range(3) if most[c] > 0.0]


def _directions(lamp):
    """Planes and angles from -z of a pattern, degrees: the whole sphere, or a spot's cone."""
    widest = min(degrees(0.5 * lamp.spot_size), 180.0) if lamp.type == "SPOT" else 180.0
    return np.linspace(0.0, 360.0, PLANES), np.linspace(0.0, widest, ANGLES)


def _towards(planes, angles):
    plane, angle = np.meshgrid(np.radians(planes), np.radians(angles), indexing="ij")
    across = np.sin(angle)
    return _vectors(np.stack([across * np.cos(plane), across * np.sin(plane), -np.cos(angle)], axis=-1).reshape(-1, 3))


def _goniogram(planes, angles, factors):
    return {
        "photometric_type": "C",
        "horizontal_deg": planes.tolist(),
        "vertical_deg": angles.tolist(),
        "factors": factors.tolist(),
    }


class Light:
    """Directions or points of a lamp's light in its own space, (N, 4) each, with their weights."""

    def __init__(self, lamp, matrix, normal, point, uv, weights):
        matrix = np.asarray(matrix, dtype=float)
        self._matrix, self._turn = matrix, matrix[:3, :3] / np.linalg.norm(matrix[:3, :3], axis=0)
        self._normal, self._point, self._uv, self._weights = normal, point, uv, weights

    def values(self, t, products):
        """The sum of products of sources of a graph: red, green and blue of each direction or point."""
        total = np.zeros((len(self._normal), 3))
        factors = [factor for product in products for factor in product]
        for first in range(0, len(total), AT_ONCE):
            piece = slice(first, first + AT_ONCE)
            found = iter(evaluate(t.graph, factors, self._normal[piece].shape, self._leaf(t, piece)))
            for product in products:
                total[piece] += np.prod([next(found) for _ in product], axis=0)[:, :3]
        return np.nan_to_num(total, posinf=0.0, neginf=0.0)

    def mean(self, t, products):
        """The mean of that."""
        total = np.zeros(3)
        for factors in products:
            if all("Constant" in factor for factor in factors):
                total += np.prod([factor["Constant"][:3] for factor in factors], axis=0)
            else:
                total += np.average(self.values(t, [factors]), axis=0, weights=self._weights)
        return total

    def _leaf(self, t, piece):
        normal, point, uv = self._normal[piece], self._point[piece], self._uv[piece]
        world = _vectors(normal[:, :3] @ self._turn.T)
        place = _vectors(point[:, :3] @ self._matrix[:3, :3].T + self._matrix[:3, 3])
        plain = {"Normal": world, "GeometricNormal": world, "Incoming": world, "Position": place, "FrontFacing": np.ones_like(world)}
        # Lamps have no box of their own: generated coordinates are the object's.
        primvars = {UV: uv, POSITION: point, GENERATED: point}

        def leaf(operation, inputs):
            if isinstance(operation, str):
                return plain.get(operation)
            ((name, fields),) = operation.items()
            if name == "Primvar":
                return primvars.get(fields["name"], np.broadcast_to(fields["fallback"], world.shape))
            if name == "Image":
                return t.images.look_up(fields, inputs[0])
            return self._moved(fields, inputs[0]) if name == "Transform" else None

        return leaf

    def _moved(self, fields, value):
        """A point or a direction between the world and the lamp's own space."""
        if fields["from"] == fields["to"]:
            return value
        to_world = fields["to"] == "World"
        if fields["quantity"] == "Point":
            matrix = self._matrix if to_world else np.linalg.inv(self._matrix)
            return _vectors(value[:, :3] @ matrix[:3, :3].T + matrix[:3, 3])
        return _vectors(value[:, :3] @ (self._turn.T if to_world else self._turn))


def _vectors(values):
    """Three components as four."""
    return np.concatenate([values, np.zeros_like(values[:, :1])], axis=1)


def _spiral(highest):
    """Directions that are even over a cone about -Z whose half angle has a cosine of `highest`."""
    place = np.arange(DIRECTIONS) + 0.5
    down = 1.0 - (1.0 - highest) * place / DIRECTIONS
    across, turn = np.sqrt(1.0 - down * down), pi * (1.0 + 5.0**0.5) * place
    return _vectors(np.stack([across * np.cos(turn), across * np.sin(turn), -down], axis=1))


def _point(lamp, normal=None):
    normal = _spiral(-1.0) if normal is None else normal
    u = 0.5 - np.arctan2(normal[:, 0], normal[:, 1]) / (2.0 * pi)
    v = 1.0 - np.arccos(np.clip(normal[:, 2], -1.0, 1.0)) / pi
    uv = np.stack([u, v, 0.0 * u, 0.0 * u], axis=1)
    return normal, normal * lamp.shadow_soft_size, uv, np.ones(len(normal))


def _spot(lamp, normal=None):
    lowest = cos(0.5 * lamp.spot_size)
    normal = _spiral(lowest) if normal is None else normal
    # The picture fills the cone.
    size = 0.5 / max(tan(min(acos(lowest), 1.55)), 1e-3)
    away = np.maximum(-normal[:, 2], 1e-6)
    u, v = (0.5 + normal[:, axis] / away * size for axis in (0, 1))
    uv = np.stack([u, v, 0.0 * u, 0.0 * u], axis=1)
    share = np.clip((-normal[:, 2] - lowest) / max((1.0 - lowest) * lamp.spot_blend, 1e-6), 0.0, 1.0)
    return normal, normal * lamp.shadow_soft_size, uv, share * share * (3.0 - 2.0 * share) + 1e-9


def _area(lamp, side=SIDE):
    place = (np.arange(side) + 0.5) / side
    u, v = (each.ravel() for each in np.meshgrid(place, place))
    zero = np.zeros_like(u)
    height = lamp.size_y if lamp.shape in ("RECTANGLE", "ELLIPSE") else lamp.size
    point = np.stack([(u - 0.5) * lamp.size, (v - 0.5) * height, zero, zero], axis=1)
    normal = np.stack([zero, zero, zero - 1.0, zero], axis=1)
    is_round = lamp.shape in ("DISK", "ELLIPSE")
    inside = (u - 0.5) ** 2 + (v - 0.5) ** 2 <= 0.25 if is_round else np.ones_like(u, dtype=bool)
    return normal, point, np.stack([u, v, zero, zero], axis=1), inside.astype(float)


def _sun(lamp):
    normal = np.array([[0.0, 0.0, -1.0, 0.0]])
    return normal, np.zeros((1, 4)), np.array([[0.5, 0.5, 0.0, 0.0]]), np.ones(1)


SAMPLES = {"POINT": _point, "SPOT": _spot, "AREA": _area, "SUN": _sun}

# SPDX-License-Identifier: GPL-3.0-or-later
"""A lamp's nodes: what they multiply its strength by. What varies over the light is taken by its mean over all that leaves the lamp."""

from math import acos, cos, pi, tan

import numpy as np

from ..units import LUMENS_PER_WATT
from .evaluate import Pictures, evaluate
from .material.flatten import flatten
from .material.inputs import GENERATED, POSITION, UV
from .material.sockets import active_output, input_socket
from .material.translator import Translator

# Directions over a lamp's light, or points each way of its surface.
DIRECTIONS, SIDE = 8192, 96


def emission(lamp, matrix, images, report):
    """Red, green and blue that a lamp's nodes multiply its strength by, and the goniogram of its IES texture."""
    t = Translator(lamp, lamp.node_tree, Pictures(images, report), report, kind="Light")
    end = active_output(lamp.node_tree, "Light")
    if end is None:
        return np.zeros(3), None
    flatten(t, input_socket(end, "Surface"), t.root, t.graph.scalar(1.0))
    total, varies = np.zeros(3), False
    light = Light(lamp, np.asarray(matrix, dtype=float))
    for closure in t.closures:
        if closure["model"] == "Emission":
            factors = dict(closure["parameters"])["emission_color"], closure["weight"]
            varies |= any("Node" in factor for factor in factors)
            total += light.mean(t, factors) / LUMENS_PER_WATT
    if varies:
        t.tell("textured lamp", end, t.root)
    return total, t.goniogram


class Light:
    """Directions or points of a lamp's light in its own space, (N, 4) each, with their weights."""

    def __init__(self, lamp, matrix):
        self._matrix, self._turn = matrix, matrix[:3, :3] / np.linalg.norm(matrix[:3, :3], axis=0)
        self._normal, self._point, self._uv, self._weights = SAMPLES[lamp.type](lamp)

    def mean(self, t, factors):
        """The mean of a product of sources of a graph: red, green and blue."""
        if all("Constant" in factor for factor in factors):
            return np.prod([factor["Constant"][:3] for factor in factors], axis=0)
        shape = self._normal.shape
        product = np.prod([evaluate(t.graph, factor, shape, self._leaf(t)) for factor in factors], axis=0)
        return np.nan_to_num(np.average(product[:, :3], axis=0, weights=self._weights), posinf=0.0)

    def _leaf(self, t):
        world = _vectors(self._normal[:, :3] @ self._turn.T)
        place = _vectors(self._point[:, :3] @ self._matrix[:3, :3].T + self._matrix[:3, 3])
        plain = {"Normal": world, "GeometricNormal": world, "Incoming": world, "Position": place, "FrontFacing": np.ones_like(world)}
        primvars = {UV: self._uv, POSITION: self._point, GENERATED: self._normal}

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


def _point(lamp):
    normal = _spiral(-1.0)
    u = 0.5 - np.arctan2(normal[:, 0], normal[:, 1]) / (2.0 * pi)
    v = 1.0 - np.arccos(np.clip(normal[:, 2], -1.0, 1.0)) / pi
    uv = np.stack([u, v, 0.0 * u, 0.0 * u], axis=1)
    return normal, normal * lamp.shadow_soft_size, uv, np.ones(len(normal))


def _spot(lamp):
    lowest = cos(0.5 * lamp.spot_size)
    normal = _spiral(lowest)
    # The picture fills the cone.
    size = 0.5 / max(tan(min(acos(lowest), 1.55)), 1e-3)
    away = np.maximum(-normal[:, 2], 1e-6)
    u, v = (0.5 + normal[:, axis] / away * size for axis in (0, 1))
    uv = np.stack([u, v, 0.0 * u, 0.0 * u], axis=1)
    share = np.clip((-normal[:, 2] - lowest) / max((1.0 - lowest) * lamp.spot_blend, 1e-6), 0.0, 1.0)
    return normal, normal * lamp.shadow_soft_size, uv, share * share * (3.0 - 2.0 * share) + 1e-9


def _area(lamp):
    place = (np.arange(SIDE) + 0.5) / SIDE
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

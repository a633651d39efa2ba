# SPDX-License-Identifier: GPL-3.0-or-later
"""The IES texture node, with Cycles' strength and orientation: a goniogram on a lamp's emission, a picture of one elsewhere."""

from math import pi
from pathlib import Path

import bpy
import gonio
import numpy as np

from ..units import LUMENS_PER_WATT
from .material.inputs import hit
from .material.textures import look_up
from .material.translator import value_node

# What makes a lamp of 1 W have the file's candela.
WATTS_OF_CANDELA = 4.0 * pi / LUMENS_PER_WATT


@value_node("ShaderNodeTexIES")
def _ies(translator, node, context, _output):
    """Of lamps the node's strength, and the goniogram on the translator; elsewhere the strength times the value towards its vector."""
    t = translator
    has_own = t.kind == "Light" and t.goniogram is None and not t.linked(node, "Vector", context)
    if not has_own and t.kind != "Material":
        return None
    strength = t.input(node, "Strength", context, 1.0)
    try:
        description, warnings = gonio.read_goniogram(*_file(node, t.owner))
    except (OSError, gonio.Error) as error:
        t.say(node, context, f"{error}; the light counts as uniform")
        return strength
    for warning in warnings:
        t.say(node, context, warning)
    if has_own:
        t.goniogram = _as_cycles(description)
        return strength
    if description["photometric_type"] != "C":
        return None
    return strength * _towards(t, node, context, _as_cycles(description))


def _towards(t, node, context, goniogram):
    """The goniogram's factor in a direction, from a picture of it: planes from left to right, angles from the nadir upwards."""
    towards = (t.input(node, "Vector", context) if t.linked(node, "Vector", context) else hit(t, "Incoming")).normalized()
    x, y, z = (towards.component(axis) for axis in range(3))
    pixels = _picture(goniogram)
    number = t.images.changing(("ies", t.owner.original.session_uid, t.path(node, context)), f"intensities of {node.name}", pixels)
    height, width = pixels.shape[:2]
    # Texels stand for the angles themselves, so that the outer ones lie on the edges.
    plane = y.apply("ArcTangent2", x) * (0.5 / pi) + 0.5 / width
    angle = ((-z).apply("ArcCosine") * (1.0 / pi) * (height - 1) + 0.5) * (1.0 / height)
    return look_up(t, number, t.graph.combine(plane, angle, t.graph.scalar(0.0)), ("Repeat", "Clamp")).component(0)


def _picture(goniogram):
    """Factors (angles, planes, 4) at whole degrees, the nadir in the last row; zero beyond the file's angles."""
    planes, angles = goniogram["horizontal_deg"], goniogram["vertical_deg"]
    factors = np.reshape(goniogram["factors"], (len(planes), len(angles)))
    down = np.arange(181.0)
    columns = np.stack([np.interp(down, angles, row, left=0.0, right=0.0) for row in factors])
    across = np.stack([np.interp(np.arange(360.0), planes, column) for column in columns.T])
    pixels = np.ones((181, 360, 4), dtype=np.float32)
    pixels[..., :3] = across[::-1, :, None]
    return pixels


def _file(node, owner):
    """The file's bytes and its name."""
    if node.mode == "INTERNAL":
        if node.ies is None:
            raise FileNotFoundError("no text is chosen")
        return node.ies.as_string().encode("latin-1", "replace"), node.ies.name
    path = Path(bpy.path.abspath(node.filepath, library=owner.library))
    return path.read_bytes(), str(path)


def _as_cycles(description):
    """Factors for strengths in W, and planes the way Cycles counts them: from -y, backwards."""
    if description["photometric_type"] != "C":
        return {**description, "factors": [value * WATTS_OF_CANDELA for value in description["factors"]]}
    count = len(description["vertical_deg"])
    turned = {}
    for number, angle in enumerate(description["horizontal_deg"]):
        values = description["factors"][number * count : (number + 1) * count]
        turned[(270.0 - angle) % 360.0] = [value * WATTS_OF_CANDELA for value in values]
    if 0.0 not in turned:
        turned[0.0] = _between(turned, count)
    turned[360.0] = turned[0.0]
    planes = sorted(turned)
    return {**description, "horizontal_deg": planes, "factors": [value for plane in planes for value in turned[plane]]}


def _between(planes, count):
    """The plane at 0 degrees, between the last and the first one."""
    first, last = min(planes), max(planes)
    share = (360.0 - last) / (first + 360.0 - last)
    return [(1.0 - share) * planes[last][i] + share * planes[first][i] for i in range(count)]

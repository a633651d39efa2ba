# SPDX-License-Identifier: GPL-3.0-or-later
"""The IES texture node, with Cycles' strength and orientation: a goniogram on a lamp's emission, a picture of one elsewhere."""

from math import pi
from pathlib import Path

import bpy
import gonio
import numpy as np

from ..units import LUMENS_PER_WATT
from .cubic_table import cubic_table
from .material.inputs import carried, hit
from .material.registry import value_node

# What makes a lamp of 1 W have the file's candela.
WATTS_OF_CANDELA = 4.0 * pi / LUMENS_PER_WATT
DEGREES = 180.0 / pi


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
    return strength * _towards(t, node, context, description)


def _towards(t, node, context, goniogram):
    """The goniogram's factor in a direction as a picture shows it: planes count from -y, backwards."""
    has_vector = t.linked(node, "Vector", context)
    towards = t.input(node, "Vector", context) if has_vector else carried(t, hit(t, "Incoming"), "World", "Object", "Normal")
    towards = towards.normalized()
    x, y, z = (towards.component(axis) for axis in range(3))
    plane = x.apply("ArcTangent2", y) * DEGREES + 180.0
    angle = (-z).apply("ArcCosine") * DEGREES
    key = ("ies", t.owner.original.session_uid, t.path(node, context))
    return cubic_table(t, key, f"intensities of {node.name}", _table(goniogram), (plane, angle))


def _table(goniogram):
    """Planes and angles in degrees, and the factors by planes, over the whole turn."""
    planes, angles = (np.array(goniogram[f"{name}_deg"], dtype=float) for name in ("horizontal", "vertical"))
    factors = np.reshape(goniogram["factors"], (len(planes), len(angles))) * WATTS_OF_CANDELA
    if len(planes) == 1:
        return np.array([0.0, 360.0]), angles, np.concatenate([factors, factors])
    if planes[-1] < 360.0:
        planes, factors = np.append(planes, 360.0), np.concatenate([factors, factors[:1]])
    return planes, angles, factors


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

# SPDX-License-Identifier: GPL-3.0-or-later
"""The IES texture node of lamps: a goniogram on the lamp's emission, with Cycles' strength and orientation."""

from math import pi
from pathlib import Path

import bpy
import gonio

from ..units import LUMENS_PER_WATT
from .material.translator import value_node

# What makes a lamp of 1 W have the file's candela.
WATTS_OF_CANDELA = 4.0 * pi / LUMENS_PER_WATT


@value_node("ShaderNodeTexIES")
def _ies(translator, node, context, _output):
    """The node's strength, and the goniogram on the translator; none where the node is not understood."""
    if translator.kind != "Light" or translator.goniogram is not None or translator.linked(node, "Vector", context):
        return None
    try:
        description, warnings = gonio.read_goniogram(*_file(node, translator.owner))
    except (OSError, gonio.Error) as error:
        translator.say(node, context, f"{error}; the light counts as uniform")
        return translator.input(node, "Strength", context, 1.0)
    for warning in warnings:
        translator.say(node, context, warning)
    translator.goniogram = _as_cycles(description)
    return translator.input(node, "Strength", context, 1.0)


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

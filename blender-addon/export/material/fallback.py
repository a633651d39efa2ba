# SPDX-License-Identifier: GPL-3.0-or-later
"""What stands in for nodes that cannot be computed: a value of its own, their main input, or the value of a socket."""

from ...unsupported import LIMITS, STAND_INS
from .inputs import normal_of
from .sockets import KINDS, input_socket
from .textures import MISSING

# Mean radiance of the upper half of Blender's default skies without the sun, by cosine, W/(m² sr); measured with Cycles.
SKIES = {
    "SINGLE_SCATTERING": (1.69, 2.14, 2.81),
    "NISHITA": (1.74, 2.17, 2.82),
    "MULTIPLE_SCATTERING": (1.74, 2.86, 4.83),
    "PREETHAM": (0.37, 0.57, 1.06),
    "HOSEK_WILKIE": (0.050, 0.086, 0.146),
}


def stand_in(translator, node, output, context):
    """The value that stands in for an output, and the report's words."""
    kind, graph, label = KINDS.get(output.type, "VALUE"), translator.graph, node.bl_label or node.bl_idname
    found = STAND_INS.get((node.bl_idname, output.identifier)) or STAND_INS.get(node.bl_idname)
    if found is not None:
        name, value = found
        return graph.value(value), f"{name}: not supported; the value {value:g} is used"
    if node.bl_idname == "ShaderNodeTexSky":
        return graph.colour(SKIES.get(node.sky_type, SKIES["PREETHAM"])), LIMITS["sky elsewhere"].line(label)
    if node.bl_idname == "ShaderNodeTexIES":
        return translator.input(node, "Strength", context, 1.0), LIMITS["ies elsewhere"].line(label)
    if node.bl_idname in ("ShaderNodeTexImage", "ShaderNodeTexEnvironment"):
        return graph.colour(MISSING), f"{label}: not supported; the colour of missing images is used"
    through = main_input(node, output)
    if through is None:
        return translator.default_of(output, kind), f"{label}: not supported; its socket's value is used"
    is_normal = kind == "VECTOR" and through.name == "Normal"
    value = normal_of(translator, node, context) if is_normal else translator.socket(through, context)
    return value, f"{label}: not supported; its input {through.name} is passed on"


def main_input(node, output):
    """The input that a node most likely changes: the one of the output's name, else the first of its type; None if there is none."""
    named = input_socket(node, output.name)
    if named is not None and named.type == output.type and named.enabled:
        return named
    return next((s for s in node.inputs if s.type == output.type and s.enabled and not s.hide_value), None)

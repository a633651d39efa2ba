# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader trees flattened into weighted closures: Mix and Add, groups, and what stands in for other shaders."""

from ...units import LUMENS_PER_WATT
from .closures import closure
from .sockets import ABSENT, KINDS, THROUGH, follow, group_output
from .registry import CLOSURES

# More closures than this in one material are left out: the surface would not be shaded in reasonable time.
MOST_CLOSURES = 64
# More ways than this through Mix and Add Shaders are not followed: there are two for each such node, and twice as many for the next.
MOST_WAYS = 4096
# How nodes that are no surface begin.
VOLUMES = "ShaderNodeVolume"
GREY = (0.8, 0.8, 0.8)


def flatten(t, socket, context, weight):
    """Appends the closures that reach a shader input, their weights multiplied by `weight`."""
    if weight.is_zero():
        return
    found = follow(socket, context)
    if found is None:
        return
    node, output, context, _ = found
    if node is not None and node.bl_idname in ABSENT:
        t.tell("absent", node, context, node.bl_label)
        return
    if node is not None:
        t.saw(node, context)
    t.ways += 1
    if t.ways > MOST_WAYS:
        if node is not None and not t.ways_told:
            t.ways_told = True
            t.tell("many closures", node, context, f"More than {MOST_WAYS} ways through mixed shaders")
        return
    is_shader = output.type == "SHADER"
    if is_shader and (node is None or node.bl_idname in THROUGH):
        return
    if len(t.closures) >= MOST_CLOSURES:
        if node is not None:
            t.tell("many closures", node, context)
        return
    if not is_shader:
        # A colour or a value in the place of a shader shines.
        value = t.output(node, output, context) if node is not None else t.default_of(output, KINDS.get(output.type, "RGBA"))
        colour = value.as_kind("RGBA") * LUMENS_PER_WATT
        t.closures.append({"weight": weight.input(), **closure(t.graph, "Emission", emission_color=colour)})
        return
    if node.bl_idname == "ShaderNodeMixShader":
        share = t.input(node, "Fac", context, 0.5).clamp()
        flatten(t, node.inputs[1], context, weight * (1.0 - share))
        flatten(t, node.inputs[2], context, weight * share)
    elif node.bl_idname == "ShaderNodeAddShader":
        flatten(t, node.inputs[0], context, weight)
        flatten(t, node.inputs[1], context, weight)
    else:
        _append(t, node, output, context, weight)


def _append(t, node, output, context, weight):
    closures = _closures(t, node, context)
    if closures is None:
        inner = group_output(node, output, context)
        if inner is not None:
            flatten(t, *inner, weight)
        return
    for made in closures:
        share = made.pop("share", None)
        part = weight if share is None else weight * share
        if not part.is_zero():
            t.closures.append({"weight": part.input(), **made})


def _closures(t, node, context):
    """The closures of a shader node; None for what stands inside a group."""
    handler, label = CLOSURES.get(node.bl_idname), node.bl_label or node.bl_idname
    if node.bl_idname.startswith(VOLUMES):
        t.tell("volume as surface", node, context, f"{label} in a Surface socket")
        return []
    if handler is None:
        t.tell("closure", node, context, label)
        handler = _stand_in
    try:
        return handler(t, node, context)
    except RecursionError:
        raise
    except Exception as problem:
        t.fail(node, context, problem, "a diffuse grey is used")
        return [closure(t.graph, "Diffuse", base_color=t.graph.colour(GREY))]


def _stand_in(t, node, context):
    """A diffuse surface of the node's colour."""
    colour = next((socket for socket in node.inputs if socket.type == "RGBA"), None)
    return [closure(t.graph, "Diffuse", base_color=t.socket(colour, context) if colour else t.graph.colour(GREY))]

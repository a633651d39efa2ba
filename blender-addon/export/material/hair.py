# SPDX-License-Identifier: GPL-3.0-or-later
"""Shaders of hair, and what the Curves Info node knows of a strand."""

from .closures import closure
from .inputs import STRAND, carried, hit
from .registry import closure_node, value_node

# Absorption of the two pigments of hair in linear Rec.709, by one over the radius, as Cycles has it.
EUMELANIN, PHEOMELANIN = (0.506, 0.841, 1.653), (0.343, 0.733, 1.924)
# Roughness of TT and TRT along the hair over that of R, squared.
SCALES = (1.0, 0.25, 4.0)


@closure_node("ShaderNodeBsdfHairPrincipled")
def principled_hair(t, node, context):
    random = _random(t, node, context)
    varied = _factor(random, t.input(node, "Random Roughness", context))
    roughness = (t.input(node, "Roughness", context, 0.3) * varied).clamp(1e-3, 1.0)
    shared = {
        "hair_tilt": t.input(node, "Offset", context),
        "specular_ior": t.input(node, "IOR", context, 1.55),
        # On meshes, as in Cycles.
        "fibres": "FirstEdge",
    }
    if node.model == "HUANG":
        absorption = _absorption(t, node, context, random, roughness)
        return [_elliptic(t, node, context, roughness, hair_absorption=absorption, **shared)]
    around = t.input(node, "Radial Roughness", context, 0.3) * varied
    coat = t.input(node, "Coat", context).clamp()
    widths = _widths(t, roughness, around)
    reflected = _widths(t, (roughness * (1.0 - coat)).clamp(1e-3, 1.0), around)
    variances = [reflected.component(0)] + [widths.component(0) * scale for scale in SCALES[1:]]
    return [
        closure(
            t.graph,
            "Hair",
            hair_absorption=_absorption(t, node, context, random, around),
            hair_variance=t.graph.combine(*variances),
            hair_scale=t.graph.combine(*(widths.component(1),) * 3),
            **shared,
        )
    ]


def _elliptic(t, node, context, roughness, **shared):
    """Huang's model, whose roughness is the width of facets; the longer axis of the section lies along the strand's normal."""
    aspect = t.input(node, "Aspect Ratio", context, 0.85).maximum(0.01)
    # As in Cycles, where ratios above 1 do not turn the section.
    aspect = aspect.minimum(t.graph.scalar(1.0) / aspect)
    is_strand = t.primvar(STRAND["Is Strand"], kind="VALUE")
    tints = {}
    for name, socket in (("r", "Reflection"), ("tt", "Transmission"), ("trt", "Secondary Reflection")):
        tints[f"hair_tint_{name}"] = t.input(node, socket, context, 1.0).maximum(0.0)
    return closure(
        t.graph,
        "HairElliptic",
        specular_roughness=roughness.sqrt(),
        hair_aspect=aspect,
        hair_turn=t.graph.scalar(0.0) if aspect.is_constant and aspect.constant[0] == 1.0 else _turn(t),
        hair_whole=1.0 - is_strand,
        **tints,
        **shared,
    )


def _turn(t):
    """The angle about the strand from the surface's normal to the strand's own; hair of particles has none, for which Cycles has (1, 1, 1)."""
    own, along = (carried(t, t.primvar(STRAND[name]), "Object", "World", "Vector") for name in ("Normal", "Tangent"))
    own, normal = own.normalized() + t.graph.vector((1e-6, 1e-6, 1e-6)), hit(t, "Normal")
    return own.dot(along.normalized().cross(normal)).apply("ArcTangent2", own.dot(normal))


def _widths(t, along, around):
    """The variance along the hair and the width about it."""
    return t.graph.add("HairRoughness", along, around, kind="VECTOR")


def _factor(random, share):
    """A factor about 1, by a random number."""
    return 1.0 + (random - 0.5) * share.clamp() * 2.0


def _random(t, node, context):
    """The strand's random number, or what is linked in its place."""
    number = t.input(node, "Random", context)
    if t.linked(node, "Random", context) or t.kind != "Material" or not number.is_constant:
        return number
    return t.primvar(STRAND["Random"], (number.constant[0],) * 4, kind="VALUE")


def _absorption(t, node, context, random, around):
    """The absorption coefficient by one of three ways to say it."""
    if node.parametrization == "ABSORPTION":
        return t.input(node, "Absorption Coefficient", context)
    if node.parametrization == "COLOR":
        return _of_colour(t, t.input(node, "Color", context), around)
    melanin = t.input(node, "Melanin", context, 0.8) * _factor(random, t.input(node, "Random Color", context))
    redness = t.input(node, "Melanin Redness", context, 1.0)
    amount = -(1.0 - melanin).maximum(1e-4).apply("Logarithm")
    pigments = t.graph.vector(EUMELANIN) * (amount * (1.0 - redness)) + t.graph.vector(PHEOMELANIN) * (amount * redness)
    return pigments.maximum(0.0) + _of_colour(t, t.input(node, "Tint", context, 1.0), around)


def _of_colour(t, colour, around):
    return t.graph.add("HairAbsorption", colour, around, kind="VECTOR")


@closure_node("ShaderNodeBsdfHair")
def hair(t, node, context):
    # The middle of the half angle; Cycles' scales lean towards the root too.
    tilt, is_along = -t.input(node, "Offset", context), t.linked(node, "Tangent", context)
    if not is_along and not tilt.is_zero():
        # Cycles has none on meshes.
        tilt = tilt * t.primvar(STRAND["Is Strand"], kind="VALUE")
    return [
        closure(
            t.graph,
            "HairReflection" if node.component == "Reflection" else "HairTransmission",
            base_color=t.input(node, "Color", context),
            hair_widths=t.graph.combine(
                t.input(node, "RoughnessU", context, 0.1), t.input(node, "RoughnessV", context, 1.0), t.graph.scalar(0.0)
            ),
            hair_tilt=tilt,
            tangent=t.graph.node_of(t.input(node, "Tangent", context)) if is_along else None,
            fibres="SecondEdge",
        )
    ]


@value_node("ShaderNodeHairInfo")
def hair_info(t, node, context, output):
    """As in Cycles zero on whatever is no strand."""
    name = output.identifier
    if t.kind != "Material":
        return t.graph.scalar(0.0)
    if name == "Tangent Normal":
        along, back = carried(t, t.primvar(STRAND["Tangent"]), "Object", "World", "Vector"), hit(t, "Incoming")
        # Zero stays zero where there is no strand.
        return (along.cross(back).cross(along)).normalized()
    return t.primvar(STRAND[name], kind="VALUE") if name in STRAND else None

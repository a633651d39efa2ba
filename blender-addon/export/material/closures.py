# SPDX-License-Identifier: GPL-3.0-or-later
"""Shader nodes that are one closure each."""

from ...units import LUMENS_PER_WATT
from .inputs import hit
from .sockets import input_socket
from .tangent_nodes import radial_tangent
from .registry import closure_node

DISTRIBUTIONS = {"MULTI_GGX": "MultiGgx", "GGX": "Ggx", "BECKMANN": "Beckmann", "ASHIKHMIN_SHIRLEY": "AshikhminShirley"}
SUBSURFACE = {
    "BURLEY": "Burley",
    "RANDOM_WALK": "RandomWalk",
    "RANDOM_WALK_LEGACY": "RandomWalkLegacy",
    "RANDOM_WALK_SKIN": "RandomWalkSkin",
}


def closure(
    graph,
    model,
    *,
    normal=None,
    coat_normal=None,
    tangent=None,
    fibres="Coordinate",
    thin_walled=False,
    distribution="MultiGgx",
    subsurface="RandomWalk",
    measured=None,
    **parameters,
):
    """A closure of the scene description; parameters are values by the names of the core's parameter block."""
    return {
        "model": model,
        "parameters": [[name, graph.value(value).input()] for name, value in parameters.items()],
        "normal": normal,
        "coat_normal": coat_normal,
        "tangent": tangent,
        "fibres": fibres,
        "thin_walled": thin_walled,
        "distribution": distribution,
        "subsurface": subsurface,
        "measured": measured,
    }


def normal_node(t, node, context, name="Normal"):
    """The graph node that bends a shader's normal; None if nothing does."""
    socket = input_socket(node, name)
    if socket is None or not t.linked(node, name, context):
        return None if t.bent is None else t.bent.node
    number = t.graph.node_of(t.socket(socket, context))
    return None if number == t.graph.add("Normal", kind="VECTOR").node else number


def tangent_node(t, node, context, anisotropy):
    """The graph node that gives the tangent of an anisotropic shader; around the object's z axis if nothing is linked."""
    if anisotropy.is_zero() or input_socket(node, "Tangent") is None:
        return None
    value = t.input(node, "Tangent", context) if t.linked(node, "Tangent", context) else radial_tangent(t)
    return t.graph.node_of(value)


def subsurface_method(name, version):
    """The method by its name; until 5.1 the random walk is the one that later versions call legacy."""
    if name == "RANDOM_WALK" and version < (5, 2, 0):
        return "RandomWalkLegacy"
    return SUBSURFACE.get(name, "RandomWalk")


@closure_node("ShaderNodeEmission", "ShaderNodeBackground")
def emission(t, node, context):
    strength = t.input(node, "Strength", context, 1.0)
    colour = t.input(node, "Color", context) * strength
    return [closure(t.graph, "Emission", emission_color=colour * LUMENS_PER_WATT)]


@closure_node("ShaderNodeBsdfDiffuse")
def diffuse(t, node, context):
    colour, roughness = t.input(node, "Color", context), t.input(node, "Roughness", context)
    return [closure(t.graph, "Diffuse", base_color=colour, diffuse_roughness=roughness, normal=normal_node(t, node, context))]


@closure_node("ShaderNodeBsdfAnisotropic", "ShaderNodeBsdfGlossy")
def glossy(t, node, context):
    anisotropy = t.input(node, "Anisotropy", context)
    if node.distribution not in DISTRIBUTIONS:
        t.tell("distribution", node, context, f"Distribution {node.distribution}")
    return [
        closure(
            t.graph,
            "Glossy",
            base_color=t.input(node, "Color", context),
            specular_roughness=t.input(node, "Roughness", context, 0.5),
            specular_anisotropy=anisotropy,
            specular_rotation=t.input(node, "Rotation", context),
            distribution=DISTRIBUTIONS.get(node.distribution, "Ggx"),
            normal=normal_node(t, node, context),
            tangent=tangent_node(t, node, context, anisotropy),
        )
    ]


def thin_film(t, node, context):
    """Parameters of a film, none where it is off or unknown to this Blender."""
    thickness = t.input(node, "Thin Film Thickness", context)
    if thickness.is_zero():
        return {}
    return {"thin_film_weight": 1.0, "thin_film_thickness": thickness, "thin_film_ior": t.input(node, "Thin Film IOR", context, 1.33)}


@closure_node("ShaderNodeBsdfGlass", "ShaderNodeBsdfRefraction")
def refractive(t, node, context):
    return [
        closure(
            t.graph,
            "Glass" if node.bl_idname == "ShaderNodeBsdfGlass" else "Refraction",
            base_color=t.input(node, "Color", context),
            specular_roughness=t.input(node, "Roughness", context),
            specular_ior=t.input(node, "IOR", context),
            distribution=DISTRIBUTIONS.get(node.distribution, "Ggx"),
            normal=normal_node(t, node, context),
            # A Refraction BSDF has no film.
            **thin_film(t, node, context),
        )
    ]


@closure_node("ShaderNodeBsdfMetallic")
def metallic(t, node, context):
    anisotropy = t.input(node, "Anisotropy", context)
    is_f82 = node.fresnel_type == "F82"
    colours = {"base_color": "Base Color", "metal_edge_tint": "Edge Tint"} if is_f82 else {"metal_n": "IOR", "metal_k": "Extinction"}
    return [
        closure(
            t.graph,
            "Metallic" if is_f82 else "Conductor",
            **{name: t.input(node, socket, context) for name, socket in colours.items()},
            specular_roughness=t.input(node, "Roughness", context, 0.5),
            specular_anisotropy=anisotropy,
            specular_rotation=t.input(node, "Rotation", context),
            distribution=DISTRIBUTIONS.get(node.distribution, "Ggx"),
            normal=normal_node(t, node, context),
            tangent=tangent_node(t, node, context, anisotropy),
            **(thin_film(t, node, context) if t.version >= (5, 0, 0) else {}),
        )
    ]


@closure_node("ShaderNodeBsdfTransparent")
def transparent(t, node, context):
    return [closure(t.graph, "Transparent", base_color=t.input(node, "Color", context))]


@closure_node("ShaderNodeBsdfRayPortal")
def ray_portal(t, node, context):
    position = t.input(node, "Position", context) if t.linked(node, "Position", context) else hit(t, "Position")
    direction = t.input(node, "Direction", context)
    colour = t.input(node, "Color", context)
    return [closure(t.graph, "Portal", base_color=colour, portal_position=position, portal_direction=direction)]


@closure_node("ShaderNodeBsdfTranslucent")
def translucent(t, node, context):
    return [closure(t.graph, "Translucent", base_color=t.input(node, "Color", context), normal=normal_node(t, node, context))]


@closure_node("ShaderNodeBsdfSheen")
def sheen(t, node, context):
    model = "Sheen" if node.distribution == "MICROFIBER" else "Velvet"
    colour, roughness = t.input(node, "Color", context), t.input(node, "Roughness", context, 0.5)
    return [closure(t.graph, model, base_color=colour, fuzz_roughness=roughness, normal=normal_node(t, node, context))]


@closure_node("ShaderNodeBsdfToon")
def toon(t, node, context):
    model = "DiffuseToon" if node.component == "DIFFUSE" else "GlossyToon"
    colour, size, smooth = t.input(node, "Color", context), t.input(node, "Size", context, 0.5), t.input(node, "Smooth", context)
    return [closure(t.graph, model, base_color=colour, toon_size=size, toon_smooth=smooth, normal=normal_node(t, node, context))]


@closure_node("ShaderNodeSubsurfaceScattering")
def subsurface(t, node, context):
    return [
        closure(
            t.graph,
            "Subsurface",
            base_color=t.input(node, "Color", context),
            subsurface_radius=t.input(node, "Radius", context) * t.input(node, "Scale", context, 0.05),
            subsurface_scatter_anisotropy=t.input(node, "Anisotropy", context),
            subsurface_ior=t.input(node, "IOR", context, 1.4),
            specular_roughness=t.input(node, "Roughness", context, 1.0),
            subsurface=subsurface_method(node.falloff, t.version),
            normal=normal_node(t, node, context),
        )
    ]


@closure_node("ShaderNodeHoldout")
def holdout(t, node, context):
    return [closure(t.graph, "Holdout")]

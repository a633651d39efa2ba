# SPDX-License-Identifier: GPL-3.0-or-later
"""The Principled BSDF: every socket by its name, in the core's parameter block."""

from ...units import LUMENS_PER_WATT
from .closures import DISTRIBUTIONS, closure, normal_node, subsurface_method, tangent_node, thin_film
from .inputs import hit
from .registry import closure_node

# Sockets that go over as they are: the core's name, the socket's, and the value where this Blender has no such socket.
COPIED = (
    ("base_color", "Base Color", 0.8),
    ("diffuse_roughness", "Diffuse Roughness", 0.0),
    ("metalness", "Metallic", 0.0),
    ("metal_edge_tint", "Specular Tint", 1.0),
    ("specular_color", "Specular Tint", 1.0),
    ("specular_roughness", "Roughness", 0.5),
    ("specular_anisotropy", "Anisotropic", 0.0),
    ("specular_rotation", "Anisotropic Rotation", 0.0),
    ("specular_ior", "IOR", 1.5),
    ("geometry_opacity", "Alpha", 1.0),
)
# Those of a part of the surface, by the part's weight: they are left out where the weight is nothing.
PARTS = {
    ("transmission_weight", "Transmission Weight"): (),
    ("subsurface_weight", "Subsurface Weight"): (
        ("subsurface_color", "Base Color", 0.8),
        ("subsurface_scatter_anisotropy", "Subsurface Anisotropy", 0.0),
    ),
    ("coat_weight", "Coat Weight"): (
        ("coat_roughness", "Coat Roughness", 0.03),
        ("coat_ior", "Coat IOR", 1.5),
        ("coat_color", "Coat Tint", 1.0),
    ),
    ("fuzz_weight", "Sheen Weight"): (("fuzz_roughness", "Sheen Roughness", 0.5), ("fuzz_color", "Sheen Tint", 1.0)),
}


@closure_node("ShaderNodeBsdfPrincipled")
def principled(t, node, context):
    parameters = {name: t.input(node, socket, context, usual) for name, socket, usual in COPIED}
    for (name, socket), rest in PARTS.items():
        weight = t.input(node, socket, context, 0.0)
        if not weight.is_zero():
            parameters[name] = weight
            parameters.update({other: t.input(node, own, context, usual) for other, own, usual in rest})
    # The level of 0.5 is the index of refraction's own reflectance.
    parameters["specular_weight"] = t.input(node, "Specular IOR Level", context, 0.5) * 2.0
    parameters["coat_darkening"] = 0.0
    shining = t.input(node, "Emission Color", context) * t.input(node, "Emission Strength", context)
    # Unlike Emission nodes, this one takes no light away since 5.0.
    parameters["emission_color"] = (shining.maximum(0.0) if t.version >= (5, 0, 0) else shining) * LUMENS_PER_WATT
    thin_walled = _is_thin_walled(t, node, context)
    if "transmission_weight" in parameters:
        base = parameters["base_color"].clamp()
        # Light crosses two interfaces of a solid, so each takes the root; a sheet has the whole colour.
        parameters["transmission_color"] = base if thin_walled else base.sqrt()
    if "subsurface_weight" in parameters:
        radius = t.input(node, "Subsurface Radius", context)
        parameters["subsurface_radius"] = radius * t.input(node, "Subsurface Scale", context, 0.05)
        if node.subsurface_method == "RANDOM_WALK_SKIN":
            parameters["subsurface_ior"] = t.input(node, "Subsurface IOR", context, 1.4)
    normal = normal_node(t, node, context)
    common = {
        "normal": normal,
        "coat_normal": _coat_normal(t, node, context, normal) if "coat_weight" in parameters else None,
        "tangent": tangent_node(t, node, context, parameters["specular_anisotropy"]),
        "thin_walled": thin_walled,
        "distribution": DISTRIBUTIONS.get(node.distribution, "MultiGgx"),
        "subsurface": subsurface_method(node.subsurface_method, t.version),
    }
    film, metalness = thin_film(t, node, context), parameters["metalness"]
    if film and t.version < (5, 0, 0) and not metalness.is_zero():
        # Before 5.0 films lie on the dielectric alone; metal and dielectric are mixed linearly, so they may stand apart.
        dielectric = closure(t.graph, "Principled", **{**parameters, "metalness": 0.0}, **film, **common)
        metal = closure(t.graph, "Principled", **{**parameters, "metalness": 1.0}, **common)
        return [{**dielectric, "share": 1.0 - metalness}, {**metal, "share": metalness}]
    return [closure(t.graph, "Principled", **parameters, **film, **common)]


def _coat_normal(t, node, context, normal):
    """The graph node of the coat's normal: the shading normal where nothing is linked, for a bump of the base leaves the coat smooth."""
    own = normal_node(t, node, context, "Coat Normal")
    return hit(t, "Normal").node if own is None and normal is not None else own


def _is_thin_walled(t, node, context):
    """Blender 5.2's Thin Wall socket."""
    value = t.input(node, "Thin Wall", context)
    if not value.is_constant:
        t.tell("varying thin wall", node, context)
        return False
    return value.constant[0] > 0.5

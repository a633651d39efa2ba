# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender materials as descriptions of gonio materials."""

from dataclasses import dataclass, field

import bpy
from gonio.graph import Graph, renumber

from .. import limits
from ..evaluate import Pictures
from ..spectrum import spectrum
from . import (  # noqa: F401 (they register their nodes)
    bump,
    camera_nodes,
    closures,
    colour,
    hair,
    info_nodes,
    inputs,
    light_nodes,
    maths,
    measured,
    nearby,
    principled,
    procedural,
    tangent_nodes,
    textures,
    vectors,
    wireframe,
    zones,
)
from .closures import closure
from .displacement import displace
from .flatten import GREY, flatten
from .interior import medium, usual
from .made_of import glass, metal
from .shader_outputs import shader_outputs
from .sockets import active_output, input_socket
from .translator import Translator


@dataclass
class Translated:
    """A material's description, and the named values it wants of meshes and placements."""

    description: dict
    primvars: set = field(default_factory=set)
    instance_primvars: set = field(default_factory=set)
    # What it asked of the scene around it, and the answers.
    asked: dict = field(default_factory=dict)
    # Whether its inside varies, which is no part of the description (`translate_inside`).
    is_uneven: bool = False


def translate(material, images, measurements, report, version=None, shader_aovs=frozenset(), surroundings=None):
    """A material's description with the AOV Output nodes of these names; None stands for no material at all (Blender's default grey)."""
    if material is None:
        return Translated(_default())
    tree = material.node_tree
    # Since 5.0 a material has nodes always, and asking is deprecated.
    if tree is None or (bpy.app.version < (5, 0, 0) and not material.use_nodes):
        return Translated(_plain(material.name, tuple(material.diffuse_color)[:3], material.pass_index))
    t = Translator(material, tree, images, report, measurements=measurements, version=version, surroundings=surroundings)
    end, displacement, inside = active_output(tree, "Material"), None, None
    if end is None:
        report.add("Material", material.name, "the node tree has no output; the surface is black", material=material.name)
    else:
        displacement = displace(t, end, material)
        flatten(t, input_socket(end, "Surface"), t.root, t.graph.scalar(1.0))
        inside = _rest(t, end, material)
    outputs = shader_outputs(t, shader_aovs) if shader_aovs else []
    is_uneven = inside is not None and not inside.is_even
    described = _described(t, material, outputs, displacement, None if is_uneven else inside)
    for kind, made_of in (("metal", metal(material, report)), ("glass", glass(material, report))):
        if made_of is not None:
            described["closures"] = [{**made, kind: made_of} for made in described["closures"]]
    if material.gonio.spectrum:
        described["spectrum"] = spectrum(material, report, "Material", material=material.name)
    if not material.use_transparent_shadow and not (end is not None and t.linked(end, "Volume", t.root)):
        # Cycles lets light into volumes always.
        described["transparent_shadows"] = False
    return Translated(described, t.primvars, t.instance_primvars, t.asked, is_uneven)


def _rest(t, end, material):
    """What an output node has beside its surface; rays pass what is a volume alone. Gives the medium inside, if there is any."""
    inside = None
    if t.linked(end, "Volume", t.root):
        inside = medium(t, input_socket(end, "Volume"), t.root)
        if inside is None:
            t.tell("volume", end, t.root, "Volume")
        elif not inside.is_plain:
            t.tell("phase", end, t.root, "Volume")
        # As in Cycles a surface that comes to nothing counts as none.
        if not t.closures:
            t.closures.append({"weight": t.graph.scalar(1.0).input(), **closure(t.graph, "Transparent", base_color=1.0)})
    limits.of_material(material, t.report)
    return inside


def translate_inside(material, images, report, *, has_grids=True, surroundings=None):
    """The translator of what fills volume objects of a material, or meshes, which have no grids, and the medium: None where there is none; no
    material is Cycles' usual one."""
    tree = None if material is None else material.node_tree
    if material is None:
        t = Translator(None, None, images, report, has_grids=True)
        return t, usual(t)
    t = Translator(material, tree, Pictures(images, report), report, has_grids=has_grids, surroundings=surroundings)
    end = None if tree is None else active_output(tree, "Material")
    if end is None or not t.linked(end, "Volume", t.root):
        return t, None
    inside = medium(t, input_socket(end, "Volume"), t.root)
    if inside is None:
        t.tell("volume shader", end, t.root, "Volume")
        return t, usual(t)
    if not inside.is_plain:
        t.tell("phase", end, t.root, "Volume")
    return t, inside


def _described(t, material, outputs, displacement, inside):
    """Closures, AOV outputs and the graph without what nothing needs."""
    wanted = [output[key] for output in outputs for key in ("color", "value")]
    for made in t.closures:
        wanted += [made["weight"], *(source for _, source in made["parameters"])]
        wanted += [{"Node": [made[key], "Rgb"]} for key in ("normal", "coat_normal", "tangent") if made[key] is not None]
    if t.bent is not None:
        wanted.append({"Node": [t.bent.node, "Rgb"]})
    if displacement is not None:
        wanted.append(displacement["value"])
    nodes, order = t.graph.reachable(wanted)
    moved = {} if displacement is None else {"displacement": {**displacement, "value": renumber(displacement["value"], order)}}
    return {
        **moved,
        **({"medium": inside.described()} if inside is not None and inside.described() else {}),
        "origin": {"name": material.name, "file": ""},
        "graph": {"nodes": nodes},
        # Displacement makes the normal from which others are bent.
        "normal": None if t.bent is None else order[t.bent.node],
        "closures": [_renumbered(made, order) for made in t.closures],
        "pass_index": material.pass_index,
        "shader_outputs": [{**output, **{key: renumber(output[key], order) for key in ("color", "value")}} for output in outputs],
    }


def _renumbered(made, order):
    return {
        **made,
        "weight": renumber(made["weight"], order),
        "parameters": [[name, renumber(source, order)] for name, source in made["parameters"]],
        **{key: None if made[key] is None else order[made[key]] for key in ("normal", "coat_normal", "tangent")},
    }


def _default():
    """What has no material: since 5.0 a new Principled BSDF."""
    if bpy.app.version < (5, 0, 0):
        return _plain("default", GREY)
    values = {"specular_roughness": 0.5, "specular_ior": 1.5, "specular_weight": 1.0, "coat_darkening": 0.0, "metal_edge_tint": (1.0, 1.0, 1.0)}
    made = {"weight": {"Constant": [1.0] * 4}, **closure(Graph(), "Principled", base_color=GREY, **values)}
    return {**_plain("default", GREY), "closures": [made]}


def _plain(name, rgb, pass_index=0):
    """A Lambertian surface without nodes."""
    made = {"weight": {"Constant": [1.0] * 4}, **closure(Graph(), "Diffuse", base_color=rgb)}
    return {"origin": {"name": name, "file": ""}, "graph": {"nodes": []}, "closures": [made], "pass_index": pass_index}

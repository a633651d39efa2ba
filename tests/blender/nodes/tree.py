"""A case of the catalogue as the node tree of a material, whose output goes into a shader AOV and shines. For Blender."""

import bpy
import numpy

from . import data, prepare
from .case import Case

# The AOVs: a node's output, and where the hit lies.
OUTPUT, PLACE = "node", "place"


def image(name: str) -> bpy.types.Image:
    """The image of a kind of data, made once."""
    found = bpy.data.images.get(name)
    if found is not None:
        return found
    made = bpy.data.images.new(name, data.SIDE, data.SIDE, float_buffer=True, is_data=True)
    made.alpha_mode, made.use_half_precision = "CHANNEL_PACKED", False
    whole = numpy.ones((data.SIDE, data.SIDE, 4), "f4")
    whole[..., :3] = data.texels(name)
    made.pixels.foreach_set(whole.ravel())
    return made


class Tree:
    """A material under construction."""

    def __init__(self, name: str):
        self.material = bpy.data.materials.new(name)
        if bpy.app.version < (5, 0, 0):
            self.material.use_nodes = True
        self.material.cycles.emission_sampling = "NONE"
        self.tree = self.material.node_tree
        self.tree.nodes.clear()
        self._sources = {}

    def new(self, kind: str, **fields) -> bpy.types.Node:
        """A node with some of its fields set."""
        made = self.tree.nodes.new(kind)
        for name, value in fields.items():
            assign(made, name, value)
        return made

    def link(self, source: bpy.types.NodeSocket, end: bpy.types.NodeSocket) -> None:
        """Feeds an input."""
        self.tree.links.new(source, end)

    def source(self, text: str) -> bpy.types.NodeSocket:
        """The output that a text of the catalogue names."""
        if text not in self._sources:
            self._sources[text] = self._found(text)
        return self._sources[text]

    def _found(self, text: str) -> bpy.types.NodeSocket:
        if text.startswith("hit."):
            _, kind, output = text.split(".")
            return socket(self.new(f"ShaderNode{kind}").outputs, output)
        name, _, component = text.partition(".")
        if component:
            apart = self.new("ShaderNodeSeparateXYZ")
            self.link(self.source(name), apart.inputs[0])
            return apart.outputs["XYZ".index(component.upper())]
        return self.new("ShaderNodeTexImage", image=image(name), interpolation="Closest").outputs["Color"]

    def finish(self, output: bpy.types.NodeSocket, seen: str) -> None:
        """Lets an output be seen, or what it makes of the surface."""
        end = self.new("ShaderNodeOutputMaterial")
        if seen in ("shader", "volume"):
            self.link(output, end.inputs["Volume" if seen == "volume" else "Surface"])
            return
        if seen == "displacement":
            self.link(output, end.inputs["Displacement"])
            output = self.new("ShaderNodeNewGeometry").outputs["Normal"]
        self.link(output, self.new("ShaderNodeOutputAOV", aov_name=OUTPUT).inputs["Color"])
        shown = self.new("ShaderNodeEmission")
        self.link(output, shown.inputs["Color"])
        self.link(shown.outputs[0], end.inputs["Surface"])

    def see_place(self) -> None:
        """Shows where the hit lies too."""
        place = self.new("ShaderNodeNewGeometry")
        self.link(place.outputs["Position"], self.new("ShaderNodeOutputAOV", aov_name=PLACE).inputs["Color"])


def assign(thing, name: str, value) -> None:
    """Sets a field; dots lead deeper."""
    *path, last = name.split(".")
    for part in path:
        thing = getattr(thing, part)
    setattr(thing, last, value)


def socket(sockets, name) -> bpy.types.NodeSocket:
    """A socket by identifier, by name or by number."""
    if isinstance(name, int):
        return sockets[name]
    named = [each for each in sockets if each.identifier == name] or [each for each in sockets if each.name == name and each.enabled]
    if not named:
        raise KeyError(f"no socket {name} among {[each.identifier for each in sockets]}")
    return named[0]


def outputs(bl_idname: str, case: Case) -> list[str]:
    """Identifiers of the outputs that a case compares."""
    if case.outputs is not None:
        return list(case.outputs)
    probe = Tree("probe")
    node, _ = _set(probe, bl_idname, case)
    found = [each.identifier for each in node.outputs if each.enabled and not each.is_unavailable]
    bpy.data.materials.remove(probe.material)
    return found


def _set(made: Tree, bl_idname: str, case: Case) -> tuple[bpy.types.Node, bpy.types.NodeSocket | None]:
    """The node, and the socket that is seen where it is none of its own."""
    node = made.new(bl_idname, **case.fields)
    return node, None if case.prepare is None else getattr(prepare, case.prepare)(made, node)


def material(name: str, bl_idname: str, case: Case, output: str | int) -> bpy.types.Material:
    """The material of a name that shows one output of a node."""
    made = Tree(name)
    node, end = _set(made, bl_idname, case)
    for name, value in case.inputs.items():
        _fill(made, socket(node.inputs, name), value)
    if case.seen == "colour":
        _colour(made, node)
    else:
        made.finish(end or socket(node.outputs, output), case.seen)
    if case.shown_on in ("balls", "near", "particles"):
        made.see_place()
    return made.material


def _colour(made: Tree, node: bpy.types.Node) -> None:
    """A colour in the place of a shader."""
    colour = made.new("ShaderNodeRGB")
    colour.outputs[0].default_value = (0.8, 0.45, 0.2, 1.0)
    made.link(colour.outputs[0], node.inputs["Surface"])


def _fill(made: Tree, end: bpy.types.NodeSocket, value) -> None:
    """Links or sets an input."""
    if isinstance(value, str):
        made.link(made.source(value), end)
    elif end.type != "SHADER":
        end.default_value = (*value, 1.0) if end.type == "RGBA" and len(value) == 3 else value

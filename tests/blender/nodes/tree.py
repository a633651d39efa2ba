"""A case of the catalogue as the node tree of a material, whose output goes into a shader AOV and shines. For Blender."""

import bpy
import data
import numpy
import prepare
from case import Case

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
        """Lets an output be seen, or what it makes of the normal."""
        end = self.new("ShaderNodeOutputMaterial")
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
    node = _set(probe, bl_idname, case)
    found = [each.identifier for each in node.outputs if each.enabled and not each.is_unavailable]
    bpy.data.materials.remove(probe.material)
    return found


def _set(made: Tree, bl_idname: str, case: Case) -> bpy.types.Node:
    node = made.new(bl_idname, **case.fields)
    if case.prepare is not None:
        getattr(prepare, case.prepare)(made, node)
    return node


def material(name: str, bl_idname: str, case: Case, output: str) -> bpy.types.Material:
    """The material of a name that shows one output of a node."""
    made = Tree(name)
    node = _set(made, bl_idname, case)
    for name, value in case.inputs.items():
        end = socket(node.inputs, name)
        if isinstance(value, str):
            made.link(made.source(value), end)
        else:
            end.default_value = (*value, 1.0) if end.type == "RGBA" and len(value) == 3 else value
    made.finish(socket(node.outputs, output), case.seen)
    if case.on_sphere:
        made.see_place()
    return made.material

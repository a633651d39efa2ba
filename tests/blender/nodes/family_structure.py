"""What holds trees together, where they end, and what no material of Cycles can use."""

from .case import CLOSURE, NOT_APPLICABLE, STRUCTURE, VALUE, WHOLE, Case, Node

FAMILY = "Structure"


def _built(name: str, prepare: str, **rest) -> Node:
    """A node that shows through a tree of its own."""
    return Node(name, FAMILY, STRUCTURE, (Case("all", {}, {}, (prepare,), prepare=prepare, tolerance=WHOLE),), **rest)


def _none(name: str, remark: str, **rest) -> Node:
    return Node(name, "Not for materials", NOT_APPLICABLE, remark=remark, counts=False, **rest)


NODES = {
    "ShaderNodeGroup": _built("Group", "group"),
    "NodeGroupInput": _built("Group Input", "group", remark="inside the group"),
    "NodeGroupOutput": _built("Group Output", "group", remark="inside the group"),
    "NodeReroute": _built("Reroute", "reroute"),
    "NodeFrame": _built("Frame", "frame", remark="has no effect"),
    "GeometryNodeRepeatInput": _built("Repeat Input", "repeat", since=(5, 0)),
    "GeometryNodeRepeatOutput": _built("Repeat Output", "repeat", since=(5, 0)),
    "NodeClosureInput": _built("Closure Input", "closure", since=(5, 0)),
    "NodeClosureOutput": _built("Closure Output", "closure", since=(5, 0)),
    "NodeEvaluateClosure": _built("Evaluate Closure", "closure", since=(5, 0)),
    "NodeCombineBundle": _built("Combine Bundle", "bundle", since=(5, 0)),
    "NodeSeparateBundle": _built("Separate Bundle", "bundle", since=(5, 0)),
    "GeometryNodeMenuSwitch": _built("Menu Switch", "menu", since=(5, 0)),
    "ShaderNodeOutputMaterial": Node(
        "Material Output",
        FAMILY,
        CLOSURE,
        (Case("a colour as surface", {}, {}, ("end",), stage="lit", seen="colour", tolerance=0.04),),
        remark="every other row goes through it; volume and displacement have rows of their own",
    ),
    "ShaderNodeOutputAOV": _built("AOV Output", "reroute", remark="every row of values is read from one"),
    "ShaderNodeScript": Node(
        "Script", FAMILY, STRUCTURE, remark="Open Shading Language, which Cycles too runs only on processors and where it is switched on"
    ),
    "ShaderNodeLightFalloff": Node(
        "Light Falloff",
        "Color",
        VALUE,
        (
            Case("usual", {}, {"Strength": 0.7}, on_sphere=True),
            Case("smooth", {}, {"Strength": 0.7, "Smooth": 2.0}, on_sphere=True),
        ),
    ),
    "ShaderNodeOutputWorld": _none("World Output", "ends trees of worlds"),
    "ShaderNodeOutputLight": _none("Light Output", "ends trees of lamps"),
    "ShaderNodeOutputLineStyle": _none("Line Style Output", "Freestyle"),
    "ShaderNodeUVAlongStroke": _none("UV Along Stroke", "Freestyle"),
    "ShaderNodeShaderToRGB": _none("Shader to RGB", "EEVEE alone; Cycles has none"),
    "ShaderNodeEeveeSpecular": _none("Specular BSDF", "EEVEE alone; Cycles has none"),
    "ShaderNodeSqueeze": _none("Squeeze Value (Legacy)", "no engine computes it"),
}

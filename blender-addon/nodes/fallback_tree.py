# SPDX-License-Identifier: GPL-3.0-or-later
"""What a Measured BSDF node holds for engines that take no measurements: a Principled BSDF fitted to the file, or the linked shader.

All nodes share one tree; what is fitted to a node's file are values of its own hidden inputs.
"""

import bpy
import gonio

NAME = ".Measured BSDF"
# Name, kind, default, and the least and the largest value; vectors show no value.
INPUTS = (
    ("Tint", "NodeSocketColor", (1.0, 1.0, 1.0, 1.0), None),
    ("Scale", "NodeSocketFloat", 1.0, (0.0, 1000.0)),
    ("Rotation", "NodeSocketFloat", 0.0, (-1.0, 1.0)),
    ("Normal", "NodeSocketVector", None, None),
    ("Tangent", "NodeSocketVector", None, None),
    ("Fallback", "NodeSocketShader", None, None),
)
FITTED = (
    ("Fitted Color", "NodeSocketColor", (0.8, 0.8, 0.8, 1.0), None),
    ("Fitted Metallic", "NodeSocketFloat", 0.0, (0.0, 1.0)),
    ("Fitted Roughness", "NodeSocketFloat", 0.5, (0.0, 1.0)),
    ("Fitted IOR", "NodeSocketFloat", 1.5, (1.0, 4.0)),
    ("Fitted Anisotropy", "NodeSocketFloat", 0.0, (0.0, 1.0)),
    ("Fitted Rotation", "NodeSocketFloat", 0.0, (0.0, 1.0)),
)
# The input that tells whether another one is linked.
SWITCHES = {"Normal": "Use Normal", "Tangent": "Use Tangent", "Fallback": "Use Fallback"}
HIDDEN = (*(name for name, *_ in FITTED), *SWITCHES.values())


def shared():
    """The tree of all nodes, made if the file has none."""
    for tree in bpy.data.node_groups:
        if tree.get("gonio_measured") and tree.library is None:
            return tree
    tree = bpy.data.node_groups.new(NAME, "ShaderNodeTree")
    tree["gonio_measured"] = True
    tree.interface.new_socket("BSDF", in_out="OUTPUT", socket_type="NodeSocketShader")
    switches = [(name, "NodeSocketFloat", 0.0, (0.0, 1.0)) for name in SWITCHES.values()]
    for name, kind, default, limits in (*INPUTS, *FITTED, *switches):
        socket = tree.interface.new_socket(name, in_out="INPUT", socket_type=kind)
        if default is not None:
            socket.default_value = default
        if limits is not None:
            socket.min_value, socket.max_value = limits
        socket.hide_value = kind == "NodeSocketVector"
    _fill(tree)
    return tree


def fit(node, measured):
    """Sets a node's hidden inputs to the surface nearest to a measurement."""
    try:
        found = measured.fit()
    except gonio.Error:
        # What does not reflect has no nearest surface: the usual grey stays.
        return
    # OpenPBR's widths a √(2 / (q² + 1)) (1, q) as Principled's, whose product is its roughness to the fourth power.
    q = 1.0 - found["specular_roughness_anisotropy"]
    values = {
        "Fitted Color": (*found["base_color"], 1.0),
        "Fitted Metallic": found["base_metalness"],
        "Fitted Roughness": found["specular_roughness"] * (2.0 * q / (q * q + 1.0)) ** 0.25,
        "Fitted IOR": found["specular_ior"],
        "Fitted Anisotropy": min(1.0, (1.0 - q) / 0.9),
        "Fitted Rotation": found["rotation_deg"] / 360.0,
    }
    for name, value in values.items():
        node.inputs[name].default_value = value


def _fill(tree):
    """The nodes: colour × tint × scale into a Principled BSDF, and the linked shader in its place."""
    start, stop = tree.nodes.new("NodeGroupInput"), tree.nodes.new("NodeGroupOutput")
    stop.location.x = 900.0
    inputs, shader = start.outputs, tree.nodes.new("ShaderNodeBsdfPrincipled")
    shader.location.x = 400.0
    tinted, scaled = _mix(tree, "RGBA", (150.0, 250.0)), tree.nodes.new("ShaderNodeVectorMath")
    tinted.blend_type, scaled.operation = "MULTIPLY", "SCALE"
    turn = tree.nodes.new("ShaderNodeMath")
    geometry, tangent = tree.nodes.new("ShaderNodeNewGeometry"), tree.nodes.new("ShaderNodeTangent")
    tangent.direction_type = "UV_MAP"
    usual = {"Normal": geometry.outputs["Normal"], "Tangent": tangent.outputs["Tangent"]}
    links = [
        (inputs["Fitted Color"], _socket(tinted, "A")),
        (inputs["Tint"], _socket(tinted, "B")),
        (_socket(tinted, "Result", outputs=True), scaled.inputs[0]),
        (inputs["Scale"], scaled.inputs["Scale"]),
        (scaled.outputs[0], shader.inputs["Base Color"]),
        (inputs["Fitted Metallic"], shader.inputs["Metallic"]),
        (inputs["Fitted Roughness"], shader.inputs["Roughness"]),
        (inputs["Fitted IOR"], shader.inputs["IOR"]),
        (inputs["Fitted Anisotropy"], shader.inputs["Anisotropic"]),
        (inputs["Fitted Rotation"], turn.inputs[0]),
        (inputs["Rotation"], turn.inputs[1]),
        (turn.outputs[0], shader.inputs["Anisotropic Rotation"]),
    ]
    for name, source in usual.items():
        mixed = _mix(tree, "VECTOR", (150.0, -200.0))
        links += [
            (inputs[SWITCHES[name]], _socket(mixed, "Factor")),
            (source, _socket(mixed, "A")),
            (inputs[name], _socket(mixed, "B")),
            (_socket(mixed, "Result", outputs=True), shader.inputs[name]),
        ]
    choice = tree.nodes.new("ShaderNodeMixShader")
    choice.location.x = 700.0
    links += [
        (inputs["Use Fallback"], choice.inputs[0]),
        (shader.outputs[0], choice.inputs[1]),
        (inputs["Fallback"], choice.inputs[2]),
        (choice.outputs[0], stop.inputs[0]),
    ]
    for source, target in links:
        tree.links.new(source, target)


def _mix(tree, kind, location):
    """A Mix node of colours or vectors, all of the second one unless its factor is linked."""
    node = tree.nodes.new("ShaderNodeMix")
    node.data_type, node.location = kind, location
    node.clamp_factor = False
    _socket(node, "Factor").default_value = 1.0
    return node


def _socket(node, name, outputs=False):
    """The socket of a name that fits the node's kind of data."""
    return next(socket for socket in (node.outputs if outputs else node.inputs) if socket.name == name and socket.enabled)

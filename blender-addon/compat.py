# SPDX-License-Identifier: GPL-3.0-or-later
"""Differences between the versions of Blender, in one place."""

import bpy

# Blender 5.0 gave the passes their long names.
LONG_PASS_NAMES = bpy.app.version >= (5, 0, 0)

_SHORT_PASS_NAMES = {
    "Object Index": "IndexOB",
    "Material Index": "IndexMA",
    "Diffuse Direct": "DiffDir",
    "Diffuse Indirect": "DiffInd",
    "Diffuse Color": "DiffCol",
    "Glossy Direct": "GlossDir",
    "Glossy Indirect": "GlossInd",
    "Glossy Color": "GlossCol",
    "Transmission Direct": "TransDir",
    "Transmission Indirect": "TransInd",
    "Transmission Color": "TransCol",
    "Emission": "Emit",
    "Environment": "Env",
    "Ambient Occlusion": "AO",
}


def pass_name(name: str) -> str:
    """This version's name of a pass that has a long name since 5.0."""
    return name if LONG_PASS_NAMES else _SHORT_PASS_NAMES.get(name, name)


def existing_compositor_tree(scene: bpy.types.Scene) -> bpy.types.NodeTree | None:
    """The compositor's node tree of a scene, None if it has none."""
    if hasattr(scene, "compositing_node_group"):
        return scene.compositing_node_group
    return scene.node_tree if scene.use_nodes else None


def compositor_tree(scene: bpy.types.Scene) -> bpy.types.NodeTree:
    """The compositor's node tree of a scene, made if there is none (since 5.0 a node group of its own)."""
    if not hasattr(scene, "compositing_node_group"):
        scene.use_nodes = True
        return scene.node_tree
    if scene.compositing_node_group is None:
        scene.compositing_node_group = _new_compositor_group(scene)
    scene.render.use_compositing = True
    return scene.compositing_node_group


def _new_compositor_group(scene: bpy.types.Scene) -> bpy.types.NodeTree:
    tree = bpy.data.node_groups.new(scene.name, "CompositorNodeTree")
    tree.interface.new_socket("Image", in_out="OUTPUT", socket_type="NodeSocketColor")
    layers = tree.nodes.new("CompositorNodeRLayers")
    output = tree.nodes.new("NodeGroupOutput")
    output.location.x = 600.0
    tree.links.new(layers.outputs["Image"], output.inputs[0])
    return tree


def compositor_output(tree: bpy.types.NodeTree) -> bpy.types.NodeSocket | None:
    """The socket whose image is the composited one."""
    kinds = ("CompositorNodeComposite", "NodeGroupOutput")
    outputs = [node for node in tree.nodes if node.bl_idname in kinds and node.inputs]
    active = [node for node in outputs if getattr(node, "is_active_output", True)]
    return (active or outputs)[0].inputs[0] if outputs else None


def use_multilayer_exr(settings: bpy.types.ImageFormatSettings) -> None:
    """Chooses multilayer OpenEXR files (since 5.0 they are a media type)."""
    if hasattr(settings, "media_type"):
        settings.media_type = "MULTI_LAYER_IMAGE"
    settings.file_format = "OPEN_EXR_MULTILAYER"

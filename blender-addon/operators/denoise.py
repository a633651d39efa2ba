# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's own denoiser behind the render, guided by Gonio's passes."""

import bpy

from .. import compat

GUIDES = {"Normal": "Denoising Normal", "Albedo": "Denoising Albedo"}


def add_denoise_node(scene, layer) -> bool:
    """Puts a Denoise node behind the Image of a view layer and switches its guides on; False when there is one already."""
    layer.gonio.denoising_store_passes = True
    layer.update_render_passes()
    tree = compat.compositor_tree(scene)
    layers = _render_layers(tree, scene, layer)
    denoise = next((link.to_node for link in tree.links if link.from_node == layers and link.to_node.bl_idname == "CompositorNodeDenoise"), None)
    is_new = denoise is None
    if is_new:
        denoise = _insert(tree, layers)
    for name, source in GUIDES.items():
        if not denoise.inputs[name].is_linked and source in layers.outputs:
            tree.links.new(layers.outputs[source], denoise.inputs[name])
    return is_new


def _render_layers(tree, scene, layer):
    for node in tree.nodes:
        if node.bl_idname == "CompositorNodeRLayers" and node.scene in (scene, None) and node.layer == layer.name:
            return node
    node = tree.nodes.new("CompositorNodeRLayers")
    node.scene, node.layer = scene, layer.name
    return node


def _insert(tree, layers):
    """A Denoise node between the Image of a Render Layers node and all that used it."""
    image = layers.outputs["Image"]
    targets = [link.to_socket for link in tree.links if link.from_socket == image]
    output = compat.compositor_output(tree)
    if not targets and output is not None and not output.is_linked:
        targets = [output]
    denoise = tree.nodes.new("CompositorNodeDenoise")
    denoise.location = (layers.location.x + 300.0, layers.location.y)
    tree.links.new(image, denoise.inputs["Image"])
    for target in targets:
        tree.links.new(denoise.outputs["Image"], target)
    return denoise


class GONIO_OT_add_denoise_node(bpy.types.Operator):
    """Denoise this view layer in the compositor, guided by Gonio's normal and albedo passes"""

    bl_idname = "gonio.add_denoise_node"
    bl_label = "Add Denoise Node"
    bl_options = {"REGISTER", "UNDO"}

    @classmethod
    def poll(cls, context):
        return context.scene is not None and context.view_layer is not None

    def execute(self, context):
        is_new = add_denoise_node(context.scene, context.view_layer)
        self.report({"INFO"}, "Denoise node added to the compositor" if is_new else "There is a Denoise node already; its guides are linked")
        return {"FINISHED"}

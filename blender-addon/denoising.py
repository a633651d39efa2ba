# SPDX-License-Identifier: GPL-3.0-or-later
"""Blender's own denoiser behind the render, guided by Gonio's passes: a Denoise node of the compositor, switched on and off."""

from . import compat

GUIDES = {"Normal": "Denoising Normal", "Albedo": "Denoising Albedo"}


def is_on(scene) -> bool:
    """Whether a Denoise node that is not muted stands behind one of the scene's Render Layers nodes, and compositing is on."""
    tree = compat.existing_compositor_tree(scene)
    return tree is not None and scene.render.use_compositing and any(not node.mute for node in _nodes(tree, scene))


def switch(scene, on: bool) -> None:
    """Puts Denoise nodes behind the view layers that are rendered, or has those that stand there do nothing."""
    tree = compat.compositor_tree(scene) if on else compat.existing_compositor_tree(scene)
    if on:
        scene.render.use_compositing = True
        for layer in _layers(tree, scene):
            _add(tree, scene, layer)
    for node in _nodes(tree, scene) if tree is not None else ():
        node.mute = not on


def _layers(tree, scene):
    """The rendered view layers that the compositor shows; the first of all if it shows none."""
    used = [layer for layer in scene.view_layers if layer.use] or list(scene.view_layers)
    shown = {node.layer for node in tree.nodes if _is_of(node, scene)}
    return [layer for layer in used if layer.name in shown] or used[:1]


def _nodes(tree, scene):
    """Denoise nodes behind the scene's Render Layers nodes."""
    return [link.to_node for link in tree.links if _is_of(link.from_node, scene) and link.to_node.bl_idname == "CompositorNodeDenoise"]


def _is_of(node, scene) -> bool:
    return node.bl_idname == "CompositorNodeRLayers" and node.scene in (scene, None)


def _add(tree, scene, layer) -> None:
    """A Denoise node behind the Image of a view layer, if there is none, with its guides."""
    layer.gonio.denoising_store_passes = True
    layer.update_render_passes()
    layers = _render_layers(tree, scene, layer)
    denoise = next(
        (link.to_node for link in tree.links if link.from_node == layers and link.to_node.bl_idname == "CompositorNodeDenoise"), None
    )
    if denoise is None:
        denoise = _insert(tree, layers)
    for name, source in GUIDES.items():
        if not denoise.inputs[name].is_linked and source in layers.outputs:
            tree.links.new(layers.outputs[source], denoise.inputs[name])


def _render_layers(tree, scene, layer):
    for node in tree.nodes:
        if _is_of(node, scene) and node.layer == layer.name:
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
